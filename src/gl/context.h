#pragma once
// Headless OpenGL 4.5 core context through EGL. It tries enumerated devices (GPUs before software), then the
// surfaceless platform, then the default display. The reasons of failed attempts are kept in a log.

#include <memory>
#include <string>
#include <vector>

namespace defocus::engine {

class GlContext {
public:
    virtual ~GlContext() = default;
    // Makes the context current on this thread. Throws Error if it is current on another thread.
    virtual void makeCurrent() = 0;
    [[nodiscard]] virtual const std::string& device() const = 0;  // GL_RENDERER
    [[nodiscard]] virtual const std::string& driver() const = 0;  // GL_VERSION
    [[nodiscard]] virtual bool software() const = 0;              // rasterizes on the CPU, such as llvmpipe
    // Log of the attempts, one line each: the display, and why it failed or was chosen.
    [[nodiscard]] virtual const std::vector<std::string>& log() const = 0;
};

// Creates a context and makes it current on this thread. Throws Error with all reasons if no context can be created.
std::unique_ptr<GlContext> createHeadlessContext();

// Restores the thread's current EGL context: saves it in the constructor and makes it current again in the destructor.
class CurrentContextKeeper {
public:
    CurrentContextKeeper();
    ~CurrentContextKeeper();
    CurrentContextKeeper(const CurrentContextKeeper&) = delete;
    CurrentContextKeeper& operator=(const CurrentContextKeeper&) = delete;

private:
    unsigned api_;  // EGL types are not used, to keep EGL headers out
    void* display_;
    void* context_;
    void* draw_;
    void* read_;
};

// Return GL_RENDERER and GL_VERSION of the current context.
std::string currentDevice();
std::string currentDriver();
// Returns whether the current context renders on the CPU.
bool currentIsSoftware();

}  // namespace defocus::engine
