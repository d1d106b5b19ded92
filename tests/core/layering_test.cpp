// The layout: a folder includes only those above it, and each foreign library stays in its place.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace defocus {
namespace {

namespace fs = std::filesystem;

struct Line {
    std::string file;    // relative to src
    std::string folder;  // the first part of it
    int number = 0;
    std::string text;
};

std::vector<Line> sourceLines() {
    const fs::path root = fs::path(DEFOCUS_SOURCE_DIR) / "src";
    std::vector<Line> lines;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".h" && extension != ".cpp") continue;
        const fs::path relative = fs::relative(entry.path(), root);
        std::ifstream file(entry.path());
        std::string text;
        for (int number = 1; std::getline(file, text); ++number)
            lines.push_back({relative.string(), relative.begin()->string(), number, text});
    }
    return lines;
}

std::string where(const Line& line) {
    return line.file + ":" + std::to_string(line.number) + ": " + line.text;
}

// What a folder may include besides itself.
const std::map<std::string, std::vector<std::string>>& allowed() {
    static const std::map<std::string, std::vector<std::string>> table = {
        {"core", {}},
        {"image", {"core"}},
        {"scene", {"core", "image"}},
        {"lens", {"core", "image", "scene"}},
        {"lod", {"core", "scene", "lens"}},
        {"plan", {"core", "image", "scene", "lens", "lod"}},
        {"gl", {"core", "image"}},
        {"render", {"core", "image", "scene", "lens", "lod", "plan", "gl"}},
        {"eval", {"core", "image", "scene", "lens", "lod", "plan", "gl", "render"}},
        {"capture", {"core", "image", "scene", "lens", "lod", "plan", "gl", "render", "eval"}},
        {"app", {"core", "image", "scene", "lens", "lod", "plan", "gl", "render", "eval", "capture"}},
    };
    return table;
}

TEST(Layering, foldersIncludeOnlyThoseAboveThem) {
    const std::regex include(R"re(^\s*#\s*include\s*"([^"/]+)(/[^"]*)?")re");
    std::size_t checked = 0;
    for (const Line& line : sourceLines()) {
        std::smatch match;
        if (!std::regex_search(line.text, match, include)) continue;
        ++checked;
        ASSERT_TRUE(allowed().contains(line.folder)) << where(line);
        EXPECT_TRUE(match[2].matched) << where(line) << ": includes are relative to src";
        const std::vector<std::string>& folders = allowed().at(line.folder);
        const bool known = match[1] == line.folder || std::count(folders.begin(), folders.end(), match[1]) > 0;
        EXPECT_TRUE(known) << where(line);
    }
    EXPECT_GT(checked, 100u);  // the sources were found
}

struct Place {
    const char* pattern;
    const char* files;  // only files that match this may hold it
};

TEST(Layering, foreignLibrariesStayInTheirPlace) {
    const std::vector<Place> places = {
        {R"(#\s*include\s*<OpenImageIO/|\bOIIO::)", "^image/"},
        {R"(#\s*include\s*<stb)", "^image/text"},
        {R"(#\s*include\s*<tiny_gltf|\btinygltf::)", "^scene/gltf"},
        {R"(#\s*include\s*<OpenMesh/|\bOpenMesh::)", "^$"},  // a peer in bench/ alone
        {R"(#\s*include\s*<draco/)", "^scene/gltf"},
        {R"(#\s*include\s*<meshoptimizer)", "^(lod|scene)/"},
        {R"(#\s*include\s*<epoxy/|\bgl[A-Z][A-Za-z]+\(|\bGL_[A-Z])", "^(gl|render)/"},
        {R"(#\s*include\s*<EGL/|\begl[A-Z][A-Za-z]+\()", "^gl/"},
        {R"(#\s*include\s*<CLI/|\bCLI::)", "^app/"},
        // A build without the viewer leaves these files out.
        {R"(#\s*include\s*[<"](imgui|backends/imgui))", "^app/view_"},
        {R"(#\s*include\s*<GLFW/|\bglfw[A-Z])", "^(gl/window|app/view_interface)\\."},
        {R"(#\s*include\s*"gl/window\.h")", "^(gl/window|app/view_[a-z_]+)\\."},
        {R"(#\s*include\s*"app/view_)", "^app/view_"},
    };
    const std::vector<Line> lines = sourceLines();
    for (const Place& place : places) {
        const std::regex pattern(place.pattern);
        const std::regex files(place.files);
        for (const Line& line : lines) {
            const std::string code = line.text.substr(0, line.text.find("//"));
            if (!std::regex_search(code, pattern)) continue;
            EXPECT_TRUE(std::regex_search(line.file, files)) << where(line);
        }
    }
}

}  // namespace
}  // namespace defocus
