#pragma once
// Fixture that makes small test images and blurs them by a sum of complex Gaussians.

#include <gtest/gtest.h>

#include <algorithm>

#include "gl/read_back.h"
#include "gl_context_test.h"
#include "likeness.h"
#include "render/circular/circular_kernel.h"
#include "render/circular/complex_blur.h"

namespace defocus::engine {

class ComplexBlurs : public GlContextTest {
protected:
    static constexpr int width = 96;
    static constexpr int height = 80;

    static GlTexture textureOf(const Image& image, TextureFormat format) {
        GlTexture texture({.format = format, .width = image.width, .height = image.height});
        texture.sampling(GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
        Image bottomUp = image;
        const std::size_t row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
        for (int y = 0; y < image.height; ++y) std::copy_n(image.at(0, image.height - 1 - y), row, bottomUp.at(0, y));
        texture.upload(0, image.width, image.height, bottomUp.pixels.data());
        return texture;
    }

    static Image filled(int channels, float value) {
        Image image(width, height, channels);
        std::fill(image.pixels.begin(), image.pixels.end(), value);
        return image;
    }

    static Image blurred(const ComplexBlurInfo& info, const Image& field, const Image& radius) {
        ComplexBlur blur(info);
        blur.blur(textureOf(field, TextureFormat::rgba32f), textureOf(radius, TextureFormat::r32f));
        return readBack(blur.result(), 4);
    }

    static ComplexBlurInfo infoOf(int components, ComplexStorage storage = ComplexStorage::half) {
        return {.width = width, .height = height, .components = components, .storage = storage, .shaderFolder = {}};
    }

    // Returns blocks of colours between 0 and 1 with edges in every direction. The alpha channel, the weight, is 1.
    static Image blocks() {
        Image image(width, height, 4);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                float* pixel = image.at(x, y);
                pixel[0] = static_cast<float>((x / 9 + y / 7) % 2);
                pixel[1] = static_cast<float>(x / 16 * 37 % 11) / 10.0f;
                pixel[2] = x + y > 80 ? 0.9f : 0.05f;
                pixel[3] = 1;
            }
        return image;
    }

    // Returns the top left quarter of an image. Tests compare only this quarter, because wide kernels are slow.
    static Image partOf(const Image& image) {
        Image part(width / 2, height / 2, image.channels);
        const std::size_t row = static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.channels);
        for (int y = 0; y < part.height; ++y) std::copy_n(image.at(0, y), row, part.at(0, y));
        return part;
    }
};

}  // namespace defocus::engine
