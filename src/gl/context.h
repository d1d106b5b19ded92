#pragma once
// Headless OpenGL 4.5 core context through EGL. Displays are tried in this order: enumerated devices (GPUs before
// software rasterizers), the surfaceless platform, the default display. log() gives the reason for each failed attempt.

#include <memory>
#include <string>
#include <vector>

namespace defocus::engine {

class GlContext {
public:
    virtual ~GlContext() = default;
    // Makes the context current on this thread. Throws Error if it is current on another thread.
    virtual void makeCurrent() = 0;
    [[nodiscard]] virtual const std::string& device() const = 0;  // the driver's GL_RENDERER string
    [[nodiscard]] virtual const std::string& driver() const = 0;  // the driver's GL_VERSION string
    [[nodiscard]] virtual bool software() const = 0;  // true if the driver rasterizes on the CPU, e.g. llvmpipe
    // Returns one line per attempted display: its name, and why it failed or was chosen.
    [[nodiscard]] virtual const std::vector<std::string>& log() const = 0;
};

// Creates a context and makes it current on this thread. Throws Error with the reasons from the log if no display
// provides OpenGL 4.5.
std::unique_ptr<GlContext> createHeadlessContext();
// Creates a context that shares buffers, textures, programs and fences with the current context, but does not make it
// current. Returns nullptr if the current context is not an EGL context. Throws Error if the driver cannot create it.
std::unique_ptr<GlContext> createSharedContext();

// Saves the thread's current EGL context in the constructor and makes it current again in the destructor.
class CurrentContextKeeper {
public:
    CurrentContextKeeper();
    ~CurrentContextKeeper();
    CurrentContextKeeper(const CurrentContextKeeper&) = delete;
    CurrentContextKeeper& operator=(const CurrentContextKeeper&) = delete;

private:
    unsigned api_;  // EGLenum; plain types keep EGL's headers out of this header
    void* display_;
    void* context_;
    void* draw_;
    void* read_;
};

// currentDevice and currentDriver return the strings GL_RENDERER and GL_VERSION of the current context.
std::string currentDevice();
std::string currentDriver();
// Returns whether the current context renders on the CPU.
bool currentIsSoftware();
// Returns whether contexts of a driver can draw in several threads at the same time. llvmpipe before Mesa 25.0 reads
// the other contexts' lists of textures without a lock, and crashes. `device` and `driver`: GL_RENDERER and GL_VERSION.
bool drawsInThreads(const std::string& device, const std::string& driver);

}  // namespace defocus::engine
