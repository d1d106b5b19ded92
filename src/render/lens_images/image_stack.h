#pragma once
// Stores images of equal size as half floats and computes means of some of them, each shifted by whole pixels (used by
// src/refocus).
//
// The images are the layers of a texture. If OpenGL runs on the CPU, they are stored in main memory instead, and C++
// code computes the mean, because it is faster than a shader on the CPU.

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "image/half_image.h"

namespace defocus::engine {

class ImageStack {
public:
    static constexpr std::size_t maxImages = 64;

    // Image that contributes to a mean, and the corner of the rectangle that it contributes.
    struct Part {
        std::uint32_t image = 0;
        glm::ivec2 corner{0};  // pixel of this image that is added to the lower left pixel of the mean
    };

    // `software`: OpenGL runs on the CPU.
    ImageStack(std::filesystem::path shaderFolder, bool software);

    // Allocates `count` images, at most maxImages, with undefined pixels. Throws Error if the driver has too little
    // memory.
    void allocate(int width, int height, std::uint32_t count);
    void free();
    // Rounds the pixels of `texture` to half floats and stores them as image number `image`. The texture must have the
    // size passed to allocate().
    void store(std::uint32_t image, const GlTexture& texture);
    // Computes the mean of `parts`, of which there must be at least one. The mean has `width` × `height` px. Each part
    // contributes a rectangle of this size, whose lower left pixel is Part::corner. It must lie within the part's
    // image.
    void computeMean(std::span<const Part> parts, int width, int height);

    // Returns the latest mean, with row 0 at the bottom.
    [[nodiscard]] const GlTexture& mean() const { return mean_; }
    [[nodiscard]] bool allocated() const { return static_cast<bool>(images_); }
    [[nodiscard]] std::size_t bytes() const;

private:
    void drawMean(std::span<const Part> parts);
    void sumMean(std::span<const Part> parts);

    bool software_;
    GlTexture images_;               // all images; if OpenGL runs on the CPU, only the latest image
    std::vector<HalfImage> halves_;  // all images, row 0 at the bottom; empty unless OpenGL runs on the CPU
    std::vector<float> sums_;        // RGBA sums over the parts, then the mean; used only if OpenGL runs on the CPU
    GlTexture mean_;
    Target meanTarget_;
    Program store_, sum_;
    Fullscreen fullscreen_;
};

}  // namespace defocus::engine
