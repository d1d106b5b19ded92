#pragma once
// The f-numbers engraved on lenses and shown by cameras: thirds of a stop from f/0.7 to f/64.

#include <span>

namespace defocus {

std::span<const double> standardStops();

// The standard stop `steps` beyond `fStop`: > 0 closes the aperture (larger numbers). From between two stops, the first
// step goes to the neighbour. Ends at the first and last stop.
double steppedStop(double fStop, int steps);

}  // namespace defocus
