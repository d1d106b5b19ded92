#pragma once
// gl_conduct.cpp watches the OpenGL calls of tests with "_gl" in their names.

namespace defocus::engine {

// During the lifetime of this object, driver messages are expected and shaders may be invalid.
class ExpectedGlMessages {
public:
    ExpectedGlMessages();
    ~ExpectedGlMessages();
    ExpectedGlMessages(const ExpectedGlMessages&) = delete;
    ExpectedGlMessages& operator=(const ExpectedGlMessages&) = delete;
};

}  // namespace defocus::engine
