#include "scene/camera_files/usda_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <numbers>
#include <utility>

#include "core/error.h"
#include "scene/camera_files/usda_values.h"

namespace defocus::engine {

namespace {

// Max plausible sensor width in mm. If USD's unit (tenths of the layer's unit) gives a wider sensor, focal length and
// sensor size are read as mm instead.
constexpr double widestSensor = 1000;
// Default of the layer entry metersPerUnit: the layer's unit is 1 cm, so USD's tenths of a unit are mm.
constexpr double plainUnit = 0.01;
constexpr const char* lensPrefix = "defocus:";

// A camera with its ancestors, from the root to the camera.
using PrimPath = std::vector<const UsdPrim*>;

void collectCameras(const UsdPrim& prim, PrimPath& path, std::vector<PrimPath>& cameras) {
    path.push_back(&prim);
    if (prim.type == "Camera") cameras.push_back(path);
    for (const UsdPrim& child : prim.children) collectCameras(child, path, cameras);
    path.pop_back();
}

std::string pathText(const PrimPath& path) {
    std::string text;
    for (const UsdPrim* prim : path) text += "/" + prim->name;
    return text;
}

std::string listOf(const std::vector<PrimPath>& cameras) {
    constexpr std::size_t most = 10;
    std::string list;
    for (std::size_t i = 0; i < std::min(cameras.size(), most); ++i) list += (i > 0 ? ", " : "") + pathText(cameras[i]);
    return cameras.size() > most ? list + ", …" : list;
}

bool hasArcs(const UsdPrim& prim) {
    return !prim.arcs.empty() || std::ranges::any_of(prim.children, hasArcs);
}

// Returns advice for the error message of a layer whose content comes from other files; empty for other layers.
std::string arcsAdvice(const UsdLayer& layer) {
    if (!layer.metadata.contains("subLayers") && std::ranges::none_of(layer.prims, hasArcs)) return "";
    return "; content of other layers, references and variants is not read; write all layers to one file with: usdcat "
           "--flatten FILE -o shot.usda";
}

// Returns the camera whose path or name is `chosen`; if `chosen` is empty, the layer's only camera.
PrimPath chosenCamera(const UsdLayer& layer, const std::string& chosen, const std::string& file) {
    std::vector<PrimPath> cameras;
    PrimPath scratch;
    for (const UsdPrim& prim : layer.prims) collectCameras(prim, scratch, cameras);
    if (cameras.empty()) fail("{}: the file has no camera{}", file, arcsAdvice(layer));
    std::vector<PrimPath> found;
    for (const PrimPath& camera : cameras)
        if (chosen.empty() || chosen == pathText(camera) || chosen == camera.back()->name) found.push_back(camera);
    if (found.empty())
        fail("{}: there is no camera {}; the cameras are: {}{}", file, chosen, listOf(cameras), arcsAdvice(layer));
    if (found.size() > 1)
        fail("{}: the file has several cameras{}: {}; give a path, such as {}:{}", file,
             chosen.empty() ? "" : " of the name " + chosen, listOf(found), file, pathText(found.front()));
    return found.front();
}

struct Stage {
    double metresPerUnit = plainUnit;
    double timeCodesPerSecond = 24;
    bool zUp = false;
};

Stage stageOf(const UsdLayer& layer, const std::string& file) {
    Stage stage;
    const auto number = [&](const char* name, double otherwise) {
        const auto found = layer.metadata.find(name);
        if (found == layer.metadata.end()) return otherwise;
        const std::vector<double>& numbers = found->second.numbers;
        if (numbers.size() != 1 || !(numbers[0] > 0) || !std::isfinite(numbers[0]))
            fail("{}: {} must be a number above 0", file, name);
        return numbers[0];
    };
    stage.metresPerUnit = number("metersPerUnit", stage.metresPerUnit);
    stage.timeCodesPerSecond = number("timeCodesPerSecond", number("framesPerSecond", stage.timeCodesPerSecond));
    if (const auto axis = layer.metadata.find("upAxis"); axis != layer.metadata.end() && !axis->second.texts.empty()) {
        const std::string& name = axis->second.texts.front();
        if (name != "Y" && name != "Z") fail("{}: upAxis must be Y or Z, not {}", file, name);
        stage.zUp = name == "Z";
    }
    return stage;
}

class CameraReader {
public:
    CameraReader(std::shared_ptr<const UsdLayer> layer, const std::string& path, const std::string& file)
        : layer_(std::move(layer)),
          path_(chosenCamera(*layer_, path, file)),
          where_(file + ": " + pathText(path_)),
          stage_(stageOf(*layer_, file)) {
        const double width = number("horizontalAperture", 0, 20.955) * stage_.metresPerUnit * 100;
        if (width > widestSensor) tenthMillimetres_ = 1;
    }

