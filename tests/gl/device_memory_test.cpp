// Tests the query of free device memory, which OpenGL extensions of NVIDIA and AMD report in KiB.

#include "gl/device_memory.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

namespace defocus::engine {
namespace {

constexpr unsigned nvidiaFree = 0x9049;  // GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX
constexpr unsigned amdFree = 0x87FC;     // TEXTURE_FREE_MEMORY_ATI

std::optional<std::uint64_t> freeOf(const std::set<std::string>& extensions, const std::map<unsigned, int>& answers) {
    return freeDeviceMemoryOf([&](const char* name) { return extensions.contains(name); },
                              [&](unsigned name) { return answers.contains(name) ? answers.at(name) : 0; });
}

TEST(DeviceMemory, isWhatTheDriverSays) {
    EXPECT_EQ(freeOf({"GL_NVX_gpu_memory_info"}, {{nvidiaFree, 8 << 20}}), std::uint64_t{8} << 30);
    EXPECT_EQ(freeOf({"GL_ATI_meminfo"}, {{amdFree, 3}}), 3 * 1024u);
}

TEST(DeviceMemory, isUnknownWhereNobodySays) {
    EXPECT_FALSE(freeOf({}, {{nvidiaFree, 100}, {amdFree, 100}}));
    EXPECT_FALSE(freeOf({"GL_NVX_gpu_memory_info"}, {}));
    EXPECT_FALSE(freeOf({"GL_ATI_meminfo"}, {{amdFree, -1}}));
}

}  // namespace
}  // namespace defocus::engine
