// Implements the public class SceneRenderer with SceneDriver.

#include <utility>

#include "core/error.h"
#include "core/progress.h"
#include "defocus/renderer.h"
#include "frame/driver/scene_driver.h"
#include "frame/report/plan_report.h"
#include "image/packed_pixels.h"

namespace defocus {

class SceneRenderer::State : public engine::SceneDriver {
public:
    using engine::SceneDriver::SceneDriver;
};

SceneRenderer::SceneRenderer(const Request& request, const Progress& progress)
    : state_(std::make_unique<State>(nullptr, request, std::filesystem::path(), progress)) {
    state_->prepare(progress);
}

SceneRenderer::SceneRenderer(const Scene& scene, const Request& request, const Progress& progress)
    : state_(std::make_unique<State>(scene.engineScene(), request, std::filesystem::path(), progress)) {
    state_->prepare(progress);
}

SceneRenderer::~SceneRenderer() = default;
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;

void SceneRenderer::start() {
    state_->start(state_->firstRequest());
}

void SceneRenderer::start(const Request& request) {
    state_->start(request);
}

bool SceneRenderer::advance() {
    return state_->advance();
}

std::uint32_t SceneRenderer::samples() const {
    return state_->started() ? state_->driver().samples() : 0;
}

std::uint32_t SceneRenderer::sampleTotal() const {
    return state_->started() ? state_->driver().sampleTotal() : 0;
}

Image SceneRenderer::image() {
    return state_->image();
}

RenderStatistics SceneRenderer::statistics() const {
    return state_->statistics();
}

Image SceneRenderer::render(const Progress& progress, std::stop_token stop) {
    return render(state_->firstRequest(), progress, std::move(stop));
}

// Draws at least one sample even after a stop request, because the function must return an image.
Image SceneRenderer::render(const Request& request, const Progress& progress, std::stop_token stop) {
    state_->start(request, {}, progress);
    engine::report(progress, "samples", 0, sampleTotal());
    bool more = true;
    do {
        more = advance();
        engine::report(progress, "samples", samples(), sampleTotal());
    } while (more && (!stop.stop_requested() || samples() == 0));
    return image();
}

Aovs SceneRenderer::aovs() {
    engine::AovImages images = state_->aovs();
    return {std::move(images.depth), std::move(images.coc), std::move(images.level)};
}

Plan SceneRenderer::plan() const {
    return engine::reportedPlan(state_->driver().plan());
}

void SceneRenderer::write(const std::filesystem::path& path, const ImageView& image) const {
    state_->write(path, engine::PackedPixels(image).view());
}

std::vector<std::string> SceneRenderer::warnings() const {
    return state_->warnings();
}

Scene SceneRenderer::scene() const {
    return Scene(state_->scene());
}

}  // namespace defocus
