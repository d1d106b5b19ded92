#include "gl/device_memory.h"

#include <epoxy/gl.h>

#include <array>

#include "gl/context.h"

namespace defocus {

std::optional<std::uint64_t> freeDeviceMemory() {
    if (currentIsSoftware()) return {};
    std::array<GLint, 4> kibibytes{};
    if (epoxy_has_gl_extension("GL_NVX_gpu_memory_info"))
        glGetIntegerv(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX, kibibytes.data());
    else if (epoxy_has_gl_extension("GL_ATI_meminfo"))
        glGetIntegerv(GL_TEXTURE_FREE_MEMORY_ATI, kibibytes.data());
    if (kibibytes[0] <= 0) return {};
    return static_cast<std::uint64_t>(kibibytes[0]) * 1024;
}

}  // namespace defocus
