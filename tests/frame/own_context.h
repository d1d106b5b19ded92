#pragma once
// Fixture for tests of renderers that create their own OpenGL context. The tests are skipped where no context can be
// created.

#include <gtest/gtest.h>

#include "core/error.h"
#include "gl/context.h"

namespace defocus::engine {

class OwnContextTest : public testing::Test {
protected:
    void SetUp() override {
        try {
            static_cast<void>(createHeadlessContext());
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
    }
};

}  // namespace defocus::engine
