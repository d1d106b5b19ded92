#pragma once
// Fixture of tests that need an OpenGL context: one context per suite, current on the test's thread.

#include <gtest/gtest.h>

#include <memory>

#include "gl/context.h"

namespace defocus::engine {

class GlContextTest : public testing::Test {
protected:
    static void SetUpTestSuite() { context_ = createHeadlessContext(); }
    static void TearDownTestSuite() { context_.reset(); }
    static inline std::unique_ptr<GlContext> context_;
};

}  // namespace defocus::engine
