#pragma once
// Images of equal size in the layers of a texture, as half floats, and the mean of some of them, each moved by whole
// pixels (src/refocus).

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <span>

#include "gl/fullscreen.h"
#include "gl/target.h"

namespace defocus::engine {

class ImageStack {
public:
    static constexpr std::size_t maxImages = 64;

    // An image in a mean.
    struct Part {
        std::uint32_t image = 0;
        glm::ivec2 corner{0};  // texel of the image, right and up, at the mean's lower left pixel
    };

    explicit ImageStack(std::filesystem::path shaderFolder);

    // Allocates the images, at most maxImages, without contents. Throws Error if the driver has too little memory.
    void allocate(int width, int height, std::uint32_t count);
    void free() { images_ = {}; }
    // Stores an image of the same size, rounded to half floats.
    void store(std::uint32_t image, const GlTexture& texture);
    // Draws the mean of at least one image, of a size in px. All its pixels must be within each image.
    void drawMean(std::span<const Part> parts, int width, int height);

    // Returns the latest mean, with row 0 at the bottom.
    [[nodiscard]] const GlTexture& mean() const { return mean_; }
    [[nodiscard]] bool allocated() const { return static_cast<bool>(images_); }
    [[nodiscard]] std::size_t bytes() const { return images_.bytes(); }

private:
    GlTexture images_, mean_;
    Target meanTarget_;
    Program store_, sum_;
    Fullscreen fullscreen_;
};

}  // namespace defocus::engine
