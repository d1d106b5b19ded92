// The default camera's orientation is fixed. Each of the four side planes of its frustum is moved until it touches the
// scene's bounding box; the camera's position follows in closed form.
#include "scene/defaults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "core/error.h"
#include "core/suggestion.h"

namespace defocus::engine {

namespace {

constexpr double framingTangent = 18.0 / 50.0;  // tangent of half a 50 mm lens's angle of view, along the longer side
constexpr double framingFill = 0.94;  // max fraction of the image's width and height that the bounding box fills
constexpr double framingAzimuth = glm::radians(30.0);  // camera azimuth from +z, the models' front, towards +x
constexpr double framingElevation = glm::radians(18.0);
constexpr std::string_view framingName = "auto";

// ---- cameras ------------------------------------------------------------------------------------

struct CameraNode {
    const Node* node;
    const Camera* camera;
    std::size_t index;
};

// Returns the nodes that have a camera, with their cameras, in file order.
std::vector<CameraNode> cameraNodes(const Scene& scene, const std::vector<Camera>& cameras) {
    std::vector<CameraNode> result;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].camera >= 0)
            result.push_back({&scene.nodes[i], &cameras[static_cast<std::size_t>(scene.nodes[i].camera)], i});
    return result;
}

// Returns a camera node's matrix without scale, shear and mirroring. The position and the viewing direction do not
// change; the up vector is made perpendicular to the viewing direction.
glm::dmat4 withoutScale(const glm::dmat4& world) {
    const auto unit = [](const glm::dvec3& vector, const glm::dvec3& otherwise) {
        const double length = glm::length(vector);
        return length > 0 && std::isfinite(length) ? vector / length : otherwise;
    };
    const glm::dvec3 z = unit(glm::dvec3(world[2]), {0, 0, 1});
    const glm::dvec3 aside = std::abs(z.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
    const glm::dvec3 x = unit(glm::cross(glm::dvec3(world[1]), z), glm::normalize(glm::cross(aside, z)));
    const glm::dvec3 y = glm::cross(z, x);
    return {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), world[3]};
}

// Places a camera from a separate file (a camera track) for an image of `aspect` = width / height.
PlacedCamera trackedCamera(const TrackedCamera& tracked, double aspect) {
    PlacedCamera placed{tracked.camera, withoutScale(tracked.worldFromCamera), -1, true};
    if (tracked.showsSensor && tracked.camera.physical) {
        const PhysicalCamera& physical = *tracked.camera.physical;
        const double height = std::max(physical.sensorSize.y, physical.sensorSize.x / aspect);
        placed.camera.yfov = 2 * std::atan(height / (2 * physical.focalLength));
    }
    return placed;
}

PlacedCamera framingCamera(const Bounds& sceneBounds, double aspect, std::optional<double> tanHalfHorizontal) {
    Bounds bounds = sceneBounds;
    if (bounds.empty()) bounds = {glm::dvec3(-1), glm::dvec3(1)};
    const double largest = std::max({bounds.size().x, bounds.size().y, bounds.size().z});
    const double radius = std::max(0.5 * largest, 1e-6);

    const glm::dvec3 z(std::sin(framingAzimuth) * std::cos(framingElevation), std::sin(framingElevation),
                       std::cos(framingAzimuth) * std::cos(framingElevation));
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), z));
    const glm::dvec3 y = glm::cross(z, x);
    const double tangentX = tanHalfHorizontal.value_or(framingTangent * std::min(aspect, 1.0));
    const double tangentY = tangentX / aspect;

    // Coordinates are in camera axes, relative to the bounding box's centre. The right plane of a camera at p, with
    // tangent t of half the angle of view, keeps a corner c visible if c.x − p.x ≤ (p.z − c.z)·t. Hence p.x + t·p.z ≥
    // c.x + t·c.z. The other three planes follow by symmetry.
    const double tx = framingFill * tangentX;
    const double ty = framingFill * tangentY;
    double right = 0, left = 0, top = 0, bottom = 0;
    double front = 0;
    for (const glm::dvec3& corner : bounds.corners()) {
        const glm::dvec3 offset = corner - bounds.centre();
        const glm::dvec3 c(glm::dot(offset, x), glm::dot(offset, y), glm::dot(offset, z));
        right = std::max(right, c.x + tx * c.z);
        left = std::max(left, -c.x + tx * c.z);
        top = std::max(top, c.y + ty * c.z);
        bottom = std::max(bottom, -c.y + ty * c.z);
        front = std::max(front, c.z);
    }
    const double distance =
        std::max({(right + left) / (2 * tx), (top + bottom) / (2 * ty), front + 0.1 * radius, 2 * radius});

    PlacedCamera placed;
    placed.camera.name = framingName;
    placed.camera.yfov = 2 * std::atan(tangentY);
    placed.camera.aspectRatio = aspect;
    placed.camera.znear = std::max(0.1 * (distance - front), 1e-3 * radius);
    const glm::dvec3 position = bounds.centre() + 0.5 * (right - left) * x + 0.5 * (top - bottom) * y + distance * z;
    placed.worldFromCamera = {glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(position, 1)};
    return placed;
}

