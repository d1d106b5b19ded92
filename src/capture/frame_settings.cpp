#include "capture/frame_settings.h"

#include <fmt/format.h>

#include <span>
#include <string_view>

#include "core/hash.h"
#include "lens/lens_fields.h"

namespace defocus {

namespace {

// Numbers as text that gives exactly them again.
class Settings {
public:
    template <typename... Values>
    void add(const Values&... values) {
        ((text_ += fmt::format("{};", values)), ...);
    }
    void add(const glm::dmat4& matrix) {
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row) add(matrix[column][row]);
    }
    void add(const glm::dvec3& vector) { add(vector.x, vector.y, vector.z); }

    [[nodiscard]] std::string hash() const {
        return fmt::format("{:016x}", hashBytes(std::as_bytes(std::span(std::string_view(text_)))));
    }

private:
    std::string text_;
};

void addLens(Settings& settings, const Lens& lens) {
    for (const LensField& field : lensFields()) settings.add(lensFieldValue(lens, field));
    if (!lens.apertureImage) return;
    const Image& image = *lens.apertureImage;
    settings.add(image.width, image.height, image.channels, hashBytes(std::as_bytes(std::span(image.pixels))));
}

void addPose(Settings& settings, const Pose& pose) {
    for (const glm::dmat4& worldFromNode : pose.worldFromNode) settings.add(worldFromNode);
    for (const Object& object : pose.objects) {
        settings.add(object.cocScale);
        for (const double weight : object.morphWeights) settings.add(weight);
    }
}

}  // namespace

std::string frameSettings(const FilmSettings& film, const SequenceFrame& frame) {
    Settings settings;
    settings.add(film.world, film.program, film.method, film.layerFormat, film.encoding);
    settings.add(frame.frame, frame.time);
    addPose(settings, frame.pose);
    settings.add(frame.shutter.perSample);
    for (const Pose& pose : frame.shutter.poses) addPose(settings, pose);
    for (const glm::dmat4& worldFromCamera : frame.view.shutterCameras) settings.add(worldFromCamera);
    for (const PlacedLight& placed : frame.lights) {
        const Light& light = placed.light;
        settings.add(placed.position);
        settings.add(placed.direction);
        settings.add(light.color.r, light.color.g, light.color.b, light.intensity, light.range, light.innerConeAngle,
                     light.outerConeAngle);
    }
    settings.add(frame.view.worldFromCamera);
    settings.add(frame.view.nearPlane, frame.view.width, frame.view.height);
    addLens(settings, frame.view.lens);
    const RenderSettings& render = frame.settings;
    const LodThresholds thresholds = chosenThresholds(render.thresholds, render.metric, render.sampleCount);
    settings.add(render.sampleCount, sequenceName(render.sequence), render.seed, render.firstSample,
                 lodModeName(render.lod), render.metric == LodMetric::size, render.lodCocAtCentre, thresholds.blur,
                 thresholds.size, render.keepAll, render.cocTolerance);
    return settings.hash();
}

}  // namespace defocus
