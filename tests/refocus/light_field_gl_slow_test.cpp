// Compares refocused images with converged renders.

#include <numeric>
#include <vector>

#include "refocus/lens_images.h"

namespace defocus::engine {
namespace {

class RefocusedError : public LightFieldTest {
protected:
    // Compares the errors of refocused images and of direct renders with the same number of samples. The reference is a
    // converged image at full detail. `distances`: focus distances in m, from the nearest to the farthest that the
    // light field supports. The loss is the PSNR of the direct render minus that of the refocused image, in dB. It is
    // averaged over three seeds, because it varies by 1 dB with the sample points.
    void expectSmallLoss(const Request& request, const std::vector<double>& distances) const {
        std::vector<double> losses(distances.size());
        std::vector<Image> truths;
        for (const double focus : distances) {
            Request converged = focusedAt(request, focus);
            converged.samples = 1024;
            converged.lod = LodMode::off;
            converged.sequence = Sequence::halton;
            truths.push_back(render(converged));
        }
        constexpr std::uint32_t seeds = 3;
        for (std::uint32_t seed = 0; seed < seeds; ++seed) {
            Request seeded = request;
            seeded.seed = seed;
            LightField field(lensImages(seeded, FocusRange{distances.front(), distances.back()}));
            for (std::size_t i = 0; i < distances.size(); ++i) {
                Refocusing refocusing = asRendered(field.info());
                refocusing.focusDistance = distances[i];
                const Image direct = render(focusedAt(seeded, distances[i]));
                losses[i] += (compareImages(truths[i], direct).psnr -
                              compareImages(truths[i], refocused(field, refocusing)).psnr) /
                             seeds;
            }
        }
        for (std::size_t i = 0; i < distances.size(); ++i) EXPECT_LT(losses[i], 3) << distances[i] << " m";
        EXPECT_LT(std::accumulate(losses.begin(), losses.end(), 0.0) / static_cast<double>(losses.size()), 1.5);
    }

private:
    static Request focusedAt(Request request, double focus) {
        request.focus = FocusDistance{focus};
        return request;
    }
};

TEST_F(RefocusedError, isSmallForTheSchool) {
    expectSmallLoss(smallSchool(), {1.3, 1.6, 2.5, 4});
}

// The chess board is a hard case: it has lamps of high radiance and reaches from far in front of the focal plane to far
// behind it.
TEST_F(RefocusedError, isSmallForTheChessBoard) {
    Request request = smallSchool();
    request.scene = std::filesystem::path(DEFOCUS_SOURCE_DIR) / "meshes/chess.glb";
    request.focus = FocusDistance{1};
    request.lens.fStop = 1.4;
    request.size = {96, 72};
    expectSmallLoss(request, {0.5, 5});
}

}  // namespace
}  // namespace defocus::engine
