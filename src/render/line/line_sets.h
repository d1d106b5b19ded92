#pragma once
// Chooses the lines of each pixel: a wagon wheel of n lines through the lens centre (Tzeng et al. 2012), in which line
// i has the angle π·(i + r)/n. Each variant (ray_sets.h) has its own rotation r of the wheel and its own positions of
// the lines in the pixel. Equal lines in all pixels would be visible as strobing, an open problem in the paper.
//
// The lines' positions are well distributed over the pixel, because surfaces in focus are antialiased by the positions
// alone. Positions and angles are also well distributed jointly: lines with similar angles have positions in all parts
// of the pixel.
//
// Angles are spaced so that equal amounts of the aperture's light pass between them. Thus all lines have equal weight
// for any aperture that is not given by an image.

#include "lens/aperture.h"
#include "render/lens_space/ray_sets.h"

namespace defocus::engine {

struct LineSets {
    // A line runs through the lens centre, from rim to rim. GpuRay::lensAndPixel.xy is the vector (u, k·v) from the
    // lens centre to one end of the line, where (u, v) is in the unit disk and k = image width / height.
    // GpuRay::values.x is the distance from the centre to the opposite end, relative to this vector's length. values.y
    // is the fraction of the line's light between the centre and the vector's end. values.z, in [0, 1), is the position
    // of each shading point within its piece of a visible segment (rays.glsl).
    RaySets sets;
    // Per line: xy is the unit vector in (u, v) perpendicular to the mean direction of the line's variants, which are
    // its versions in different pixels (ray_sets.h). z is the max distance of a variant from the line in the mean
    // direction.
    std::vector<glm::vec4> strips;
};

// Returns the lines of a frame's pixels. If `turned`, angles and positions differ between neighbouring pixels;
// otherwise they are the same in all pixels, as in Tzeng et al. 2012. Groups of `linesPerPosition` lines share a
// position in the pixel (Figure 2 of Tzeng et al. 2012). The angles of each group are evenly spread. Throws Error if
// the lens has an aperture image.
LineSets lineSets(const FramePlan& plan, bool turned, std::uint32_t linesPerPosition = 1);

// Returns the distance from the aperture's centre to its rim at `angle` in radians, without blade rotation and
// anamorphic squeeze.
double apertureRim(const Aperture& aperture, double angle);

}  // namespace defocus::engine