std::string labelOf(const CameraNode& place) {
    if (!place.camera->name.empty()) return place.camera->name;
    return !place.node->name.empty() ? place.node->name : "(no name)";
}

[[noreturn]] void failForCamera(const std::vector<CameraNode>& places, const std::string& name) {
    std::vector<std::string> names;
    names.reserve(places.size());
    for (const CameraNode& place : places) names.push_back(labelOf(place));
    std::string help = "; the scene has no cameras; leave out the camera name to frame the scene";
    if (const std::string nearest = nearestWord(name, names); !nearest.empty())
        help = fmt::format("; did you mean '{}'?", nearest);
    else if (!names.empty())
        help = fmt::format("; the scene has: {}, {} (frames the scene)", fmt::join(names, ", "), framingName);
    throw MissingName(name, fmt::format("there is no camera '{}'{}", name, help));
}

// Returns the camera whose own name or whose node's name is `name`; nullptr if there is none.
const CameraNode* cameraNamed(const std::vector<CameraNode>& places, const std::string& name) {
    std::vector<std::string> names;
    for (const CameraNode& place : places) {
        names.push_back(place.camera->name);
        names.push_back(place.node->name);
    }
    const auto place = placeOfName(name, names);
    return place ? &places[*place / 2] : nullptr;
}

// ---- lights -------------------------------------------------------------------------------------

// Returns whether the material is unlit or has a uniform emissive colour, so that it is visible without lights.
bool selfLit(const Material& material) {
    const float brightest = std::max({material.emissiveFactor.r, material.emissiveFactor.g, material.emissiveFactor.b});
    return material.unlit || (brightest > 0 && !material.emissive.used());
}

bool everythingSelfLit(const Scene& scene, const Pose& pose) {
    bool anything = false;
    for (const Object& object : pose.objects)
        for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(object.mesh)].primitives) {
            anything = true;
            if (!selfLit(materialAt(scene, primitive.material))) return false;
        }
    return anything;
}

PlacedLight placedAt(const StudioLight& studio, const PlacedCamera& camera, const glm::dvec3& position) {
    PlacedLight placed;
    placed.light = {studio.name, LightType::directional, studio.color, studio.illuminance};
    placed.light.angularDiameter = static_cast<float>(studio.angularDiameter);
    placed.direction = -glm::normalize(glm::dvec3(camera.worldFromCamera * glm::dvec4(studio.toLight(), 0)));
    placed.position = position;
    return placed;
}

}  // namespace

