#pragma once
// See gl_conduct.cpp, which watches what the tests with "_gl" in their names ask of OpenGL.

namespace defocus::engine {

// While it lives, messages of the driver are expected, and shaders may be wrong.
class ExpectedGlMessages {
public:
    ExpectedGlMessages();
    ~ExpectedGlMessages();
    ExpectedGlMessages(const ExpectedGlMessages&) = delete;
    ExpectedGlMessages& operator=(const ExpectedGlMessages&) = delete;
};

}  // namespace defocus::engine