    [[nodiscard]] TrackedCamera at(double seconds) const {
        const double time = seconds * stage_.timeCodesPerSecond;
        TrackedCamera tracked;
        tracked.worldFromCamera = worldFromCamera(time);
        tracked.showsSensor = true;
        Camera& camera = tracked.camera;
        camera.name = path_.back()->name;
        PhysicalCamera physical;
        physical.focalLength = length("focalLength", time, 50);
        physical.sensorSize = {length("horizontalAperture", time, 20.955), length("verticalAperture", time, 15.2908)};
        camera.physical = physical;
        camera.yfov = 2 * std::atan(physical.sensorSize.y / (2 * physical.focalLength));
        camera.aspectRatio = physical.sensorSize.x / physical.sensorSize.y;
        const auto clipping = usdNumbers(prim(), "clippingRange", 2, time, where_);
        camera.znear = (clipping ? clipping->front() : 1) * stage_.metresPerUnit;
        if (!(camera.znear > 0)) fail("{}: clippingRange must begin above 0", where_);
        readLens(time, camera);
        return tracked;
    }

    [[nodiscard]] bool moves() const {
        return std::ranges::any_of(path_, [](const UsdPrim* prim) {
            return std::ranges::any_of(prim->attributes,
                                       [](const auto& entry) { return entry.second.samples.size() > 1; });
        });
    }

    [[nodiscard]] std::optional<ShutterInterval> shutter() const {
        if (!prim().attributes.contains("shutter:open") && !prim().attributes.contains("shutter:close")) return {};
        const double open = number("shutter:open", 0, 0) / stage_.timeCodesPerSecond;
        const double close = number("shutter:close", 0, 0) / stage_.timeCodesPerSecond;
        if (close < open) fail("{}: shutter:close must not be before shutter:open", where_);
        return ShutterInterval{open, close};
    }

    void check() const {
        if (prim().specifier != "def")
            fail("{}: the camera is declared only as {} '{}'; the file has no 'def' for it{}", where_,
                 prim().specifier == "over" ? "an" : "a", prim().specifier, arcsAdvice(*layer_));
        if (const std::string projection = usdText(prim(), "projection");
            !projection.empty() && projection != "perspective")
            fail("{}: a camera with {} projection cannot be used; only perspective cameras can", where_, projection);
    }

