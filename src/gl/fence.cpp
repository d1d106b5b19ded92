#include "gl/fence.h"

#include "core/error.h"

namespace defocus::engine {

Fence Fence::forOtherContexts() {
    Fence fence = here();
    glFlush();
    return fence;
}

bool Fence::wait(GLuint64 maxNanoseconds) const {
    if (sync_ == nullptr) return true;
    const GLenum result = glClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, maxNanoseconds);
    if (result == GL_WAIT_FAILED) fail("waiting for an OpenGL fence failed (glClientWaitSync)");
    return result != GL_TIMEOUT_EXPIRED;
}

void Fence::wait() const {
    constexpr GLuint64 second = 1'000'000'000;  // ns
    while (!wait(second)) {
    }
}

}  // namespace defocus::engine
