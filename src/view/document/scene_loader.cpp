#include "view/document/scene_loader.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "lod/pyramid/draft.h"

namespace defocus::engine {

namespace {

constexpr std::uint64_t draftTriangles = 60'000;  // approximate triangle count of a draft; smaller scenes get no draft

// Returns the scene with draft level-of-detail pyramids; null for a small scene, whose final pyramids are built
// quickly.
std::unique_ptr<PreparedFrame> draftOf(const PreparedFrame& frame) {
    const std::vector<Mesh>& meshes = frame.scene->meshes;
    std::uint64_t total = 0;
    for (const Mesh& mesh : meshes) total += mesh.triangleCount();
    if (total <= draftTriangles) return nullptr;
    auto draft = std::make_unique<PreparedFrame>(frame);
    draft->world.pyramids.resize(meshes.size());
    parallelFor(meshes.size(), [&](std::size_t i) {
        const double share = static_cast<double>(meshes[i].triangleCount()) / static_cast<double>(total);
        draft->world.pyramids.replace(
            i, draftPyramid(meshes[i], std::max(256u, static_cast<std::uint32_t>(share * draftTriangles))));
    });
    return draft;
}

}  // namespace

SceneLoader::~SceneLoader() {
    for (const std::unique_ptr<Job>& job : jobs_) job->cancelled = true;
}

void SceneLoader::open(const Request& options) {
    for (const std::unique_ptr<Job>& job : jobs_)
        if (!job->draftTaken) job->cancelled = true;
    Job& job = *jobs_.emplace_back(std::make_unique<Job>());
    job.options = options;
    job.opening = {options.scene.empty() ? "the school of fish" : options.scene.filename().string(), "opening"};
    job.thread = std::jthread([&job] { run(job); });
}

void SceneLoader::run(Job& job) {
    LoadedScene result{job.options, nullptr, {}};
    try {
        const Progress progress = [&job](std::string_view stage, std::uint64_t done, std::uint64_t total) {
            if (job.cancelled) fail("cancelled");
            const std::scoped_lock lock(job.mutex);
            job.opening.stage = stage;
            job.opening.share = total > 0 ? std::min(1.0, static_cast<double>(done) / static_cast<double>(total)) : 0;
        };
        auto frame = std::make_unique<PreparedFrame>(placeFrame(job.options, progress));
        if (auto draft = draftOf(*frame)) {
            const std::scoped_lock lock(job.mutex);
            job.ready = LoadedScene{job.options, std::move(draft), {}, true};
        }
        // Build all levels, because the user may switch to any level mode later.
        const LodMode asked = frame->settings.lod;
        if (asked == LodMode::off) frame->settings.lod = LodMode::fractional;
        addPyramids(*frame, progress);
        frame->settings.lod = asked;
        result.frame = std::move(frame);
    } catch (const std::bad_alloc&) {
        result.fault = "out of memory";
    } catch (const std::exception& error) {
        result.fault = error.what();
    }
    const std::scoped_lock lock(job.mutex);
    job.ready = std::move(result);
    job.ended = true;
}

std::optional<LoadedScene> SceneLoader::take() {
    std::optional<LoadedScene> result;
    for (auto job = jobs_.rbegin(); job != jobs_.rend() && !result; ++job) {
        const std::scoped_lock lock((*job)->mutex);
        if ((*job)->cancelled || !(*job)->ready) continue;
        result = std::exchange((*job)->ready, std::nullopt);
        (*job)->draftTaken = result->draft;
        if (!result->frame) break;
        for (auto older = std::next(job); older != jobs_.rend(); ++older) (*older)->cancelled = true;
    }
    std::erase_if(jobs_, [](const std::unique_ptr<Job>& job) {
        const std::scoped_lock lock(job->mutex);
        return job->ended && (job->cancelled || !job->ready);
    });
    return result;
}

std::optional<SceneLoader::Opening> SceneLoader::opening() const {
    if (!busy()) return std::nullopt;
    const std::scoped_lock lock(jobs_.back()->mutex);
    return jobs_.back()->opening;
}

}  // namespace defocus::engine
