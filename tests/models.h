#pragma once
// Finds models for tests. The project's own models (meshes/…) and small public ones (tests/data/models) are in the
// repository. Larger public models lie in $DEFOCUS_MODELS_DIR; default: a folder beside the checkout. A test is skipped
// if its model is absent.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace defocus::engine {

// The next two functions return the folders of public models: the small ones in the repository, and the complete set.
inline std::filesystem::path keptModelsDirectory() {
    return std::filesystem::path(DEFOCUS_SOURCE_DIR) / "tests/data/models";
}
inline std::filesystem::path modelsDirectory() {
    const char* given = std::getenv("DEFOCUS_MODELS_DIR");
    return given != nullptr ? given : DEFOCUS_DEFAULT_MODELS_DIR;
}

// Returns the path of a model. A name that begins with "meshes/" or "tests/" is relative to the repository's root; all
// others are names of public models.
inline std::filesystem::path modelPath(const std::filesystem::path& name) {
    if (!name.empty() && (*name.begin() == "meshes" || *name.begin() == "tests"))
        return std::filesystem::path(DEFOCUS_SOURCE_DIR) / name;
    const std::filesystem::path kept = keptModelsDirectory() / name;
    return std::filesystem::exists(kept) ? kept : modelsDirectory() / name;
}

// Replaces characters that a test's name may not contain: all except ASCII letters, digits and _.
inline std::string testNameOf(std::string text) {
    std::ranges::replace_if(
        text, [](unsigned char c) { return c > 127 || std::isalnum(c) == 0; }, '_');
    return text;
}

}  // namespace defocus::engine

#define DEFOCUS_MODEL_OR_SKIP(variable, name)                                   \
    const std::filesystem::path variable(::defocus::engine::modelPath((name))); \
    if (!std::filesystem::exists((variable))) GTEST_SKIP() << "no model " << variable << "; set DEFOCUS_MODELS_DIR"
