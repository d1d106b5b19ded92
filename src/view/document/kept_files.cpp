#include "view/document/kept_files.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"
#include "lens/lens_fields.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path userFile(const char* variable, const char* folderInHome, const char* name) {
    if (const char* const folder = std::getenv(variable); folder != nullptr && *folder != '\0')
        return fs::path(folder) / "defocus" / name;
    const char* const home = std::getenv("HOME");
    return home == nullptr || *home == '\0' ? fs::path() : fs::path(home) / folderInHome / "defocus" / name;
}

// Returns the JSON in a file; null if there is no regular file, and nlohmann's value `discarded` if the text isn't
// JSON. Throws Error if the file is unreadable.
json readKept(const fs::path& file) {
    const std::optional<std::vector<std::byte>> bytes = readOwnFile(file);
    if (!bytes) return nullptr;
    const auto* const text = reinterpret_cast<const char*>(bytes->data());
    return json::parse(text, text + bytes->size(), nullptr, false);
}

void writeKept(const fs::path& file, const nlohmann::ordered_json& value) {
    createOwnFolder(file.parent_path());
    writeFile(file, value.dump(2, ' ', false, json::error_handler_t::replace) + "\n", NamedBy::program);
}

std::optional<double> numberIn(const json& object, const char* name, double min, double max) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_number()) return std::nullopt;
    const double value = found->get<double>();
    return value >= min && value <= max ? std::optional(value) : std::nullopt;
}

bool flagIn(const json& object, const char* name, bool defaultValue) {
    const auto found = object.find(name);
    return found != object.end() && found->is_boolean() ? found->get<bool>() : defaultValue;
}

json viewJson(const SavedView& view) {
    const double* const matrix = glm::value_ptr(view.camera.worldFromCamera);
    json lens = json::object();
    for (const LensField& field : lensFields())
        lens[field.name] = std::min(lensFieldValue(view.lens, field), field.max);
    return {{"name", view.name},
            {"worldFromCamera", std::vector<double>(matrix, matrix + 16)},
            {"pivotDistance", view.camera.pivotDistance},
            {"nearPlane", view.nearPlane},
            {"lens", lens}};
}

// Parses a saved view. Returns nullopt for an invalid camera or lens.
std::optional<SavedView> viewOf(const json& object) try {
    SavedView view;
    view.name = object.at("name").get<std::string>();
    for (std::size_t i = 0; i < 16; ++i)
        glm::value_ptr(view.camera.worldFromCamera)[i] = object.at("worldFromCamera").at(i).get<double>();
    view.camera.pivotDistance = object.at("pivotDistance").get<double>();
    view.nearPlane = object.at("nearPlane").get<double>();
    for (const LensField& field : lensFields())
        if (const auto found = object.at("lens").find(field.name); found != object.at("lens").end())
            setLensField(view.lens, field, std::clamp(found->get<double>(), field.min, field.max));
    checkLens(view.lens);
    const bool rigid = std::abs(glm::determinant(glm::dmat3(view.camera.worldFromCamera)) - 1) < 1e-3;
    if (!rigid || !(view.camera.pivotDistance > 0) || !(view.nearPlane > 0) || view.name.empty()) return std::nullopt;
    return view;
} catch (const json::exception&) {
    return std::nullopt;
} catch (const Error&) {
    return std::nullopt;
}

json allViews(const fs::path& file) {
    json object = readKept(file);
    if (object.is_null()) return json::object();
    if (!object.is_object()) fail("cannot read the saved views in {}: not a JSON object", file.string());
    return object;
}

// Returns the recent scenes. Scenes whose file is missing are included, because their drive may be mounted again.
std::vector<std::string> rememberedNames(const fs::path& list) {
    std::vector<std::string> names;
    try {
        for (const json& entry : readKept(list))
            if (entry.is_string()) names.push_back(entry.get<std::string>());
    } catch (const Error&) {
        return {};  // the next write replaces an unreadable list
    }
    return names;
}

}  // namespace

fs::path viewSettingsPath() {
    return userFile("XDG_CONFIG_HOME", ".config", "view.json");
}

fs::path savedViewsPath() {
    return userFile("XDG_CONFIG_HOME", ".config", "views.json");
}

fs::path recentFilesPath() {
    return userFile("XDG_STATE_HOME", ".local/state", "recent.json");
}

ViewSettings readViewSettings(const fs::path& file) {
    ViewSettings settings;
    const json object = readKept(file);
    if (object.is_null()) return settings;
    if (!object.is_object()) fail("{} is not a JSON object; the default settings are used", file.string());
    settings.dark = flagIn(object, "dark", settings.dark);
    settings.panel = flagIn(object, "panel", settings.panel);
    settings.interfaceScale = numberIn(object, "interfaceScale", 0.5, 3).value_or(1);
    settings.budgetMilliseconds = numberIn(object, "budgetMilliseconds", 4, 500);
    settings.width = static_cast<int>(numberIn(object, "width", 200, 16384).value_or(0));
    settings.height = static_cast<int>(numberIn(object, "height", 150, 16384).value_or(0));
    return settings;
}

void writeViewSettings(const fs::path& file, const ViewSettings& settings) {
    if (file.empty()) return;
    nlohmann::ordered_json object = {{"dark", settings.dark},
                                     {"panel", settings.panel},
                                     {"interfaceScale", settings.interfaceScale},
                                     {"width", settings.width},
                                     {"height", settings.height}};
    if (settings.budgetMilliseconds) object["budgetMilliseconds"] = *settings.budgetMilliseconds;
    writeKept(file, object);
}

std::string savedViewsKey(const fs::path& scene) {
    return scene.empty() ? "school" : fs::absolute(scene).lexically_normal().string();
}

std::vector<SavedView> readSavedViews(const fs::path& file, const std::string& key) {
    std::vector<SavedView> views;
    const json object = allViews(file);
    const auto found = object.find(key);
    if (found == object.end() || !found->is_array()) return views;
    for (const json& entry : *found)
        if (std::optional<SavedView> view = viewOf(entry)) views.push_back(std::move(*view));
    return views;
}

void writeSavedViews(const fs::path& file, const std::string& key, const std::vector<SavedView>& views) {
    if (file.empty()) fail("no folder for saved views; set HOME or XDG_CONFIG_HOME");
    json object = allViews(file);
    json& list = object[key] = json::array();
    for (const SavedView& view : views) list.push_back(viewJson(view));
    if (list.empty()) object.erase(key);
    writeKept(file, object);
}

std::vector<fs::path> readRecentFiles(const fs::path& list) {
    std::vector<fs::path> files;
    for (const std::string& name : rememberedNames(list)) {
        std::error_code ignored;
        if (files.size() < maxRecentFiles && fs::is_regular_file(name, ignored)) files.emplace_back(name);
    }
    return files;
}

void rememberRecentFile(const fs::path& list, const fs::path& scene) {
    if (list.empty()) return;
    std::vector<std::string> names = rememberedNames(list);
    const std::string name = fs::absolute(scene).lexically_normal().string();
    std::erase(names, name);
    names.insert(names.begin(), name);
    names.resize(std::min(names.size(), 2 * maxRecentFiles));
    writeKept(list, names);
}

}  // namespace defocus::engine
