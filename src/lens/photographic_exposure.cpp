#include "lens/photographic_exposure.h"

#include <cmath>

namespace defocus::engine {

namespace {

constexpr double saturation = 1.2;  // luminance in cd/m² that saturates the sensor at EV100 = 0

}  // namespace

double exposureValue100(const Lens& lens) {
    return std::log2(lens.fStop * lens.fStop / lens.exposureTime * 100 / lens.iso);
}

double photographicExposure(const Lens& lens) {
    return lens.exposureTime > 0 ? -exposureValue100(lens) - std::log2(saturation) : 0;
}

}  // namespace defocus::engine
