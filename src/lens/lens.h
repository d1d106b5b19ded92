#pragma once
// Defines a lens by the parameters that photographers, USD and Blender use, and derives the parameters for rendering.
//
// Let A be the aperture's diameter and s the focus distance (m), W the image's width in px, and θx the horizontal field
// of view. A point at depth z is blurred to a disk of diameter
//   c(z) = A · |1/s − 1/z| · W / (2 tan(θx/2))  pixels,
// the circle of confusion (CoC). circle_of_confusion.h adds the artistic controls.

#include <limits>
#include <memory>

#include "image/image.h"

namespace defocus::engine {

inline constexpr double millimetre = 1e-3;  // m

struct Lens {
    // Settings of the camera and its exposure.
    double focalLength = 50;         // focal length in mm
    double fStop = 2.8;              // f-number, > 0
    double focusDistance = 2.5;      // distance in m from the camera along the view axis, > 0 (infinity is allowed)
    double horizontalAperture = 36;  // sensor width in mm
    bool dofEnabled = true;          // false: a pinhole camera, regardless of the f-number
    double blurScale = 1;            // multiplies the blur, ≥ 0; 1 is physically correct
    bool focusBreathing = false;     // true: the field of view narrows for near focus, as for a thin lens
    double exposureTime = 0;         // exposure time in s (photographic_exposure.h); 0: no effect on the exposure
    double iso = 100;                // sensitivity, > 0

    // Shape of the aperture, and aberrations of the lens; see aperture.h and aberrations.h.
    int bladeCount = 0;                   // 0: a disk; else a polygon of 3 or more blades
    double bladeRotation = 0;             // rotation in radians; also rotates aperture images
    double bladeCurvature = 0;            // curvature of the blades; 0: straight, 1: a circle
    double anamorphicRatio = 1;           // values > 1 narrow the aperture horizontally (tall ovals)
    double obstruction = 0;               // inner over outer diameter of a mirror lens's aperture, [0, 1)
    double sphericalAberration = 0;       // [−1, 1]; > 0: blur disks with a bright rim, < 0: with a bright centre
    double catEye = 0;                    // fraction of the aperture's radius clipped at image corners, [0, 1]
    double axialChromaticAberration = 0;  // dioptres between red and blue focus planes; > 0: the red plane is farther
    double astigmatism = 0;               // radial streak length in mm at the sensor's edges; see aberrations.h
    double coma = 0;                      // comet tail length in mm at the sensor's edges; > 0: points outwards
    std::shared_ptr<const Image> apertureImage = {};  // grey values are transmission; null: shape from the fields above

    // Artistic controls of the blur; see circle_of_confusion.h.
    double foregroundLimit = std::numeric_limits<double>::infinity();  // max CoC in front of the focus plane, px
    double backgroundLimit = std::numeric_limits<double>::infinity();  // max CoC behind the focus plane, px
    double focusRangeFront = 0;        // extent in m of the sharp range in front of the focus plane, [0, focusDistance)
    double focusRangeBehind = 0;       // extent in m of the sharp range behind the focus plane, ≥ 0
    bool focusRangeRefocuses = false;  // true: behind the sharp range, blur as if focused at the range's far end
    double focusTilt = 0;              // radians about the horizontal axis; > 0: the focus plane's top comes nearer
    double focusSwing = 0;  // radians about the vertical axis; > 0: the focus plane's right side comes nearer
    // Curvature κ of the focus surface, whose depth is focusDistance/(1 + κ·r²). r is 1 at the left and right edges.
    double fieldCurvature = 0;
    double radialBlurGain = 0;  // gain g: the blur is multiplied by 1 + g·r²; r is 1 at the left and right edges
};

// Throws Error, with the name of the invalid value in its message, if the lens is impossible. Examples: NaN, fStop ≤ 0,
// 1 or 2 blades, or a focus distance below the focal length with focus breathing.
void checkLens(const Lens& lens);

double tanHalfHorizontalFov(const Lens& lens);  // tan(θx/2); with focusBreathing, depends on focusDistance
double apertureDiameter(const Lens& lens);      // diameter in m, including blurScale; 0 without depth of field
double focalLengthFromFov(double tanHalfHorizontal, double horizontalAperture);  // mm; inverse of tanHalfHorizontalFov

}  // namespace defocus::engine
