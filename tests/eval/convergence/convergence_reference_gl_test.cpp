// Tests the reference image: the stored mean, the accuracy of its error estimate, and its reuse.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/file.h"
#include "frame/driver/reference_image.h"
#include "gl/context.h"
#include "gl_conduct.h"
#include "image/image_io.h"
#include "render/rendered.h"
#include "scratch_folder.h"
#include "small_world.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

class ConvergenceReference : public testing::Test {
protected:
    void SetUp() override {
        SKIP_ON_SECOND_DRIVER();
        small_->view.width = 64;
        small_->view.height = 48;
    }

    ReferenceImage reference(std::uint32_t samples = 32, const Progress& progress = {}) {
        return referenceImage(small_->world, small_->view, {samples, {}}, folder_.path(), progress);
    }

    std::unique_ptr<GlContext> context_ = createHeadlessContext();
    std::unique_ptr<SmallWorld> small_ = fiveSpheres(40, 30);
    ScratchFolder folder_;
};

TEST_F(ConvergenceReference, isTheMeanOfAllItsSamplesAtFullDetail) {
    const ReferenceImage mean = reference(31);
    const RenderSettings settings{
        .sampleCount = 31, .sequence = referenceSequence, .firstSample = referenceOffset, .lod = LodMode::off};
    const Image direct = imageInFloats(small_->world, planFrame(small_->world, small_->view, settings));
    ASSERT_EQ(mean.image.pixels.size(), direct.pixels.size());
    for (std::size_t i = 0; i < direct.pixels.size(); ++i)
        ASSERT_NEAR(mean.image.pixels[i], direct.pixels[i], 1e-6 * std::max(1.0f, direct.pixels[i]));
}

// The reference's error estimate is half the difference between the means of its two halves. This is correct if the
// errors of the halves are independent. Sample points of one half fill gaps between those of the other, so the true
// error may be smaller.
TEST_F(ConvergenceReference, knowsTheOrderOfItsOwnError) {
    const ReferenceImage coarse = reference(16);
    const ReferenceImage fine = reference(512);
    const double error = compareImages(fine.image, coarse.image).rmse;
    EXPECT_LE(error, 1.25 * coarse.remaining.rmse);
    EXPECT_GE(error, 0.4 * coarse.remaining.rmse);
    // with 32 times as many samples, random samples would reduce the error only by a factor of √32
    EXPECT_LT(fine.remaining.rmse, coarse.remaining.rmse / std::sqrt(32.0));
    EXPECT_NEAR(coarse.remaining.psnr, -20 * std::log10(coarse.remaining.rmse), 1e-9);
}

TEST_F(ConvergenceReference, isUsedAgainWithAllItKnows) {
    const ReferenceImage first = reference();
    EXPECT_FALSE(first.reused);
    EXPECT_TRUE(fs::exists(folder_ / "reference.exr"));
    EXPECT_FALSE(fs::exists(folder_ / "reference-half.exr"));
    const ReferenceImage again = reference();
    EXPECT_TRUE(again.reused);
    EXPECT_EQ(again.image.pixels, first.image.pixels);
    EXPECT_EQ(again.hash, first.hash);
    EXPECT_EQ(again.milliseconds, first.milliseconds);
    EXPECT_EQ(again.remaining.rmse, first.remaining.rmse);
    EXPECT_EQ(again.remaining.flip, first.remaining.flip);
    EXPECT_NEAR(again.remaining.psnr, first.remaining.psnr, 1e-9);
}

TEST_F(ConvergenceReference, isRenderedAnewForAnythingElse) {
    reference();
    EXPECT_FALSE(reference(34).reused);
    EXPECT_FALSE(reference().reused);
    small_->view.lens.fStop *= 1.01;
    EXPECT_FALSE(reference().reused);
    small_->scene.meshes[0].vertices.positions[3].x += 0.01f;
    EXPECT_FALSE(reference().reused);
    EXPECT_TRUE(reference().reused);
}

TEST_F(ConvergenceReference, isToldFromOthersBeforeItIsReplaced) {
    EXPECT_FALSE(holdsOtherReference(folder_.path(), 0));
    const std::uint64_t hash = referenceHash(small_->world, small_->view, {32, {}});
    EXPECT_EQ(reference().hash, hash);
    EXPECT_FALSE(holdsOtherReference(folder_.path(), hash));
    EXPECT_TRUE(holdsOtherReference(folder_.path(), referenceHash(small_->world, small_->view, {34, {}})));
    fs::rename(folder_ / "reference.exr", folder_ / "reference-half.exr");
    EXPECT_FALSE(holdsOtherReference(folder_.path(), hash));
    EXPECT_TRUE(holdsOtherReference(folder_.path(), hash + 1));
    writeFile(folder_ / "reference-half.exr", "");
    EXPECT_FALSE(holdsOtherReference(folder_.path(), hash + 1)) << "an empty file may be replaced";
    writeImage(folder_ / "reference.exr", Image(2, 2, 3));  // another image under the file name of the reference
    EXPECT_TRUE(holdsOtherReference(folder_.path(), hash));
}

TEST_F(ConvergenceReference, isRenderedAnewWhereTheFileIsDamaged) {
    const ReferenceImage first = reference();
    const fs::path path = folder_ / "reference.exr";
    const std::vector<std::byte> full = readFile(path);
    for (const double share : {0.0, 0.01, 0.5, 0.99}) {
        writeFile(path, std::span(full).first(static_cast<std::size_t>(share * static_cast<double>(full.size()))));
        const ReferenceImage anew = reference();
        EXPECT_FALSE(anew.reused) << share;
        EXPECT_EQ(anew.image.pixels, first.image.pixels);
    }
    for (const double place : {0.3, 0.6, 0.9}) {
        std::vector<std::byte> bytes = full;
        bytes[static_cast<std::size_t>(place * static_cast<double>(bytes.size()))] ^= std::byte{0x10};
        writeFile(path, bytes);
        EXPECT_EQ(reference().image.pixels, first.image.pixels) << place;
    }
}

TEST_F(ConvergenceReference, isRenderedAnewWhereItsPixelsWereChanged) {
    const ReferenceImage first = reference();
    Metadata metadata;
    Image image = readImage(folder_ / "reference.exr", metadata);
    image.pixels[100] += 0.25f;
    writeImage(folder_ / "reference.exr", image, metadata);
    const ReferenceImage anew = reference();
    EXPECT_FALSE(anew.reused);
    EXPECT_EQ(anew.image.pixels, first.image.pixels);
}

TEST_F(ConvergenceReference, takesUpTheHalfOfAKilledRun) {
    const auto killed = [](std::string_view, std::uint64_t done, std::uint64_t) {
        if (done >= 16) fail("killed");
    };
    EXPECT_THROW(reference(32, killed), Error);
    EXPECT_TRUE(fs::exists(folder_ / "reference-half.exr"));
    std::uint64_t min = 32;
    const ReferenceImage rest =
        reference(32, [&](std::string_view, std::uint64_t done, std::uint64_t) { min = std::min(min, done); });
    EXPECT_EQ(min, 16u);
    EXPECT_FALSE(fs::exists(folder_ / "reference-half.exr"));
    fs::remove(folder_ / "reference.exr");
    EXPECT_EQ(reference().image.pixels, rest.image.pixels);
}

TEST_F(ConvergenceReference, refusesImpossibleNumbersOfSamples) {
    EXPECT_THROW(reference(1), Error);
    EXPECT_THROW(reference(65'537), Error);
}

}  // namespace
}  // namespace defocus::engine
