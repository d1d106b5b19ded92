#include "render/lens_space/ray_sum.h"

#include "core/error.h"
#include "render/lens_space/lens_front.h"

namespace defocus::engine {

RaySum::RaySum(int width, int height, const char* addShader, const std::filesystem::path& shaderFolder)
    : width_(width),
      height_(height),
      addProgram_({{addShader}, {}, shaderFolder}),
      meanProgram_({{fullscreenShader, "lens_space/mean.frag"}, {}, shaderFolder}),
      sums_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 2 * sizeof(glm::vec4)),
      mean_({.format = TextureFormat::rgba32f, .width = width, .height = height, .linear = true}),
      meanTarget_({&mean_}) {}

void RaySum::add(std::uint32_t count) {
    addProgram_.use();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, sums_.name());
    const auto pixels = static_cast<GLuint>(width_ * height_);
    glUniform1ui(0, pixels);
    glUniform1ui(1, count);
    glUniform1i(2, rays_ == 0 ? 1 : 0);
    dispatchOver(pixels);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    rays_ += count;
}

const GlTexture& RaySum::mean() {
    if (rays_ == 0) fail("no rays have been added yet");
    meanTarget_.bind();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, sums_.name());
    glProgramUniform1i(meanProgram_.name(), 0, width_);
    glProgramUniform1f(meanProgram_.name(), 1, static_cast<float>(rays_));
    fullscreen_.draw(meanProgram_);
    return mean_;
}

}  // namespace defocus::engine
