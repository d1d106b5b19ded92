#pragma once
// Where the models for tests lie. Real ones: $DEFOCUS_MODELS_DIR, else a folder beside the checkout; tests skip where
// it is absent. The project's own (meshes/…): in the repository, always there.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace defocus {

inline std::filesystem::path modelsDirectory() {
    const char* given = std::getenv("DEFOCUS_MODELS_DIR");
    return given != nullptr ? given : DEFOCUS_DEFAULT_MODELS_DIR;
}

// A name that begins with "meshes/" or "tests/" is one of the project's own.
inline std::filesystem::path modelPath(const std::filesystem::path& name) {
    const bool own = !name.empty() && (*name.begin() == "meshes" || *name.begin() == "tests");
    return (own ? std::filesystem::path(DEFOCUS_SOURCE_DIR) : modelsDirectory()) / name;
}

// A test's name may have letters, digits and _ of ASCII only.
inline std::string testNameOf(std::string text) {
    std::ranges::replace_if(
        text, [](unsigned char c) { return c > 127 || std::isalnum(c) == 0; }, '_');
    return text;
}

}  // namespace defocus

#define DEFOCUS_MODEL_OR_SKIP(variable, name)                           \
    const std::filesystem::path variable(::defocus::modelPath((name))); \
    if (!std::filesystem::exists((variable))) GTEST_SKIP() << "no model " << variable << "; set DEFOCUS_MODELS_DIR"
