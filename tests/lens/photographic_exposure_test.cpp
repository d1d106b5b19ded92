// Tests exposure against photographers' tables and ISO 12232.
#include "lens/photographic_exposure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace defocus::engine {
namespace {

Lens exposed(double fStop, double time, double iso) {
    return {.fStop = fStop, .exposureTime = time, .iso = iso};
}

TEST(PhotographicExposure, exposureValuesOfTheTables) {
    EXPECT_NEAR(exposureValue100(exposed(1, 1, 100)), 0, 1e-12);
    EXPECT_NEAR(exposureValue100(exposed(16, 1.0 / 128, 100)), 15, 1e-12);  // the "sunny 16" rule, in full stops
    EXPECT_NEAR(exposureValue100(exposed(2, 1.0 / 32, 400)), 5, 1e-12);
}

// By ISO 12232, a surface of luminance L exposes the sensor with H = q·L·t/N² lx·s, with q = 0.65, the exposure time t
// and the f-number N. A sensor of speed S saturates at H = 78/S lx·s, which maps to display white (1).
TEST(PhotographicExposure, whiteIsWhatSaturatesTheSensor) {
    for (const auto& [fStop, time, iso] :
         {std::tuple{1.4, 1.0 / 60, 100.0}, {16.0, 1.0 / 125, 400.0}, {4.0, 2.0, 25.0}}) {
        const double luminance = 78 / iso * fStop * fStop / time / 0.65;
        EXPECT_NEAR(luminance * std::exp2(photographicExposure(exposed(fStop, time, iso))), 1, 1e-12);
    }
}

TEST(PhotographicExposure, equalExposuresAreEqual) {
    const double reference = photographicExposure(exposed(4, 1.0 / 100, 200));
    EXPECT_NEAR(photographicExposure(exposed(8, 4.0 / 100, 200)), reference, 1e-12);
    EXPECT_NEAR(photographicExposure(exposed(4, 2.0 / 100, 100)), reference, 1e-12);
    EXPECT_NEAR(photographicExposure(exposed(2, 1.0 / 100, 200)), reference + 2, 1e-12);
}

TEST(PhotographicExposure, withoutATimeNothingIsBrightened) {
    EXPECT_EQ(photographicExposure(Lens{}), 0);
}

}  // namespace
}  // namespace defocus::engine
