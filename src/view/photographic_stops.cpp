#include "view/photographic_stops.h"

#include <algorithm>
#include <iterator>

namespace defocus {

namespace {

// As cameras round them; whole stops are √2 apart.
constexpr double stops[] = {0.7, 0.8, 0.95, 1.0, 1.1, 1.2, 1.4, 1.6, 1.8, 2.0, 2.2, 2.5, 2.8, 3.2,
                            3.5, 4.0, 4.5,  5.0, 5.6, 6.3, 7.1, 8.0, 9.0, 10,  11,  13,  14,  16,
                            18,  20,  22,   25,  29,  32,  36,  40,  45,  51,  57,  64};

}  // namespace

std::span<const double> standardStops() {
    return stops;
}

double steppedStop(double fStop, int steps) {
    constexpr double same = 1e-9;
    const auto count = static_cast<int>(std::size(stops));
    if (steps == 0) return fStop;
    // The nearest stop on the side that the steps go to.
    int index = 0;
    if (steps > 0) {
        while (index < count && stops[index] <= fStop + same) ++index;
        index += steps - 1;
    } else {
        index = count - 1;
        while (index >= 0 && stops[index] >= fStop - same) --index;
        index += steps + 1;
    }
    return stops[std::clamp(index, 0, count - 1)];
}

}  // namespace defocus
