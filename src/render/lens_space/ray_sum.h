#pragma once
// The sum of the light of each pixel's rays, added in order with Neumaier's compensation.

#include "gl/fullscreen.h"
#include "gl/target.h"

namespace defocus::engine {

class RaySum {
public:
    // `addShader`: path of the shader that adds the records. Throws Error if the sum exceeds the buffer size that
    // shaders can read.
    RaySum(int width, int height, const char* addShader, const std::filesystem::path& shaderFolder);

    void reset() { rays_ = 0; }
    // Adds the light of the next `count` rays of each pixel. The records must be bound.
    void add(std::uint32_t count);
    [[nodiscard]] std::uint32_t rays() const { return rays_; }
    // Returns the mean of the rays so far as RGBA, row 0 at the bottom. Valid until the next call. Needs at least one
    // ray.
    [[nodiscard]] const GlTexture& mean();
    [[nodiscard]] std::size_t bytes() const { return sums_.bytes() + mean_.bytes(); }

private:
    int width_;
    int height_;
    std::uint32_t rays_ = 0;
    Program addProgram_, meanProgram_;
    Buffer sums_;
    GlTexture mean_;
    Target meanTarget_;
    Fullscreen fullscreen_;
};

}  // namespace defocus::engine
