#include "gl/device_memory.h"

#include <epoxy/gl.h>

#include <array>

#include "gl/context.h"

namespace defocus::engine {

std::optional<std::uint64_t> freeDeviceMemoryOf(const std::function<bool(const char*)>& has,
                                                const std::function<int(unsigned)>& query) {
    int kibibytes = 0;
    if (has("GL_NVX_gpu_memory_info"))
        kibibytes = query(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX);
    else if (has("GL_ATI_meminfo"))
        kibibytes = query(GL_TEXTURE_FREE_MEMORY_ATI);
    if (kibibytes <= 0) return {};
    return static_cast<std::uint64_t>(kibibytes) * 1024;
}

std::optional<std::uint64_t> freeDeviceMemory() {
    if (currentIsSoftware()) return {};
    return freeDeviceMemoryOf([](const char* extension) { return epoxy_has_gl_extension(extension); },
                              [](unsigned name) {
                                  std::array<GLint, 4> numbers{};  // GL_ATI_meminfo writes four values
                                  glGetIntegerv(name, numbers.data());
                                  return numbers[0];
                              });
}

}  // namespace defocus::engine
