// Compares refocused pictures with converged renders.

#include "refocus/lens_images.h"

namespace defocus::engine {
namespace {

// The converged picture has 1,024 samples at full detail.
TEST_F(LightFieldTest, aRefocusedPictureIsAsGoodAsARenderedOne) {
    Request request = smallSchool();
    LightField field(lensImages(request, FocusRange{1.3, 4}));
    for (const double focus : {1.3, 1.6, 2.5, 4.0}) {
        request.focus = FocusDistance{focus};
        const Image direct = render(request);
        Request converged = request;
        converged.samples = 1024;
        converged.lod = LodMode::off;
        converged.sequence = Sequence::halton;
        const Image truth = render(converged);
        Refocusing refocusing = asRendered(field.info());
        refocusing.focusDistance = focus;
        const double lost = compareImages(truth, direct).psnr - compareImages(truth, refocused(field, refocusing)).psnr;
        EXPECT_LT(lost, 3) << focus << " m";
    }
}

}  // namespace
}  // namespace defocus::engine
