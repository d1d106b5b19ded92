#pragma once
// Where the real models for tests lie: $DEFOCUS_MODELS_DIR, else a folder beside the checkout. Tests skip where it is
// absent.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace defocus {

inline std::filesystem::path modelsDirectory() {
    const char* given = std::getenv("DEFOCUS_MODELS_DIR");
    return given != nullptr ? given : DEFOCUS_DEFAULT_MODELS_DIR;
}

}  // namespace defocus

#define DEFOCUS_MODEL_OR_SKIP(variable, name)                                    \
    const std::filesystem::path variable(::defocus::modelsDirectory() / (name)); \
    if (!std::filesystem::exists((variable))) GTEST_SKIP() << "no model " << variable << "; set DEFOCUS_MODELS_DIR"
