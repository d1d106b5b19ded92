#pragma once
// Tests of renderers that make a GL context of their own; they skip where none can be made.

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
