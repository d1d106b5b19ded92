#include "view/recent_files.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"

namespace defocus {

namespace {

using nlohmann::json;

// Those that are there no longer too: a drive may come back.
std::vector<std::string> rememberedNames(const std::filesystem::path& list) {
    std::error_code ignored;
    if (list.empty() || !std::filesystem::exists(list, ignored)) return {};
    try {
        const std::vector<std::byte> bytes = readFile(list);
        const auto* const text = reinterpret_cast<const char*>(bytes.data());
        std::vector<std::string> names;
        for (const json& entry : json::parse(text, text + bytes.size(), nullptr, false))
            if (entry.is_string()) names.push_back(entry.get<std::string>());
        return names;
    } catch (const Error&) {
        return {};  // a list of no consequence
    }
}

}  // namespace

std::filesystem::path recentFilesPath() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::filesystem::path(value != nullptr ? value : "");
    };
    std::filesystem::path folder = variable("XDG_STATE_HOME");
    if (folder.empty() && !variable("HOME").empty()) folder = variable("HOME") / ".local" / "state";
    return folder.empty() ? folder : folder / "defocus" / "recent.json";
}

std::vector<std::filesystem::path> readRecentFiles(const std::filesystem::path& list) {
    std::vector<std::filesystem::path> files;
    for (const std::string& name : rememberedNames(list)) {
        std::error_code ignored;
        if (files.size() < mostRecentFiles && std::filesystem::is_regular_file(name, ignored)) files.emplace_back(name);
    }
    return files;
}

void rememberRecentFile(const std::filesystem::path& list, const std::filesystem::path& scene) {
    if (list.empty()) return;
    std::vector<std::string> names = rememberedNames(list);
    const std::string name = std::filesystem::absolute(scene).lexically_normal().string();
    std::erase(names, name);
    names.insert(names.begin(), name);
    names.resize(std::min(names.size(), 2 * mostRecentFiles));
    std::error_code fault;
    std::filesystem::create_directories(list.parent_path(), fault);
    if (fault) fail("{}: the folder cannot be made: {}", list.parent_path().string(), fault.message());
    using Replace = json::error_handler_t;
    writeFile(list, json(names).dump(2, ' ', false, Replace::replace) + "\n");
}

}  // namespace defocus
