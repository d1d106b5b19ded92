#pragma once
// Sums the radiance of rays per pixel, in ray order and with Neumaier's compensation of rounding errors.

#include "gl/fullscreen.h"
#include "gl/target.h"

namespace defocus::engine {

class RaySum {
public:
    // `addShader`: path of the shader that adds the records (ray hits). Throws Error if the buffer of the sums would be
    // larger than shaders can read.
    RaySum(int width, int height, const char* addShader, const std::filesystem::path& shaderFolder);

    void reset() { rays_ = 0; }
    // Adds the radiance of the next `count` rays of each pixel. The records (ray hits) must be bound.
    void add(std::uint32_t count);
    [[nodiscard]] std::uint32_t rays() const { return rays_; }
    // Returns the mean radiance of the rays added since reset() as an RGBA texture, with row 0 at the bottom. Throws
    // Error if no rays were added. The next call of mean() overwrites the texture.
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
