#pragma once
// The sum of the light that each pixel's rays brought, added in order with Neumaier's compensation.

#include "gl/fullscreen.h"
#include "gl/target.h"

namespace defocus::engine {

class RaySum {
public:
    // `defines` are those of the rays. Throws Error when the size is beyond what shaders read of one buffer.
    RaySum(int width, int height, const ShaderDefines& defines, const std::filesystem::path& shaderFolder);

    void reset() { rays_ = 0; }
    // Adds the light of the next `count` rays of each pixel; records are bound.
    void add(std::uint32_t count);
    [[nodiscard]] std::uint32_t rays() const { return rays_; }
    // The mean of the rays so far, RGBA, row 0 at the bottom, until the next call. At least one.
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
