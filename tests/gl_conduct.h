#pragma once
// Controls how gl_conduct.cpp watches the OpenGL calls of tests with "_gl" in their file names.

#include <gtest/gtest.h>

namespace defocus::engine {

// During the lifetime of this object, driver messages are expected and shaders may be invalid.
class ExpectedGlMessages {
public:
    ExpectedGlMessages();
    ~ExpectedGlMessages();
    ExpectedGlMessages(const ExpectedGlMessages&) = delete;
    ExpectedGlMessages& operator=(const ExpectedGlMessages&) = delete;
};

// Returns whether the tests run on the second OpenGL driver (zink): DEFOCUS_EXPECTED_DRIVER is set.
bool onSecondDriver();

}  // namespace defocus::engine

// Skips a long test on the second OpenGL driver. If used in SetUp(), skips all tests of the fixture.
#define SKIP_ON_SECOND_DRIVER()              \
    if (::defocus::engine::onSecondDriver()) \
    GTEST_SKIP() << "takes hundreds of samples; shorter tests use the same driver features"
