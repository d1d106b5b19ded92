#include "view/saved_views.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.h"
#include "core/file.h"
#include "lens/lens_fields.h"
#include "view/settings.h"

namespace defocus {

namespace {

using nlohmann::json;

json cameraJson(const ViewCamera& camera) {
    json numbers = json::array();
    for (glm::length_t column = 0; column < 4; ++column)
        for (glm::length_t row = 0; row < 4; ++row) numbers.push_back(camera.worldFromCamera[column][row]);
    return numbers;
}

json viewJson(const SavedView& view) {
    json lens = json::object();
    for (const LensField& field : lensFields())
        lens[field.name] = std::min(lensFieldValue(view.lens, field), field.most);
    return {{"name", view.name},
            {"worldFromCamera", cameraJson(view.camera)},
            {"pivotDistance", view.camera.pivotDistance},
            {"nearPlane", view.nearPlane},
            {"lens", lens}};
}

// None for what no camera or lens can be.
std::optional<SavedView> viewOf(const json& object) try {
    SavedView view;
    view.name = object.at("name").get<std::string>();
    const json& numbers = object.at("worldFromCamera");
    for (glm::length_t column = 0; column < 4; ++column)
        for (glm::length_t row = 0; row < 4; ++row)
            view.camera.worldFromCamera[column][row] =
                numbers.at(static_cast<std::size_t>(4 * column + row)).get<double>();
    view.camera.pivotDistance = object.at("pivotDistance").get<double>();
    view.nearPlane = object.at("nearPlane").get<double>();
    for (const LensField& field : lensFields())
        if (const auto found = object.at("lens").find(field.name); found != object.at("lens").end())
            setLensField(view.lens, field, std::clamp(found->get<double>(), field.least, field.most));
    checkLens(view.lens);
    const bool rigid = std::abs(glm::determinant(glm::dmat3(view.camera.worldFromCamera)) - 1) < 1e-3;
    if (!rigid || !(view.camera.pivotDistance > 0) || !(view.nearPlane > 0) || view.name.empty()) return std::nullopt;
    return view;
} catch (const json::exception&) {
    return std::nullopt;
} catch (const Error&) {
    return std::nullopt;
}

json allViews(const std::filesystem::path& file) {
    std::error_code ignored;
    if (file.empty() || !std::filesystem::exists(file, ignored)) return json::object();
    const std::vector<std::byte> bytes = readFile(file);
    const auto* const text = reinterpret_cast<const char*>(bytes.data());
    json object = json::parse(text, text + bytes.size(), nullptr, false);
    if (!object.is_object()) fail("{}: is no JSON object; saved views can't be read", file.string());
    return object;
}

}  // namespace

std::filesystem::path savedViewsPath() {
    const std::filesystem::path settings = viewSettingsPath();
    return settings.empty() ? settings : settings.parent_path() / "views.json";
}

std::string savedViewsKey(const std::filesystem::path& scene) {
    return scene.empty() ? "school" : std::filesystem::absolute(scene).lexically_normal().string();
}

std::vector<SavedView> readSavedViews(const std::filesystem::path& file, const std::string& key) {
    std::vector<SavedView> views;
    const json object = allViews(file);
    const auto found = object.find(key);
    if (found == object.end() || !found->is_array()) return views;
    for (const json& entry : *found)
        if (std::optional<SavedView> view = viewOf(entry)) views.push_back(std::move(*view));
    return views;
}

void writeSavedViews(const std::filesystem::path& file, const std::string& key, const std::vector<SavedView>& views) {
    if (file.empty()) fail("there is no place for saved views: set HOME or XDG_CONFIG_HOME");
    json object = allViews(file);
    json& list = object[key] = json::array();
    for (const SavedView& view : views) list.push_back(viewJson(view));
    if (list.empty()) object.erase(key);
    std::error_code fault;
    std::filesystem::create_directories(file.parent_path(), fault);
    if (fault) fail("{}: the folder cannot be made: {}", file.parent_path().string(), fault.message());
    writeFile(file, object.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

}  // namespace defocus
