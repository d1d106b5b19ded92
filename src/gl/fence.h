#pragma once
// Fence (GL sync object): marks a point in a context's command stream. Other contexts that share objects can wait until
// the GPU has reached this point before they use results of the commands.

#include <epoxy/gl.h>

#include <utility>

namespace defocus::engine {

class Fence {
public:
    Fence() = default;
    // Returns a fence that follows all commands issued so far in the current context.
    static Fence here() { return Fence(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0)); }
    // Returns a fence and submits the commands before it, so that threads with other contexts can wait for the fence.
    static Fence forOtherContexts();

    Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
    Fence& operator=(Fence&& other) noexcept {
        std::swap(sync_, other.sync_);
        return *this;
    }
    Fence(const Fence&) = delete;
    Fence& operator=(const Fence&) = delete;
    ~Fence() {
        if (sync_ != nullptr) glDeleteSync(sync_);
    }

    // Blocks the thread until the commands before the fence are complete, for at most `maxNanoseconds`. Returns false
    // if they are not complete by then. An empty fence counts as complete. Needs a current context.
    bool wait(GLuint64 maxNanoseconds) const;
    // Blocks the thread until the commands before the fence are complete. Throws Error if the driver fails.
    void wait() const;

private:
    explicit Fence(GLsync sync) : sync_(sync) {}

    GLsync sync_ = nullptr;
};

}  // namespace defocus::engine
