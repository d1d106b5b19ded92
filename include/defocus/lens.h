#pragma once
// Lens settings of a request, in the terms and units of photographers, USD and Blender. A setting without a value is
// taken from the scene file's camera; if the camera lacks the value, the default applies. docs/lens.md shows the effect
// of each setting.

#include <filesystem>
#include <optional>

namespace defocus {

struct LensSettings {
    // Settings of the camera, and settings for the exposure of 8-bit images.
    std::optional<double> focalLength;         // focal length in mm; sets the field of view. Default: from the camera
    std::optional<double> fStop;               // f-number N, > 0: aperture diameter = focalLength / N. Default: 2.8
    std::optional<double> horizontalAperture;  // sensor width in mm. Default: 36
    std::optional<bool> dofEnabled;            // false: pinhole camera, regardless of the f-number
    std::optional<double> blurScale;           // multiplies the blur diameter, ≥ 0. Default: 1 (physically correct)
    std::optional<bool> focusBreathing;        // true: the field of view narrows for near focus, as for a thin lens
    std::optional<double> exposureTime;        // exposure time in s, for the brightness of 8-bit images; 0: unused
    std::optional<double> iso;                 // sensitivity, 1 … 1e7. Default: 100

    // Shape of the aperture, and aberrations of the lens.
    std::optional<int> bladeCount;                   // number of blades, 3 … 64; 0: circular aperture
    std::optional<double> bladeRotation;             // rotation of the aperture, degrees
    std::optional<double> bladeCurvature;            // curvature of the blades; 0: straight, 1: a circle
    std::optional<double> anamorphicRatio;           // aperture height / width; > 1: tall ovals
    std::optional<double> obstruction;               // mirror lens: inner / outer diameter, [0, 1)
    std::optional<double> sphericalAberration;       // [−1, 1]; > 0: bokeh has a brighter rim; < 0: brighter centre
    std::optional<double> catEye;                    // fraction of the aperture radius clipped at image corners, [0, 1]
    std::optional<double> axialChromaticAberration;  // focus shift in dioptres; > 0: red focuses farther away than blue
    std::optional<double> astigmatism;               // radial streak length in mm on the sensor at the edges
    std::optional<double> coma;                      // comet tail length at the edges, mm on the sensor; > 0: outwards
    std::filesystem::path apertureImage;             // replaces blades, obstruction, spherical aberration; empty: none

    // Artistic blur controls (Munkberg, Toth and Akenine-Möller 2012).
    std::optional<double> foregroundLimit;    // max blur diameter in px in front of the focus plane
    std::optional<double> backgroundLimit;    // max blur diameter in px behind the focus plane
    std::optional<double> focusRangeFront;    // extent in m of the sharp range in front of the focus distance
    std::optional<double> focusRangeBehind;   // extent in m of the sharp range behind the focus distance
    std::optional<bool> focusRangeRefocuses;  // true: behind the range, the blur is that of a focus at its far end
    // Rotations of the focus plane in degrees, about the horizontal and the vertical axis.
    std::optional<double> focusTilt;   // horizontal axis; > 0: the top of the plane is nearer to the camera
    std::optional<double> focusSwing;  // vertical axis; > 0: the right side of the plane is nearer to the camera
    // κ of the curved focus surface with depth s/(1 + κr²), where s is the focus distance. r is the distance from the
    // image's centre; r = 1 at the left and right edges.
    std::optional<double> fieldCurvature;
    std::optional<double> radialBlurGain;  // g of the blur factor 1 + g·r², with r as for fieldCurvature

    bool operator==(const LensSettings&) const = default;
};

}  // namespace defocus
