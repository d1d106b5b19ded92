// Native module `_defocus` of the Python package `defocus`: a one-to-one binding of the C++ API. defocus/__init__.py
// adds the Python interface.
//
// Images are passed without copies: returned arrays own pixels allocated in C++, and arguments are read in place. The
// GIL is released during all long-running calls.

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "defocus/defocus.h"

namespace py = pybind11;
using namespace py::literals;

namespace {

// ---- progress and signals -------------------------------------------------------------------------------------------

// Progress function of the Python caller; empty for None.
using Listener = std::function<void(const std::string& stage, std::uint64_t done, std::uint64_t total)>;

// Returns a progress function that calls `listener`, and that lets Ctrl-C cancel the operation: Python handles signals
// only in PyErr_CheckSignals.
defocus::Progress listening(const Listener& listener) {
    return [listener](std::string_view stage, std::uint64_t done, std::uint64_t total) {
        const py::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (listener) listener(std::string(stage), done, total);
    };
}

// ---- images ---------------------------------------------------------------------------------------------------------

using Array = py::array_t<float>;

// Returns a NumPy array that owns the image's pixels: H×W for one channel, else H×W×channels.
Array arrayOf(defocus::Image&& image) {
    auto owner = std::make_unique<defocus::Image>(std::move(image));
    std::vector<py::ssize_t> shape = {owner->height, owner->width};
    if (owner->channels > 1) shape.push_back(owner->channels);
    float* const pixels = owner->pixels.data();
    const py::capsule keeper(owner.get(), [](void* kept) { delete static_cast<defocus::Image*>(kept); });
    static_cast<void>(owner.release());  // the capsule owns the image now
    return Array(shape, pixels, keeper);
}

// Returns whether an ImageView can read the array in place.
bool isViewable(const Array& array) {
    constexpr py::ssize_t step = sizeof(float);
    for (py::ssize_t axis = 0; axis < 2; ++axis)
        if (array.strides(axis) <= 0 || array.strides(axis) % step != 0) return false;
    return array.ndim() == 2 || array.shape(2) == 1 || array.strides(2) == step;
}

// Returns a view of the array's pixels without a copy; it is valid as long as the array exists. The package passes
// arrays with 2 or 3 axes whose strides are positive and whose channels are contiguous.
defocus::ImageView viewOf(const Array& array) {
    if (array.ndim() != 2 && array.ndim() != 3) return {};
    if (array.size() == 0) return {};
    if (!isViewable(array)) throw py::type_error("an image needs positive strides and contiguous channels");
    const auto height = static_cast<std::size_t>(array.shape(0));
    const auto width = static_cast<std::size_t>(array.shape(1));
    const std::size_t channels = array.ndim() == 3 ? static_cast<std::size_t>(array.shape(2)) : 1;
    const defocus::ImageStrides strides{static_cast<std::size_t>(array.strides(1)) / sizeof(float),
                                        static_cast<std::size_t>(array.strides(0)) / sizeof(float)};
    const std::size_t values = (height - 1) * strides.row + (width - 1) * strides.pixel + channels;
    return {static_cast<int>(width), static_cast<int>(height), static_cast<int>(channels),
            std::span(array.data(), values), strides};
}

// ---- scenes and renderers -------------------------------------------------------------------------------------------

// A scene and its SceneInfo, which is computed only once.
struct OpenScene {
    defocus::Scene scene;
    defocus::SceneInfo info = scene.info();
};

// Object of the library that several Python threads may use; a mutex serializes their calls. `noun` is the object's
// name in error messages.
template <typename Object>
class Shared {
public:
    Shared(const char* noun, Object&& object) : noun_(noun), object_(std::move(object)) {}

    // Calls `use` with the object while the GIL is released. Throws UsageError if the object is closed.
    template <typename Use>
    auto with(const Use& use) {
        const Turn turn(*this);
        if (!object_) throw defocus::UsageError("the " + noun_ + " is closed");
        return use(*object_);
    }

