#include "frame/setup/settings_hash.h"

#include <fmt/format.h>

#include <span>
#include <string_view>

#include "core/hash.h"
#include "frame/program_facts.h"
#include "frame/request.h"
#include "frame/settings/settings.h"
#include "frame/setup/world_hash.h"
#include "lens/lens_fields.h"

namespace defocus::engine {

namespace {

// Collects values as text that keeps the full precision of numbers, and hashes the text.
class HashedText {
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

void addLens(HashedText& hashed, const Lens& lens) {
    for (const LensField& field : lensFields()) {
        hashed.add(lensFieldValue(lens, field));
    }
    if (!lens.apertureImage) return;
    const Image& image = *lens.apertureImage;
    hashed.add(image.width, image.height, image.channels, hashBytes(std::as_bytes(std::span(image.pixels))));
}

void addPose(HashedText& hashed, const Pose& pose) {
    for (const glm::dmat4& worldFromNode : pose.worldFromNode) hashed.add(worldFromNode);
    for (const Object& object : pose.objects) {
        hashed.add(object.cocScale);
        for (const double weight : object.morphWeights) hashed.add(weight);
    }
}

}  // namespace

FilmSettings filmSettings(const PreparedFrame& frame, const Request& request,
                          const std::filesystem::path& shaderFolder) {
    return {.world = worldHash(frame.world, frame.view, shaderFolder), .request = request, .encoding = ""};
}

std::string settingsHash(const FilmSettings& film, const FrameMoment& moment) {
    HashedText hashed;
    hashed.add(film.world, programVersion(), film.encoding);
    if (!film.lensImages.empty()) hashed.add(film.lensImages);
    hashed.add(moment.frame, moment.time);
    addPose(hashed, moment.pose);
    hashed.add(moment.shutter.perSample);
    for (const Pose& pose : moment.shutter.poses) addPose(hashed, pose);
    for (const glm::dmat4& worldFromCamera : moment.view.shutterCameras) hashed.add(worldFromCamera);
    for (const PlacedLight& placed : moment.lights) {
        const Light& light = placed.light;
        hashed.add(placed.position);
        hashed.add(placed.direction);
        hashed.add(light.color.r, light.color.g, light.color.b, light.intensity, light.range, light.innerConeAngle,
                   light.outerConeAngle, light.angularDiameter, light.radius);
    }
    hashed.add(moment.view.worldFromCamera);
    hashed.add(moment.view.nearPlane, moment.view.width, moment.view.height);
    addLens(hashed, moment.view.lens);
    for (const auto& [name, value] : moment.view.methodValues) hashed.add(name, value);
    Request drawn = film.request;
    drawn.method = chosenMethod(film.request).method->name;
    hashed.add(pixelSettings(drawn));
    hashed.add(moment.settings.seed);
    const LodThresholds thresholds =
        chosenThresholds(moment.settings.thresholds, moment.settings.metric, positionCount(moment.settings));
    hashed.add(moment.settings.firstSample, thresholds.blur, thresholds.size, thresholds.light);
    return hashed.hash();
}

}  // namespace defocus::engine
