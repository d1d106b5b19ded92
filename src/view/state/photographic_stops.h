#pragma once
// Lists the standard f-numbers of lenses and cameras: thirds of a stop from f/0.7 to f/64.

#include <algorithm>
#include <iterator>
#include <span>

namespace defocus::engine {

// Returns the standard f-numbers, rounded as on cameras; full stops differ by a factor of √2.
inline std::span<const double> thirdStops() {
    static constexpr double stops[] = {0.7, 0.8, 0.95, 1.0, 1.1, 1.2, 1.4, 1.6, 1.8, 2.0, 2.2, 2.5, 2.8, 3.2,
                                       3.5, 4.0, 4.5,  5.0, 5.6, 6.3, 7.1, 8.0, 9.0, 10,  11,  13,  14,  16,
                                       18,  20,  22,   25,  29,  32,  36,  40,  45,  51,  57,  64};
    return stops;
}

// Returns the standard f-number that lies `steps` entries after `fStop` in the list; positive steps close the aperture.
// If `fStop` lies between two entries, the first step goes to the neighbouring entry. The result is clamped to the
// first and last entry.
inline double steppedStop(double fStop, int steps) {
    constexpr double tolerance = 1e-9;
    if (steps == 0) return fStop;
    const std::span<const double> stops = thirdStops();
    const auto above = steps > 0 ? std::upper_bound(stops.begin(), stops.end(), fStop + tolerance)
                                 : std::lower_bound(stops.begin(), stops.end(), fStop - tolerance);
    const auto index = above - stops.begin() + (steps > 0 ? steps - 1 : steps);
    return stops[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(index, 0, std::ssize(stops) - 1))];
}

}  // namespace defocus::engine
