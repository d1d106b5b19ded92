#include "view/scene_loader.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "lod/pyramid/draft.h"

namespace defocus {

namespace {

constexpr std::size_t mostPreviewBoxes = 400;
constexpr std::uint64_t draftTriangles = 60'000;  // of all meshes; a scene of no more has its pyramids soon enough

std::shared_ptr<const ScenePreview> previewOf(const PreparedFrame& frame) {
    auto preview = std::make_shared<ScenePreview>();
    preview->view = frame.view;
    std::vector<std::optional<Bounds>> meshBounds(frame.scene->meshes.size());
    for (const Object& object : frame.world.pose.objects) {
        if (preview->boxes.size() == mostPreviewBoxes) break;
        const auto mesh = static_cast<std::size_t>(object.mesh);
        if (!meshBounds[mesh]) meshBounds[mesh] = frame.scene->meshes[mesh].bounds();
        if (meshBounds[mesh]->empty()) continue;
        std::array<glm::dvec3, 8> corners = meshBounds[mesh]->corners();
        for (glm::dvec3& corner : corners) corner = glm::dvec3(object.worldFromObject * glm::dvec4(corner, 1));
        preview->boxes.push_back(corners);
    }
    return preview;
}

// Null where it isn't worth while.
std::unique_ptr<PreparedFrame> draftOf(const PreparedFrame& frame) {
    const std::vector<Mesh>& meshes = frame.scene->meshes;
    std::uint64_t total = 0;
    for (const Mesh& mesh : meshes) total += mesh.triangleCount();
    if (total <= draftTriangles) return nullptr;
    auto draft = std::make_unique<PreparedFrame>(frame);
    draft->world.pyramids.resize(meshes.size());
    parallelFor(meshes.size(), [&](std::size_t i) {
        const double share = static_cast<double>(meshes[i].triangleCount()) / static_cast<double>(total);
        draft->world.pyramids[i] =
            draftPyramid(meshes[i], std::max(256u, static_cast<std::uint32_t>(share * draftTriangles)));
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
    job.thread = std::jthread([&job] { run(job); });
}

void SceneLoader::run(Job& job) {
    LoadedScene result{job.options, nullptr, {}};
    try {
        const Progress progress = [&job](std::string_view stage, std::uint64_t done, std::uint64_t total) {
            if (job.cancelled) fail("given up");
            const std::scoped_lock lock(job.mutex);
            job.stage = stage;
            job.share = total > 0 ? std::min(1.0, static_cast<double>(done) / static_cast<double>(total)) : 0;
        };
        auto frame = std::make_unique<PreparedFrame>(placeFrame(job.options, progress));
        {
            auto preview = previewOf(*frame);
            const std::scoped_lock lock(job.mutex);
            job.preview = std::move(preview);
        }
        if (auto draft = draftOf(*frame)) {
            const std::scoped_lock lock(job.mutex);
            job.draft = LoadedScene{job.options, std::move(draft), {}, true};
        }
        // The levels of every mode: a window switches between them at any time.
        frame->settings.lod = job.options.settings.lod == LodMode::off ? LodMode::fractional : job.options.settings.lod;
        addPyramids(*frame, progress);
        frame->settings.lod = job.options.settings.lod;
        result.frame = std::move(frame);
    } catch (const std::bad_alloc&) {
        result.fault = "out of memory";
    } catch (const std::exception& error) {
        result.fault = error.what();
    }
    const std::scoped_lock lock(job.mutex);
    job.result = std::move(result);
    job.done = true;
}

std::optional<LoadedScene> SceneLoader::take() {
    std::optional<LoadedScene> result;
    for (auto job = jobs_.rbegin(); job != jobs_.rend() && !result; ++job) {
        if ((*job)->cancelled) continue;
        if ((*job)->done) {
            result = std::move((*job)->result);
            (*job)->taken = true;
        } else {
            const std::scoped_lock lock((*job)->mutex);
            if (!(*job)->draft) continue;
            result = std::exchange((*job)->draft, std::nullopt);
            (*job)->draftTaken = true;
        }
        if (!result->frame) break;
        for (auto older = std::next(job); older != jobs_.rend(); ++older) (*older)->cancelled = true;
    }
    // What has ended since it was looked at above waits for the next call.
    std::erase_if(jobs_, [](const std::unique_ptr<Job>& job) { return job->done && (job->taken || job->cancelled); });
    return result;
}

std::string SceneLoader::name() const {
    if (jobs_.empty()) return {};
    const std::filesystem::path& path = jobs_.back()->options.scene;
    return path.empty() ? "the school of fish" : path.filename().string();
}

std::string SceneLoader::stage() const {
    if (jobs_.empty()) return {};
    const std::scoped_lock lock(jobs_.back()->mutex);
    return jobs_.back()->stage;
}

double SceneLoader::share() const {
    if (jobs_.empty()) return 0;
    const std::scoped_lock lock(jobs_.back()->mutex);
    return jobs_.back()->share;
}

std::shared_ptr<const ScenePreview> SceneLoader::preview() const {
    if (jobs_.empty()) return nullptr;
    const std::scoped_lock lock(jobs_.back()->mutex);
    return jobs_.back()->preview;
}

}  // namespace defocus