    void close() {
        const Turn turn(*this);
        object_.reset();
    }

private:
    // Throws UsageError if this thread already uses the object, because waiting for its own call would be a deadlock.
    void refuseReentry() const {
        if (user_ == std::this_thread::get_id())
            throw defocus::UsageError("a " + noun_ + " cannot be used from its own progress function");
    }

    struct Turn {
        explicit Turn(Shared& shared) : shared_((shared.refuseReentry(), shared)) {
            shared_.user_ = std::this_thread::get_id();
        }
        ~Turn() { shared_.user_ = std::thread::id(); }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;

        Shared& shared_;
        py::gil_scoped_release unlocked_;
        std::scoped_lock<std::mutex> lock_{shared_.mutex_};
    };

    std::string noun_;
    std::optional<Object> object_;
    std::mutex mutex_;
    std::atomic<std::thread::id> user_ = std::thread::id();
};

using SharedRenderer = Shared<defocus::SceneRenderer>;
using SharedLightField = Shared<defocus::LightField>;

// ---- module ---------------------------------------------------------------------------------------------------------

void defineErrors(py::module_& package) {
    // UsageError also derives from TypeError and ValueError, which Python callers expect for unknown keywords and
    // invalid values.
    const auto& error = py::register_exception<defocus::Error>(package, "Error", PyExc_RuntimeError);
    const auto& usageError = py::register_exception<defocus::UsageError>(
        package, "UsageError",
        py::make_tuple(py::handle(error), py::handle(PyExc_TypeError), py::handle(PyExc_ValueError)));
    error.attr("__module__") = "defocus";
    usageError.attr("__module__") = "defocus";
}

void defineRequest(py::module_& package) {
    using defocus::SettingInfo;
    using defocus::SettingKind;
    py::enum_<SettingKind>(package, "SettingKind")
        .value("number", SettingKind::number)
        .value("integer", SettingKind::integer)
        .value("boolean", SettingKind::boolean)
        .value("text", SettingKind::text)
        .value("path", SettingKind::path)
        .value("choice", SettingKind::choice)
        .value("other", SettingKind::other);
    py::class_<SettingInfo>(package, "SettingInfo")
        .def_readonly("name", &SettingInfo::name)
        .def_readonly("keyword", &SettingInfo::keyword)
        .def_readonly("option", &SettingInfo::option)
        .def_readonly("group", &SettingInfo::group)
        .def_readonly("kind", &SettingInfo::kind)
        .def_readonly("metavar", &SettingInfo::metavar)
        .def_readonly("unit", &SettingInfo::unit)
        .def_readonly("min", &SettingInfo::min)
        .def_readonly("max", &SettingInfo::max)
        .def_readonly("choices", &SettingInfo::choices)
        .def_readonly("help", &SettingInfo::help)
        .def_readonly("default_value", &SettingInfo::defaultValue)
        .def_readonly("excludes", &SettingInfo::excludes)
        .def_property_readonly("array_separator",
                               [](const SettingInfo& info) {
                                   return std::string(1, info.arraySeparator == 0 ? ',' : info.arraySeparator);
                               })
        .def_readonly("repeated", &SettingInfo::repeated)
        .def_readonly("methods", &SettingInfo::methods);
    package.def("setting_infos", &defocus::settingInfos);
    py::class_<defocus::Request>(package, "Request").def(py::init<>()).def("set", &defocus::setSetting);
}

void defineImages(py::module_& package) {
    using defocus::Difference;
    package.def("read_image", [](const std::filesystem::path& path) {
        const auto read = [&] {
            const py::gil_scoped_release unlocked;
            return defocus::readImage(path);
        };
        return arrayOf(read());
    });
    package.def(
        "write_image",
        [](const std::filesystem::path& path, const Array& image, const defocus::Request& request) {
            const defocus::ImageView view = viewOf(image);
            const auto* const exposure = std::get_if<defocus::ExposureValue>(&request.exposure);
            const py::gil_scoped_release unlocked;
            defocus::writeImage(path, view, {request.toneMap, exposure != nullptr ? exposure->ev : 0});
        },
        "path"_a, py::arg("image").noconvert(), "request"_a);
    package.def(
        "compare",
        [](const Array& reference, const Array& test) {
            const defocus::ImageView a = viewOf(reference);
            const defocus::ImageView b = viewOf(test);
            const py::gil_scoped_release unlocked;
            return defocus::compareImages(a, b);
        },
        py::arg("reference").noconvert(), py::arg("test").noconvert());
    py::class_<Difference>(package, "Difference")
        .def_readonly("mae", &Difference::mae)
        .def_readonly("rmse", &Difference::rmse)
        .def_readonly("psnr", &Difference::psnr)
        .def_readonly("ssim", &Difference::ssim)
        .def_readonly("flip", &Difference::flip)
        .def_readonly("max_error", &Difference::maxError)
        .def_property_readonly("max_error_pixel",
                               [](const Difference& difference) {
                                   return std::pair(difference.maxErrorPixel.column, difference.maxErrorPixel.row);
                               })
        .def_readonly("pixel_count", &Difference::pixelCount)
        .def_readonly("non_finite", &Difference::nonFinite);
}

void defineScenes(py::module_& package) {
    py::class_<OpenScene>(package, "Scene",
                          "A glTF scene that is loaded once for many renders; accepted in place of a path.")
        .def(py::init([](const std::filesystem::path& path, const std::string& variant, const Listener& progress) {
                 const py::gil_scoped_release unlocked;
                 return OpenScene{defocus::Scene::load(path, listening(progress), variant)};
             }),
             "path"_a, py::kw_only(), "variant"_a = "", "progress"_a = py::none(),
             "Reads a .gltf or .glb file, with a variant of its materials if one is named.")
        .def_static(
            "school_of_fish",
            [](int fishCount, int trianglesPerFish, const Listener& progress) {
                const py::gil_scoped_release unlocked;
                return OpenScene{defocus::Scene::schoolOfFish(fishCount, trianglesPerFish, listening(progress))};
            },
            "fish_count"_a = 20, "triangles_per_fish"_a = 90'000, py::kw_only(), "progress"_a = py::none(),
            "Returns the built-in school of 1 to 10,000 fish.")
        .def_property_readonly("name", [](const OpenScene& scene) { return scene.info.name; })
        .def_property_readonly(
            "cameras", [](const OpenScene& scene) { return scene.info.cameras; },
            "Names of the cameras; empty strings for unnamed cameras.")
        .def_property_readonly("nodes", [](const OpenScene& scene) { return scene.info.nodes; })
        .def_property_readonly(
            "clips", [](const OpenScene& scene) { return scene.info.clips; }, "Names of the animations.")
        .def_property_readonly(
            "variants", [](const OpenScene& scene) { return scene.info.variants; },
            "Names of the variants of materials.")
        .def_property_readonly(
            "triangles", [](const OpenScene& scene) { return scene.info.triangles; },
            "Number of triangles of all meshes, each mesh counted once.")
        .def_property_readonly(
            "ignored", [](const OpenScene& scene) { return scene.info.ignored; },
            "Parts of the file that are not drawn, with the reason: one line for each part.")
        .def("__repr__",
             [](const OpenScene& scene) {
                 return "<defocus.Scene '" + scene.info.name + "': " + std::to_string(scene.info.triangles) +
                        " triangles>";
             })
        .attr("__module__") = "defocus";
}

using PackedArray = py::array_t<float, py::array::c_style>;

// Arrays of a mesh, which stay alive until the scene has copied them.
struct MeshArrays {
    std::string name;
    int material = -1;
    PackedArray positions, normals, uvs, colors;
    py::array_t<std::uint32_t, py::array::c_style> indices;
};

struct TextureArray {
    defocus::TextureData data;
    Array image;
};

// Returns the rows of an N × count array; empty if the array has another number of columns.
template <std::size_t count>
std::span<const std::array<float, count>> rowsOf(const PackedArray& array) {
    if (array.ndim() != 2 || array.shape(1) != static_cast<py::ssize_t>(count)) return {};
    return {reinterpret_cast<const std::array<float, count>*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

OpenScene createScene(const std::vector<MeshArrays>& meshArrays, const std::vector<defocus::MaterialData>& materials,
                      const std::vector<TextureArray>& textureArrays,
                      const std::vector<defocus::InstanceData>& instances,
                      const std::vector<defocus::CameraData>& cameras, const std::vector<defocus::LightData>& lights,
                      const std::string& name, double metresPerUnit) {
    std::vector<defocus::MeshData> meshes;
    for (const MeshArrays& mesh : meshArrays)
        meshes.push_back(
            {mesh.name, rowsOf<3>(mesh.positions), rowsOf<3>(mesh.normals), rowsOf<2>(mesh.uvs), rowsOf<4>(mesh.colors),
             std::span(mesh.indices.data(), static_cast<std::size_t>(mesh.indices.size())), mesh.material});
    std::vector<defocus::TextureData> textures;
    for (const TextureArray& texture : textureArrays) {
        textures.push_back(texture.data);
        textures.back().image = viewOf(texture.image);
    }
    const py::gil_scoped_release unlocked;
    return OpenScene{
        defocus::Scene::create({name, meshes, materials, textures, instances, cameras, lights, metresPerUnit})};
}

// Binds the structs of a SceneData. Python fills them from the classes of defocus/_scene_data.py.
void defineSceneData(py::module_& package) {
    using defocus::AlphaMode;
    using defocus::CameraData;
    using defocus::InstanceData;
    using defocus::LightData;
    using defocus::LightType;
    using defocus::MaterialData;
    using defocus::TextureContent;
    using defocus::TextureData;
    using defocus::TextureFilter;
    using defocus::TextureWrap;
    py::enum_<TextureContent>(package, "TextureContent")
        .value("color", TextureContent::color)
        .value("data", TextureContent::data);
    py::enum_<TextureWrap>(package, "TextureWrap")
        .value("repeat", TextureWrap::repeat)
        .value("clamp_to_edge", TextureWrap::clampToEdge)
        .value("mirrored_repeat", TextureWrap::mirroredRepeat);
    py::enum_<TextureFilter>(package, "TextureFilter")
        .value("nearest", TextureFilter::nearest)
        .value("linear", TextureFilter::linear);
    py::enum_<AlphaMode>(package, "AlphaMode")
        .value("opaque", AlphaMode::opaque)
        .value("mask", AlphaMode::mask)
        .value("blend", AlphaMode::blend);
    py::enum_<LightType>(package, "LightType")
        .value("directional", LightType::directional)
        .value("point", LightType::point)
        .value("spot", LightType::spot);
    py::class_<MeshArrays>(package, "MeshData")
        .def(py::init<>())
        .def_readwrite("name", &MeshArrays::name)
        .def_readwrite("material", &MeshArrays::material)
        .def_readwrite("positions", &MeshArrays::positions)
        .def_readwrite("normals", &MeshArrays::normals)
        .def_readwrite("uvs", &MeshArrays::uvs)
        .def_readwrite("colors", &MeshArrays::colors)
        .def_readwrite("indices", &MeshArrays::indices);
    const auto ofTexture = [](auto TextureData::*member) {
        using Value = std::decay_t<decltype(std::declval<TextureData>().*member)>;
        return [member](TextureArray& texture, Value value) { texture.data.*member = std::move(value); };
    };
    py::class_<TextureArray>(package, "TextureData")
        .def(py::init<>())
        .def_readwrite("image", &TextureArray::image)
        .def_property("name", nullptr, ofTexture(&TextureData::name))
        .def_property("content", nullptr, ofTexture(&TextureData::content))
        .def_property("straight_alpha", nullptr, ofTexture(&TextureData::straightAlpha))
        .def_property("wrap_u", nullptr, ofTexture(&TextureData::wrapU))
        .def_property("wrap_v", nullptr, ofTexture(&TextureData::wrapV))
        .def_property("magnification", nullptr, ofTexture(&TextureData::magnification))
        .def_property("minification", nullptr, ofTexture(&TextureData::minification))
        .def_property("mipmaps", nullptr, ofTexture(&TextureData::mipmaps));
    py::class_<MaterialData>(package, "MaterialData")
        .def(py::init<>())
        .def_readwrite("name", &MaterialData::name)
        .def_readwrite("base_color", &MaterialData::baseColor)
        .def_readwrite("base_color_texture", &MaterialData::baseColorTexture)
        .def_readwrite("metallic", &MaterialData::metallic)
        .def_readwrite("roughness", &MaterialData::roughness)
        .def_readwrite("metallic_roughness_texture", &MaterialData::metallicRoughnessTexture)
        .def_readwrite("normal_texture", &MaterialData::normalTexture)
        .def_readwrite("normal_scale", &MaterialData::normalScale)
        .def_readwrite("occlusion_texture", &MaterialData::occlusionTexture)
        .def_readwrite("occlusion_strength", &MaterialData::occlusionStrength)
        .def_readwrite("emission", &MaterialData::emission)
        .def_readwrite("emission_texture", &MaterialData::emissionTexture)
        .def_readwrite("alpha_mode", &MaterialData::alphaMode)
        .def_readwrite("alpha_cutoff", &MaterialData::alphaCutoff)
        .def_readwrite("double_sided", &MaterialData::doubleSided)
        .def_readwrite("unlit", &MaterialData::unlit)
        .def_readwrite("ior", &MaterialData::ior)
        .def_readwrite("transmission", &MaterialData::transmission)
        .def_readwrite("transmission_texture", &MaterialData::transmissionTexture)
        .def_readwrite("thickness", &MaterialData::thickness)
        .def_readwrite("attenuation_distance", &MaterialData::attenuationDistance)
        .def_readwrite("attenuation_color", &MaterialData::attenuationColor);
    py::class_<InstanceData>(package, "InstanceData")
        .def(py::init<>())
        .def_readwrite("name", &InstanceData::name)
        .def_readwrite("mesh", &InstanceData::mesh)
        .def_readwrite("transform", &InstanceData::transform);
    py::class_<CameraData>(package, "CameraData")
        .def(py::init<>())
        .def_readwrite("name", &CameraData::name)
        .def_readwrite("transform", &CameraData::transform)
        .def_readwrite("yfov", &CameraData::yfov)
        .def_readwrite("znear", &CameraData::znear)
        .def_readwrite("focus_distance", &CameraData::focusDistance)
        .def(
            "set_lens",
            [](CameraData& camera, const defocus::Request& request) {
                camera.lens = request.lens;
                return request.lens != defocus::LensSettings();
            },
            "Sets the camera's lens to the lens of a request; returns whether it differs from the default lens.");
    py::class_<LightData>(package, "LightData")
        .def(py::init<>())
        .def_readwrite("name", &LightData::name)
        .def_readwrite("type", &LightData::type)
        .def_readwrite("transform", &LightData::transform)
        .def_readwrite("color", &LightData::color)
        .def_readwrite("intensity", &LightData::intensity)
        .def_readwrite("range", &LightData::range)
        .def_readwrite("inner_cone_angle", &LightData::innerConeAngle)
        .def_readwrite("outer_cone_angle", &LightData::outerConeAngle)
        .def_readwrite("angular_diameter", &LightData::angularDiameter)
        .def_readwrite("radius", &LightData::radius);
    package.def("create_scene", &createScene);
    package.def("look_at", &defocus::lookAt);
}

void defineRenderer(py::module_& package) {
    using defocus::RenderStatistics;
    using defocus::SceneRenderer;
    py::class_<RenderStatistics>(package, "Statistics")
        .def_readonly("samples", &RenderStatistics::samples)
        .def_readonly("positions", &RenderStatistics::positions)
        .def_readonly("load_milliseconds", &RenderStatistics::loadMilliseconds)
        .def_readonly("pyramid_milliseconds", &RenderStatistics::pyramidMilliseconds)
        .def_readonly("setup_milliseconds", &RenderStatistics::setupMilliseconds)
        .def_readonly("render_milliseconds", &RenderStatistics::renderMilliseconds)
        .def_readonly("triangles_drawn", &RenderStatistics::trianglesDrawn)
        .def_readonly("triangles_at_full_detail", &RenderStatistics::trianglesAtFullDetail)
        .def_readonly("gpu_bytes", &RenderStatistics::gpuBytes)
        .def_readonly("device", &RenderStatistics::device)
        .def_property_readonly("stopped",
                               [](const RenderStatistics& statistics) {
                                   switch (statistics.stopped) {
                                       case defocus::StopReason::targetError:
                                           return "target error";
                                       case defocus::StopReason::timeLimit:
                                           return "time limit";
                                       case defocus::StopReason::nothingBlurred:
                                           return "nothing blurred";
                                       case defocus::StopReason::sampleCount:
                                           break;
                                   }
                                   return "samples";
                               })
        .def_readonly("estimated_error", &RenderStatistics::estimatedError);
    py::class_<SharedRenderer>(package, "Renderer")
        .def(py::init([](const OpenScene* scene, const defocus::Request& request, const Listener& progress) {
            const py::gil_scoped_release unlocked;
            return std::make_unique<SharedRenderer>(
                "renderer", scene != nullptr ? SceneRenderer(scene->scene, request, listening(progress))
                                             : SceneRenderer(request, listening(progress)));
        }))
        .def("start",
             [](SharedRenderer& self, const defocus::Request& request) {
                 self.with([&](SceneRenderer& renderer) { renderer.start(request); });
             })
        .def("advance",
             [](SharedRenderer& self) { return self.with([](SceneRenderer& renderer) { return renderer.advance(); }); })
        .def("samples",
             [](SharedRenderer& self) {
                 return self.with([](const SceneRenderer& renderer) { return renderer.samples(); });
             })
        .def("sample_total",
             [](SharedRenderer& self) {
                 return self.with([](const SceneRenderer& renderer) { return renderer.sampleTotal(); });
             })
        .def("image",
             [](SharedRenderer& self) {
                 return arrayOf(self.with([](SceneRenderer& renderer) { return renderer.image(); }));
             })
        .def("render",
             [](SharedRenderer& self, const defocus::Request& request, const Listener& progress) {
                 return arrayOf(
                     self.with([&](SceneRenderer& renderer) { return renderer.render(request, listening(progress)); }));
             })
        .def("statistics",
             [](SharedRenderer& self) {
                 return self.with([](const SceneRenderer& renderer) { return renderer.statistics(); });
             })
        .def("aovs",
             [](SharedRenderer& self) {
                 defocus::Aovs aovs = self.with([](SceneRenderer& renderer) { return renderer.aovs(); });
                 return py::make_tuple(arrayOf(std::move(aovs.depth)), arrayOf(std::move(aovs.coc)),
                                       arrayOf(std::move(aovs.level)));
             })
        .def("plan_json",
             [](SharedRenderer& self) {
                 return self.with([](const SceneRenderer& renderer) { return defocus::toJson(renderer.plan()); });
             })
        .def(
            "write",
            [](SharedRenderer& self, const std::filesystem::path& path, const Array& image) {
                const defocus::ImageView view = viewOf(image);
                self.with([&](const SceneRenderer& renderer) { renderer.write(path, view); });
            },
            "path"_a, py::arg("image").noconvert())
        .def("warnings",
             [](SharedRenderer& self) {
                 return self.with([](const SceneRenderer& renderer) { return renderer.warnings(); });
             })
        .def("scene",
             [](SharedRenderer& self) {
                 return OpenScene{self.with([](const SceneRenderer& renderer) { return renderer.scene(); })};
             })
        .def("close", &SharedRenderer::close);
    package.def("plan_json", [](const defocus::Request& request, const Listener& progress) {
        const py::gil_scoped_release unlocked;
        return defocus::toJson(defocus::plan(request, listening(progress)));
    });
    package.def("pyramid_json", [](const defocus::Request& request, const Listener& progress) {
        const py::gil_scoped_release unlocked;
        return defocus::toJson(defocus::pyramids(request, listening(progress)));
    });
}

// Returns the settings of a request that can be chosen after rendering.
defocus::RefocusSettings refocusing(const defocus::Request& request, bool fillGaps = true) {
    return {request.focus, request.lens, fillGaps};
}

void defineLightField(py::module_& package) {
    using defocus::LightField;
    using defocus::LightFieldInfo;
    using defocus::Request;
    py::class_<LightFieldInfo>(package, "LightFieldInfo")
        .def_readonly("width", &LightFieldInfo::width)
        .def_readonly("height", &LightFieldInfo::height)
        .def_readonly("focus_distance", &LightFieldInfo::focusDistance)
        .def_readonly("f_stop", &LightFieldInfo::fStop)
        .def_readonly("focal_length", &LightFieldInfo::focalLength)
        .def_readonly("horizontal_aperture", &LightFieldInfo::horizontalAperture)
        .def_property_readonly(
            "focus_range",
            [](const LightFieldInfo& info) { return std::pair(info.focusRange.nearest, info.focusRange.farthest); })
        .def_readonly("full_disk", &LightFieldInfo::fullDisk)
        .def_readonly("pixels_per_dioptre", &LightFieldInfo::pixelsPerDioptre)
        .def_readonly("lens_points", &LightFieldInfo::lensPoints);
    py::class_<SharedLightField>(package, "LightField")
        .def(py::init([](const std::filesystem::path& path) {
            const py::gil_scoped_release unlocked;
            return std::make_unique<SharedLightField>("light field", LightField(path));
        }))
        .def_static("render",
                    [](const OpenScene* scene, const Request& request, const std::filesystem::path& path,
                       const std::optional<std::pair<double, double>>& range, const Listener& progress) {
                        const py::gil_scoped_release unlocked;
                        std::optional<defocus::FocusRange> focus;
                        if (range) focus = {range->first, range->second};
                        return std::make_unique<SharedLightField>(
                            "light field",
                            scene != nullptr
                                ? LightField::render(scene->scene, request, path, focus, listening(progress))
                                : LightField::render(request, path, focus, listening(progress)));
                    })
        .def("info",
             [](SharedLightField& self) { return self.with([](const LightField& field) { return field.info(); }); })
        .def("warnings",
             [](SharedLightField& self) { return self.with([](const LightField& field) { return field.warnings(); }); })
        .def("refocus",
             [](SharedLightField& self, const Request& request, bool fillGaps, const Listener& progress) {
                 return arrayOf(self.with([&](LightField& field) {
                     return field.refocus(refocusing(request, fillGaps), listening(progress));
                 }));
             })
        .def("stack",
             [](SharedLightField& self, int count, const Request& request, bool fillGaps, const Listener& progress) {
                 defocus::FocalStack stack = self.with([&](LightField& field) {
                     return field.stack(count, refocusing(request, fillGaps), listening(progress));
                 });
                 py::list pictures;
                 for (defocus::Image& picture : stack.pictures) pictures.append(arrayOf(std::move(picture)));
                 return py::make_tuple(stack.focusDistances, pictures);
             })
        .def("all_in_focus",
             [](SharedLightField& self, const Listener& progress) {
                 return arrayOf(self.with([&](LightField& field) { return field.allInFocus(listening(progress)); }));
             })
        .def("depth",
             [](SharedLightField& self) { return arrayOf(self.with([](LightField& field) { return field.depth(); })); })
        .def("coc",
             [](SharedLightField& self, const Request& request) {
                 return arrayOf(self.with([&](LightField& field) { return field.coc(refocusing(request)); }));
             })
        .def("close", &SharedLightField::close);
    package.def("refocus_settings", &defocus::refocusSettings);
}

}  // namespace

PYBIND11_MODULE(_defocus, package) {
    package.doc() = "Bindings of the C++ API; import the package `defocus` instead.";
    package.attr("version") = DEFOCUS_VERSION_STRING;
    defineErrors(package);
    defineRequest(package);
    defineImages(package);
    defineScenes(package);
    defineSceneData(package);
    defineRenderer(package);
    defineLightField(package);
}