PlacedCamera chooseCamera(const Scene& scene, const Pose& pose, const CameraChoice& choice, double aspect,
                          std::optional<double> tanHalfHorizontal) {
    const bool posed = pose.cameras.size() == scene.cameras.size();
    const std::vector<CameraNode> places = cameraNodes(scene, posed ? pose.cameras : scene.cameras);
    if (std::holds_alternative<FramingCamera>(choice)) return framingCamera(pose.bounds, aspect, tanHalfHorizontal);

    if (pose.tracked && std::holds_alternative<FirstCamera>(choice)) return trackedCamera(*pose.tracked, aspect);

    const CameraNode* chosen = nullptr;
    if (const auto* const named = std::get_if<NamedCamera>(&choice)) {
        chosen = cameraNamed(places, named->name);
        if (chosen == nullptr) failForCamera(places, named->name);
    } else {
        const auto usable =
            std::ranges::find_if(places, [](const CameraNode& place) { return !place.camera->orthographic; });
        if (usable != places.end()) chosen = &*usable;
    }
    if (chosen == nullptr) return framingCamera(pose.bounds, aspect, tanHalfHorizontal);
    if (chosen->camera->orthographic)
        fail("camera '{}' cannot be used: {}; choose another camera, or '{}' to frame the scene", labelOf(*chosen),
             *chosen->camera->orthographic, framingName);
    return {*chosen->camera, withoutScale(pose.worldFromNode[chosen->index]), static_cast<int>(chosen->index), false};
}

glm::dmat4 worldFromCameraIn(const PlacedCamera& camera, const Pose& pose) {
    if (camera.tracked && pose.tracked) return withoutScale(pose.tracked->worldFromCamera);
    return camera.node < 0 ? camera.worldFromCamera
                           : withoutScale(pose.worldFromNode[static_cast<std::size_t>(camera.node)]);
}

glm::dvec3 StudioLight::toLight() const {
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation)};
}

std::span<const StudioLight> studioLights() {
    // The illuminances are calibrated together with the default sky: a diffuse ball of 18 % reflectance has an average
    // display value of 18 % of white.
    static const std::array<StudioLight, 3> lights = {{
        {"key", glm::radians(-42.0), glm::radians(38.0), {1.0f, 0.96f, 0.90f}, 2.6f, glm::radians(12.0)},
        {"fill", glm::radians(55.0), glm::radians(12.0), {0.88f, 0.94f, 1.0f}, 0.8f, glm::radians(30.0)},
        {"rim", glm::radians(155.0), glm::radians(35.0), {1.0f, 1.0f, 1.0f}, 2.2f, glm::radians(10.0)},
    }};
    return lights;
}

std::vector<PlacedLight> lightsOrDefault(const Scene& scene, const Pose& pose, const PlacedCamera& camera) {
    if (!pose.lights.empty()) return pose.lights;
    if (everythingSelfLit(scene, pose)) return {};
    const glm::dvec3 centre = pose.bounds.empty() ? glm::dvec3(0) : pose.bounds.centre();
    std::vector<PlacedLight> lights;
    for (const StudioLight& light : studioLights()) lights.push_back(placedAt(light, camera, centre));
    return lights;
}

double skyScale(const Pose& pose) {
    constexpr double skyIlluminance = 1.36;  // lux on an upward-facing surface under the sky of environmentOrDefault
    constexpr double share = 1.0 / 7;
    const glm::dvec3 middle = pose.bounds.empty() ? glm::dvec3(0) : pose.bounds.centre();
    const double radius = pose.bounds.empty() ? 0 : 0.5 * glm::length(pose.bounds.size());
    double illuminance = 0;
    for (const PlacedLight& placed : pose.lights) {
        const glm::vec3& color = placed.light.color;
        const double brightness = placed.light.intensity * glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f));
        const double distance = std::max(glm::distance(placed.position, middle), std::max(radius, 1e-6));
        illuminance += placed.light.type == LightType::directional ? brightness : brightness / (distance * distance);
    }
    const double scale = share * illuminance / skyIlluminance;
    return std::isfinite(scale) ? std::max(scale, 1.0) : 1;
}

Environment environmentOrDefault(const Scene& scene) {
    if (scene.environment) return *scene.environment;
    // Bright neutral studio: a bright wall all around, between a dark floor and a dark ceiling, which smooth metals
    // reflect as bands. `lighting` > 1 makes the sky light the scene more strongly than its background radiance
    // suggests.
    Environment sky;
    sky.type = EnvironmentType::gradient;
    sky.zenith = {0.12f, 0.13f, 0.15f};
    sky.horizon = {0.59f, 0.605f, 0.63f};
    sky.nadir = {0.04f, 0.04f, 0.04f};
    sky.lighting = 1.5f;
    return sky;
}

}  // namespace defocus::engine
