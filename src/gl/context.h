#pragma once
// A current OpenGL 4.5 core context without a window, through EGL: device enumeration first (GPUs before software),
// then the surfaceless platform, then the default display. Every step that failed, or that the driver has no extension
// for, keeps its reason.

#include <memory>
#include <string>
#include <vector>

namespace defocus::engine {

class GlContext {
public:
    virtual ~GlContext() = default;
    // Current on this thread from now on. Throws Error where another thread has it.
    virtual void makeCurrent() = 0;
    [[nodiscard]] virtual const std::string& device() const = 0;  // GL_RENDERER
    [[nodiscard]] virtual const std::string& driver() const = 0;  // GL_VERSION
    [[nodiscard]] virtual bool software() const = 0;              // a rasteriser on the CPU (llvmpipe …)
    // One line a step: what was tried, and why it failed or was chosen.
    [[nodiscard]] virtual const std::vector<std::string>& log() const = 0;
};

// Creates a context and makes it current on this thread. Throws Error with every reason when none can be had.
std::unique_ptr<GlContext> createHeadlessContext();

// What this thread has current through EGL as the object is made is current again once it goes.
class CurrentContextKeeper {
public:
    CurrentContextKeeper();
    ~CurrentContextKeeper();
    CurrentContextKeeper(const CurrentContextKeeper&) = delete;
    CurrentContextKeeper& operator=(const CurrentContextKeeper&) = delete;

private:
    unsigned api_;  // EGL's types, whose headers stay out of this one
    void* display_;
    void* context_;
    void* draw_;
    void* read_;
};

// GL_RENDERER and GL_VERSION of the current context.
std::string currentDevice();
std::string currentDriver();
// Whether the current context draws on the CPU.
bool currentIsSoftware();

}  // namespace defocus::engine
