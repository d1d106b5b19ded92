// Tests that the pixels of an ImageView are written and compared like the pixels of an Image.

#include <gtest/gtest.h>

#include <vector>

#include "image/image.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

Image gradient(int channels) {
    Image image(9, 5, channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i % 23) / 22.0f;
    return image;
}

TEST(ImageView, isAnImagesOwnPixels) {
    const Image image = gradient(3);
    const ImageView view = image;
    EXPECT_EQ(view.pixels.data(), image.pixels.data());
    EXPECT_EQ(view.at(4, 2), image.at(4, 2));
    EXPECT_FALSE(view.empty());
    EXPECT_TRUE(ImageView().empty());
}

TEST(ImageView, isWrittenAsAnImage) {
    const ScratchFolder folder;
    for (const int channels : {1, 3, 4}) {
        const Image image = gradient(channels);
        const std::vector<float> elsewhere = image.pixels;
        const ImageView view(image.width, image.height, channels, elsewhere);
        for (const char* name : {"a.exr", "a.png", "a.jpg"}) {
            writeImage(folder / name, image);
            const Image wanted = readImage(folder / name);
            writeImage(folder / name, view);
            EXPECT_EQ(readImage(folder / name).pixels, wanted.pixels) << name << ", " << channels;
        }
        EXPECT_EQ(elsewhere, image.pixels);
    }
}

TEST(ImageView, isComparedAsAnImage) {
    const Image image = gradient(4);
    std::vector<float> elsewhere = image.pixels;
    const ImageView view(image.width, image.height, 4, elsewhere);
    EXPECT_EQ(compareImages(image, view).maxError, 0);
    elsewhere[4 * (2 * 9 + 7)] += 0.5f;  // a channel of the pixel in row 2, column 7
    EXPECT_EQ(compareImages(image, view).maxErrorPixel, (Pixel{7, 2}));
}

TEST(ImageView, ofTooFewPixelsIsRefused) {
    const ScratchFolder folder;
    const std::vector<float> pixels(10);
    EXPECT_NE(messageOf<Error>([&] { writeImage(folder / "a.exr", ImageView(9, 5, 1, pixels)); }), "");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
    const Image full(9, 5, 1);
    EXPECT_NE(messageOf<Error>([&] { compareImages(full, ImageView(9, 5, 1, pixels)); }), "");
}

// Strides select a part of an image. Here an RGB crop of an RGBA image has gaps between pixels and between rows.
TEST(ImageView, stridesSelectAPartOfAnImage) {
    const ScratchFolder folder;
    const Image full = gradient(4);
    Image crop(4, 3, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x) std::copy_n(full.at(x + 2, y + 1), 3, crop.at(x, y));
    const std::span<const float> begin = std::span(full.pixels).subspan(4 * (9 + 2));
    const ImageView view(4, 3, 3, begin, {4, 9 * 4});
    EXPECT_FALSE(view.isPacked());
    EXPECT_EQ(compareImages(crop, view).maxError, 0);
    for (const char* name : {"a.exr", "a.png"}) {
        writeImage(folder / name, crop);
        const Image wanted = readImage(folder / name);
        writeImage(folder / name, view);
        EXPECT_EQ(readImage(folder / name).pixels, wanted.pixels) << name;
    }
    const ImageView tooTall(4, 5, 3, begin, {4, 9 * 4});
    EXPECT_NE(messageOf<Error>([&] { writeImage(folder / "b.exr", tooTall); }), "");
    EXPECT_NE(messageOf<Error>([&] { compareImages(Image(4, 5, 3), tooTall); }), "");
    EXPECT_FALSE(std::filesystem::exists(folder / "b.exr"));
}

}  // namespace
}  // namespace defocus::engine
