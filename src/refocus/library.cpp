// Implements the public class LightField with engine::LightField and LightFieldOutput.

#include <utility>

#include "core/error.h"
#include "defocus/light_field.h"
#include "refocus/focal_stack.h"
#include "refocus/light_field_output.h"
#include "refocus/refocus_settings.h"

namespace defocus {

class LightField::State {
public:
    State(const std::filesystem::path& path, std::vector<std::string> lines) : field(path), warnings(std::move(lines)) {
        field.keepImages();
    }

    engine::LightField field;
    std::vector<std::string> warnings;
};

LightField::LightField(const std::filesystem::path& path) : LightField(path, {}) {}
LightField::LightField(const std::filesystem::path& path, std::vector<std::string> warnings)
    : state_(std::make_unique<State>(path, std::move(warnings))) {}
LightField::~LightField() = default;
LightField::LightField(LightField&&) noexcept = default;
LightField& LightField::operator=(LightField&&) noexcept = default;

namespace {

// Renders the lens images (one image per lens sample) of a request to the file `path`. Returns the warnings.
std::vector<std::string> renderLensImages(std::shared_ptr<const engine::Scene> scene, const Request& request,
                                          const std::filesystem::path& path, const std::optional<FocusRange>& range,
                                          const Progress& progress) {
    engine::LightFieldOutput::checkPath(path);
    engine::SceneDriver driver(std::move(scene), engine::LightFieldOutput::suited(request), {}, progress);
    engine::LightFieldOutput output(driver, path, range);
    output.start(progress);
    const std::size_t total = output.info().points.size();
    std::size_t done = 0;
    do {
        engine::report(progress, "lens images", done++, total);
    } while (output.advance());
    output.finish();
    engine::report(progress, "lens images", total, total);
    return driver.warnings();
}

}  // namespace

LightField LightField::render(const Request& request, const std::filesystem::path& path,
                              std::optional<FocusRange> range, const Progress& progress) {
    return {path, renderLensImages(nullptr, request, path, range, progress)};
}

LightField LightField::render(const Scene& scene, const Request& request, const std::filesystem::path& path,
                              std::optional<FocusRange> range, const Progress& progress) {
    return {path, renderLensImages(scene.engineScene(), request, path, range, progress)};
}

LightFieldInfo LightField::info() const {
    const engine::LightFieldInfo& from = state_->field.info();
    LightFieldInfo info;
    info.width = from.size.width;
    info.height = from.size.height;
    info.focusDistance = from.focusDistance;
    info.fStop = from.fStop;
    info.focalLength = from.number("defocus:focalLength", 0);
    info.horizontalAperture = from.number("defocus:horizontalAperture", 0);
    info.focusRange = from.range;
    info.fullDisk = from.disk;
    info.pixelsPerDioptre = from.pixelsPerDioptre;
    for (const auto& point : from.points) info.lensPoints.push_back({point.x, point.y});
    return info;
}

std::vector<std::string> LightField::warnings() const {
    return state_->warnings;
}

Image LightField::refocus(const RefocusSettings& settings, const Progress& progress) {
    return engine::refocused(state_->field, engine::refocusingOf(settings, state_->field), progress);
}

FocalStack LightField::stack(int count, const RefocusSettings& settings, const Progress& progress) {
    if (count < 2) throw UsageError("a focal stack must have at least 2 images");
    if (!std::holds_alternative<CameraFocus>(settings.focus))
        throw UsageError(
            "a focal stack chooses its own focus distances; give neither a focus distance nor a focus pixel");
    engine::Refocusing refocusing = engine::refocusingOf(settings, state_->field);
    FocalStack stack;
    stack.focusDistances = engine::stackDistances(state_->field.info().range, count);
    for (const double distance : stack.focusDistances) {
        engine::report(progress, "images", stack.pictures.size(), stack.focusDistances.size());
        refocusing.focusDistance = distance;
        stack.pictures.push_back(engine::refocused(state_->field, refocusing));
    }
    return stack;
}

Image LightField::allInFocus(const Progress& progress) {
    return engine::allInFocus(state_->field, progress);
}

Image LightField::depth() {
    return engine::centralDepth(state_->field);
}

Image LightField::coc(const RefocusSettings& settings) {
    return engine::centralCoc(state_->field, engine::refocusingOf(settings, state_->field));
}

}  // namespace defocus
