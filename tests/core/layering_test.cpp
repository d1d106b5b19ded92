// Tests the layout of the source: a folder includes only lower layers, and each third-party library is confined to its
// folders.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

struct Line {
    std::string file;    // path relative to src
    std::string folder;  // layer that contains the file, e.g. "lod/simplify"
    int number = 0;
    std::string text;
};

// Returns the layer of a file: "lod/simplify" for "lod/simplify/weld.h", "render" for "render/circular/circular.h".
// Only the names of layers in lod and view consist of two folders.
std::string moduleOf(const std::string& path) {
    const std::string first = path.substr(0, path.find('/'));
    return first == "lod" || first == "view" ? path.substr(0, path.rfind('/')) : first;
}

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
            lines.push_back({relative.string(), moduleOf(relative.string()), number, text});
    }
    return lines;
}

std::string where(const Line& line) {
    return line.file + ":" + std::to_string(line.number) + ": " + line.text;
}

// Returns the layers from the bottom up. For each layer, the list contains the other layers that it may include.
const std::map<std::string, std::vector<std::string>>& allowed() {
    static const std::map<std::string, std::vector<std::string>> table = [] {
        std::map<std::string, std::vector<std::string>> modules = {
            {"core", {}},
            {"image", {"core"}},
            {"scene", {"core", "image"}},
            {"school", {"core", "image", "scene"}},
            {"lens", {"core", "image", "scene"}},
            {"lod/simplify", {"core", "image", "scene", "lens"}},
            {"lod/pyramid", {"core", "image", "scene", "lens", "lod/simplify"}},
            {"plan", {"core", "image", "scene", "lens", "lod/simplify", "lod/pyramid"}},
            {"gl", {"core", "image"}},
        };
        const auto addOver = [&](const char* module, const char* base, std::vector<std::string> more) {
            const std::vector<std::string>& below = modules.at(base);
            more.insert(more.end(), below.begin(), below.end());
            more.emplace_back(base);
            modules[module] = more;
        };
        addOver("render", "plan", {"gl"});
        addOver("frame", "render", {});
        addOver("eval", "frame", {});
        // The module `stability` is in bench/stability, not in src, so this test doesn't check what it includes. Only
        // cli may include it.
        modules["stability"] = {};
        addOver("refocus", "frame", {});
        addOver("capture", "refocus", {});
        addOver("view/state", "capture", {});
        addOver("view/document", "view/state", {});
        addOver("view/picture", "view/document", {});
        addOver("view/bench", "view/picture", {});
        addOver("view/export", "view/picture", {});
        addOver("view/widgets", "view/export", {});
        addOver("view/panels", "view/widgets", {});
        addOver("view/hud", "view/widgets", {});
        addOver("view/window", "view/panels", {"view/hud"});
        addOver("cli", "view/window", {"eval", "stability", "view/bench"});
        modules["frame"].emplace_back("school");  // only src/frame includes the built-in scene
        return modules;
    }();
    return table;
}

TEST(Layering, foldersIncludeOnlyThoseAboveThem) {
    const std::regex include(R"re(^\s*#\s*include\s*"([^"]*)")re");
    std::size_t checked = 0;
    for (const Line& line : sourceLines()) {
        std::smatch match;
        if (!std::regex_search(line.text, match, include)) continue;
        ++checked;
        ASSERT_TRUE(allowed().contains(line.folder)) << where(line);
        EXPECT_NE(match[1].str().find('/'), std::string::npos) << where(line) << ": includes are relative to src";
        const std::string module = moduleOf(match[1]);
        const std::vector<std::string>& modules = allowed().at(line.folder);
        const bool isPublic = module == "defocus";
        const bool known = isPublic || module == line.folder || std::count(modules.begin(), modules.end(), module) > 0;
        EXPECT_TRUE(known) << where(line);
    }
    EXPECT_GT(checked, 100u);  // fails if the sources are not found
}

// Public headers include only public headers and the standard library, since programs that embed the library have no
// other headers.
TEST(Layering, publicHeadersIncludeOnlyEachOtherAndTheStandardLibrary) {
    const std::regex include(R"re(^\s*#\s*include\s*(["<][^">]*[">]))re");
    const std::regex standard(R"(^<[a-z_]+>$)");
    const std::regex own(R"(^"defocus/[a-z_]+\.h"$)");
    std::size_t headers = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(DEFOCUS_SOURCE_DIR) / "include/defocus")) {
        ++headers;
        std::ifstream file(entry.path());
        std::smatch match;
        for (std::string line; std::getline(file, line);)
            if (std::regex_search(line, match, include)) {
                const std::string name = match[1];
                EXPECT_TRUE(std::regex_match(name, standard) || std::regex_match(name, own))
                    << entry.path().filename() << ": " << line;
            }
    }
    EXPECT_GE(headers, 6u);
}

struct Place {
    std::vector<std::string> words;  // each text that matches the pattern contains one of these words
    const char* pattern;
    const char* files;  // regular expression for the files in which text that matches `pattern` is allowed
};

TEST(Layering, foreignLibrariesStayInTheirPlace) {
    const std::vector<Place> places = {
        {{"OpenImageIO/", "OIIO::"}, R"(#\s*include\s*<OpenImageIO/|\bOIIO::)", "^image/"},
        {{"tiny_gltf", "tinygltf::"}, R"(#\s*include\s*<tiny_gltf|\btinygltf::)", "^scene/gltf/"},
        {{"OpenMesh"}, R"(#\s*include\s*<OpenMesh/|\bOpenMesh::)", "^lod/simplify/surface_mesh\\.h$"},
        {{"draco/"}, R"(#\s*include\s*<draco/)", "^scene/gltf/"},
        {{"Eigen"}, R"(#\s*include\s*<Eigen/|\bEigen::)", "^lod/simplify/damped_solve\\.cpp$"},
        {{"meshoptimizer"}, R"(#\s*include\s*<meshoptimizer)", "^(lod|scene)/"},
        {{"epoxy/", "gl", "GL_"}, R"(#\s*include\s*<epoxy/|\bgl[A-Z][A-Za-z]+\(|\bGL_[A-Z])", "^(gl|render)/"},
        {{"EGL/", "egl"}, R"(#\s*include\s*<EGL/|\begl[A-Z][A-Za-z]+\()", "^gl/"},
        {{"CLI"}, R"(#\s*include\s*<CLI/|\bCLI::)", "^cli/"},
        // A build without the viewer omits the files that match these patterns.
        {{"imgui"}, R"(#\s*include\s*[<"](imgui|backends/imgui))", "^view/"},
        {{"GLFW/", "glfw"}, R"(#\s*include\s*<GLFW/|\bglfw[A-Z])", "^(gl/window|view/window/interface)\\."},
        {{"gl/window.h"}, R"(#\s*include\s*"gl/window\.h")", "^(gl/window\\.|view/)"},
        {{"\"view/"}, R"(#\s*include\s*"view/)", "^(view/|cli/commands/(bench_)?view\\.)"},
    };
    const std::vector<Line> lines = sourceLines();
    for (const Place& place : places) {
        const std::regex pattern(place.pattern);
        const std::regex files(place.files);
        for (const Line& line : lines) {
            const std::string code = line.text.substr(0, line.text.find("//"));
            // Searching for a word is far faster than matching the regular expression.
            const auto has = [&](const std::string& word) { return code.find(word) != std::string::npos; };
            if (std::ranges::none_of(place.words, has) || !std::regex_search(code, pattern)) continue;
            EXPECT_TRUE(std::regex_search(line.file, files)) << where(line);
        }
    }
}

}  // namespace
}  // namespace defocus::engine
