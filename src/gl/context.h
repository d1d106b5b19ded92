#pragma once
// A current OpenGL 4.5 core context without a window, through EGL: device enumeration first (GPUs before software),
// then the surfaceless platform, then the default display. Every step that failed keeps its reason.

#include <memory>
#include <string>
#include <vector>

namespace defocus {

class GlContext {
public:
    virtual ~GlContext() = default;
    [[nodiscard]] virtual const std::string& device() const = 0;  // GL_RENDERER
    [[nodiscard]] virtual const std::string& driver() const = 0;  // GL_VERSION
    [[nodiscard]] virtual bool software() const = 0;              // a rasteriser on the CPU (llvmpipe …)
    // One line a step: what was tried, and why it failed or was chosen.
    [[nodiscard]] virtual const std::vector<std::string>& log() const = 0;
};

// Creates a context and makes it current on this thread. Throws Error with every reason when none can be had.
std::unique_ptr<GlContext> createHeadlessContext();

// GL_RENDERER and GL_VERSION of the current context.
std::string currentDevice();
std::string currentDriver();
// Whether the current context draws on the CPU.
bool currentIsSoftware();

}  // namespace defocus
