#include "render/line/line_weights.h"

#include <algorithm>

namespace defocus::engine {

namespace {

double lightWithin(const LineLight& light, double radius) {
    const double t = std::clamp((radius * radius - light.obstruction) / (1 - light.obstruction), 0.0, 1.0);
    return t * (1 - light.sphericalAberration + light.sphericalAberration * t);
}

double lightUpTo(const LineLight& light, double p) {
    return p < 0 ? -(1 - light.forwardShare) * lightWithin(light, -p / light.backward)
                 : light.forwardShare * lightWithin(light, p);
}

}  // namespace

double lightBetween(const LineLight& light, double p1, double p2) {
    return lightUpTo(light, p2) - lightUpTo(light, p1);
}

}  // namespace defocus::engine