    [[nodiscard]] std::vector<std::string> warnings() const {
        std::vector<std::string> lines;
        for (const UsdPrim* each : path_)
            for (const std::string& arc : each->arcs)
                lines.push_back(
                    fmt::format("{}: {} of {} are not read; write all layers to one file with: usdcat "
                                "--flatten FILE -o shot.usda",
                                where_, arc, each->name));
        for (const char* name : {"horizontalApertureOffset", "verticalApertureOffset"})
            if (number(name, 0, 0) != 0)
                lines.push_back(fmt::format(
                    "{}: {} is ignored; the optical axis always passes through the image centre", where_, name));
        if (prim().attributes.contains("clippingPlanes") &&
            !prim().attributes.at("clippingPlanes").value.numbers.empty())
            lines.push_back(fmt::format("{}: clippingPlanes are ignored", where_));
        if (tenthMillimetres_)
            lines.push_back(
                fmt::format("{}: USD gives focal length and apertures in tenths of a scene unit, so the sensor would "
                            "be {:.3g} m wide; they are read as millimetres instead",
                            where_, number("horizontalAperture", 0, 20.955) * stage_.metresPerUnit / 10));
        if (number("fStop", 0, 0) == 0)
            lines.push_back(fmt::format(
                "{}: the camera has no fStop, so there is no depth of field; add --dof and --fstop N for blur",
                where_));
        return lines;
    }

private:
    [[nodiscard]] const UsdPrim& prim() const { return *path_.back(); }

    [[nodiscard]] double number(const char* name, double time, double otherwise) const {
        return usdNumber(prim(), name, time, otherwise, where_);
    }

    // Returns a length of the lens or the sensor, in mm. USD stores these lengths in tenths of the layer's unit.
    [[nodiscard]] double length(const char* name, double time, double otherwise) const {
        const double value = number(name, time, otherwise) * tenthMillimetres_.value_or(stage_.metresPerUnit * 100);
        if (!(value > 0)) fail("{}: {} must be above 0", where_, name);
        return value;
    }

    void readLens(double time, Camera& camera) const {
        const double fStop = number("fStop", time, 0);
        if (fStop < 0) fail("{}: fStop must not be below 0", where_);
        if (fStop > 0)
            camera.lens["fStop"] = fStop;
        else
            camera.lens["dofEnabled"] = 0;
        const double distance = number("focusDistance", time, 0) * stage_.metresPerUnit;
        if (distance < 0) fail("{}: focusDistance must not be below 0", where_);
        if (distance > 0) camera.lens["focusDistance"] = distance;
        for (const auto& [name, attribute] : prim().attributes)
            if (name.starts_with(lensPrefix)) {
                const std::string_view lensName = std::string_view(name).substr(std::string_view(lensPrefix).size());
                camera.lens[std::string(lensName)] = number(name.c_str(), time, 0);
            }
    }

    // Returns the camera's matrix in metres, y up. The matrix may contain scale, which chooseCamera removes.
    [[nodiscard]] glm::dmat4 worldFromCamera(double time) const {
        glm::dmat4 world(1.0);
        for (const UsdPrim* each : path_) {
            const UsdTransform transform = usdTransform(*each, time, where_);
            world = transform.resetsStack ? transform.parentFromPrim : world * transform.parentFromPrim;
        }
        glm::dmat4 metres = glm::scale(glm::dmat4(1.0), glm::dvec3(stage_.metresPerUnit));
        if (stage_.zUp) metres = glm::rotate(metres, -std::numbers::pi / 2, glm::dvec3(1, 0, 0));
        world = metres * world;
        if (const double size = std::abs(glm::determinant(glm::dmat3(world))); !(size > 0) || !std::isfinite(size))
            fail("{}: the transform of the camera has no inverse", where_);
        return world;
    }

    std::shared_ptr<const UsdLayer> layer_;
    PrimPath path_;
    std::string where_;
    Stage stage_;
    // Size in mm of the unit of focal length and sensor size. nullopt: a tenth of the layer's unit.
    std::optional<double> tenthMillimetres_;
};

}  // namespace

CameraTrack usdCamera(UsdLayer layer, const std::string& path, const std::string& file) {
    const auto reader =
        std::make_shared<const CameraReader>(std::make_shared<const UsdLayer>(std::move(layer)), path, file);
    reader->check();
    static_cast<void>(reader->at(0));
    CameraTrack track;
    track.at = [reader](double seconds) { return reader->at(seconds); };
    track.moves = reader->moves();
    track.shutter = reader->shutter();
    track.warnings = reader->warnings();
    return track;
}

}  // namespace defocus::engine
