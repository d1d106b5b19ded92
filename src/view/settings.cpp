#include "view/settings.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"

namespace defocus {

namespace {

using nlohmann::json;

// The number under `name` where it is one from `least` to `most`.
std::optional<double> numberIn(const json& object, const char* name, double least, double most) {
    const auto found = object.find(name);
    if (found == object.end() || !found->is_number()) return std::nullopt;
    const double value = found->get<double>();
    return value >= least && value <= most ? std::optional(value) : std::nullopt;
}

bool flagIn(const json& object, const char* name, bool standard) {
    const auto found = object.find(name);
    return found != object.end() && found->is_boolean() ? found->get<bool>() : standard;
}

}  // namespace

std::filesystem::path viewSettingsPath() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::filesystem::path(value != nullptr ? value : "");
    };
    std::filesystem::path folder = variable("XDG_CONFIG_HOME");
    if (folder.empty() && !variable("HOME").empty()) folder = variable("HOME") / ".config";
    return folder.empty() ? folder : folder / "defocus" / "view.json";
}

ViewSettings readViewSettings(const std::filesystem::path& path) {
    ViewSettings settings;
    std::error_code ignored;
    if (path.empty() || !std::filesystem::exists(path, ignored)) return settings;
    const std::vector<std::byte> bytes = readFile(path);
    const auto* const text = reinterpret_cast<const char*>(bytes.data());
    const json object = json::parse(text, text + bytes.size(), nullptr, false);
    if (!object.is_object()) fail("{}: is no JSON object; the standard settings are used", path.string());
    settings.dark = flagIn(object, "dark", settings.dark);
    settings.panel = flagIn(object, "panel", settings.panel);
    settings.interfaceScale = numberIn(object, "interfaceScale", 0.5, 3).value_or(1);
    settings.budgetMilliseconds = numberIn(object, "budgetMilliseconds", 4, 500);
    settings.width = static_cast<int>(numberIn(object, "width", 200, 16384).value_or(0));
    settings.height = static_cast<int>(numberIn(object, "height", 150, 16384).value_or(0));
    return settings;
}

void writeViewSettings(const std::filesystem::path& path, const ViewSettings& settings) {
    if (path.empty()) return;
    std::error_code fault;
    std::filesystem::create_directories(path.parent_path(), fault);
    if (fault) fail("{}: the folder cannot be made: {}", path.parent_path().string(), fault.message());
    nlohmann::ordered_json object = {{"dark", settings.dark},
                                     {"panel", settings.panel},
                                     {"interfaceScale", settings.interfaceScale},
                                     {"width", settings.width},
                                     {"height", settings.height}};
    if (settings.budgetMilliseconds) object["budgetMilliseconds"] = *settings.budgetMilliseconds;
    writeFile(path, object.dump(2) + "\n");
}

}  // namespace defocus
