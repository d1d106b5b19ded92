// Tests that images give bit-identical results whether they are read and compared in strips or as a whole.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/file.h"
#include "image/image_io.h"
#include "image/metrics.h"
#include "likeness.h"
#include "scratch_folder.h"

namespace defocus::engine {
namespace {

Image waves(int width, int height, int channels, float phase) {
    Image image(width, height, channels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c)
                image.at(x, y)[c] = 0.5f + 0.4f * std::sin(phase + 0.7f * static_cast<float>(x) +
                                                           0.05f * static_cast<float>(y * y + c));
    if (channels == 4)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) image.at(x, y)[3] = 1;
    return image;
}

TEST(Strips, areComparedAsTheCompleteImage) {
    Image reference = waves(40, 131, 3, 0);
    Image test = waves(40, 131, 4, 0.2f);
    reference.at(7, 40)[1] = std::numeric_limits<float>::quiet_NaN();
    test.at(9, 60)[0] = std::numeric_limits<float>::infinity();
    Image mask(40, 131, 1);
    for (int y = 20; y < 90; ++y) *mask.at(y % 40, y) = 1;
    for (const bool hdr : {false, true})
        for (const Image* chosen : {static_cast<const Image*>(nullptr), static_cast<const Image*>(&mask)}) {
            Image map;
            CompareOptions options{.hdrFlip = {}, .mask = chosen, .flipMap = &map};
            if (hdr) options.hdrFlip = HdrFlipOptions{};
            const Difference complete = compareImages(reference, test, options);

            std::vector<float> flip;
            int strips = 0;
            options.flipMap = nullptr;
            options.takeFlip = [&](const ImageView& rows) {
                flip.insert(flip.end(), rows.pixels.begin(), rows.pixels.end());
                ++strips;
            };
            const auto source = [](const Image& image) {
                return ImageStrips{image.width, image.height, [&image](int first, int count) {
                                       return ImageView(image.width, count, image.channels,
                                                        std::span(image.at(0, first), std::size_t(count) * 40 *
                                                                                          std::size_t(image.channels)));
                                   }};
            };
            const Difference inStrips = compareStrips(source(reference), source(test), options, 1);
            EXPECT_GT(strips, 5);
            EXPECT_TRUE(sameBits(flip, map.pixels));
            EXPECT_EQ(inStrips.mae, complete.mae);
            EXPECT_EQ(inStrips.rmse, complete.rmse);
            EXPECT_EQ(inStrips.ssim, complete.ssim);
            EXPECT_EQ(inStrips.flip, complete.flip);
            EXPECT_EQ(inStrips.maxError, complete.maxError);
            EXPECT_TRUE(inStrips.maxErrorPixel == complete.maxErrorPixel);
            EXPECT_EQ(inStrips.nonFinite, complete.nonFinite);
            EXPECT_EQ(inStrips.pixelCount, complete.pixelCount);
        }
}

TEST(Strips, areReadAsTheCompleteImage) {
    const ScratchFolder scratch;
    for (const char* name : {"a.exr", "a.png", "a.jpg"})
        for (const int channels : {1, 3, 4}) {
            const std::filesystem::path path = scratch / name;
            writeImage(path, waves(33, 70, channels, 1));
            const Image complete = readImage(path);
            StripReader reader(path);
            ASSERT_EQ(reader.width(), 33);
            ASSERT_EQ(reader.height(), 70);
            int first = 0;
            for (const int end : {20, 45, 46, 70}) {
                const ImageView rows = reader.rows(first, end - first);
                for (int y = first; y < end; ++y)
                    for (int x = 0; x < 33; ++x)
                        for (int c = 0; c < complete.channels; ++c)
                            ASSERT_EQ(rows.at(x, y - first)[c], complete.at(x, y)[c]) << name << x << y;
                first = end - 10;
            }
        }
}

// With SOURCE_DATE_EPOCH, the date in a file does not depend on the clock.
TEST(SourceDate, isTheDateOfEveryFile) {
    const ScratchFolder scratch;
    ::setenv("SOURCE_DATE_EPOCH", "86400", 1);
    writeImage(scratch / "a.exr", waves(8, 8, 3, 0));
    ::setenv("SOURCE_DATE_EPOCH", "none", 1);
    writeImage(scratch / "b.exr", waves(8, 8, 3, 0));
    ::unsetenv("SOURCE_DATE_EPOCH");
    Metadata metadata;
    static_cast<void>(readImage(scratch / "a.exr", metadata));
    EXPECT_EQ(std::get<std::string>(metadata.at("capDate")), "1970:01:02 00:00:00");
    static_cast<void>(readImage(scratch / "b.exr", metadata));
    EXPECT_NE(std::get<std::string>(metadata.at("capDate")), "1970:01:02 00:00:00");
}

}  // namespace
}  // namespace defocus::engine
