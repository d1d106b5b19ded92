#pragma once
// Lens settings of a request, in the terms and units of photographers, USD and Blender. A setting without a value falls
// back to the file's camera, then to the default named here. docs/lens.md shows the effect of each setting.

#include <filesystem>
#include <optional>

namespace defocus {

struct LensSettings {
    // Camera.
    std::optional<double> focalLength;         // mm; sets the field of view. Default: the camera's
    std::optional<double> fStop;               // f-number, > 0. Default: 2.8
    std::optional<double> horizontalAperture;  // mm, width of the sensor. Default: 36
    std::optional<bool> dofEnabled;            // false: a pinhole camera, whatever the f-number
    std::optional<double> blurScale;           // factor on the blur, ≥ 0; 1 is physical
    std::optional<bool> focusBreathing;        // true: thin lens whose view narrows as the focus comes nearer
    std::optional<double> exposureTime;        // s; exposes 8-bit images as a camera does; 0: no effect
    std::optional<double> iso;                 // sensitivity, > 0. Default: 100

    // Aperture.
    std::optional<int> bladeCount;                   // 3 … 64, or 0 for a disk
    std::optional<double> bladeRotation;             // degrees
    std::optional<double> bladeCurvature;            // 0: straight blades, 1: a circle
    std::optional<double> anamorphicRatio;           // > 1: tall ovals
    std::optional<double> obstruction;               // mirror lens: inner over outer diameter, [0, 1)
    std::optional<double> sphericalAberration;       // [−1, 1]; > 0 brightens the rim, < 0 the middle
    std::optional<double> catEye;                    // [0, 1]; fraction of the aperture's radius hidden in the corners
    std::optional<double> axialChromaticAberration;  // dioptres by which red focuses farther away than blue
    std::optional<double> astigmatism;               // mm, length of a focused point's image at left and right edges
    std::optional<double> coma;                      // mm, length of the coma's tail at these edges; > 0: outwards
    std::filesystem::path apertureImage;             // replaces the shape above by an image; empty: none

    // Artistic controls of the blur (Munkberg, Toth and Akenine-Möller 2012).
    std::optional<double> foregroundLimit;    // px, maximum blur diameter in front of the focus
    std::optional<double> backgroundLimit;    // px, maximum blur diameter behind the focus
    std::optional<double> focusRangeFront;    // m in front of the focus distance that stay sharp
    std::optional<double> focusRangeBehind;   // m behind the focus distance that stay sharp
    std::optional<bool> focusRangeRefocuses;  // true: blur behind the range as if focused at its far end
    std::optional<double> focusTilt;          // degrees about the horizontal axis; > 0: the plane's top comes nearer
    std::optional<double> focusSwing;         // degrees about the vertical axis; > 0: the plane's right comes nearer
    // κ of the curved focus surface s/(1 + κr²), where s is the focus distance. r is the distance from the image
    // centre; r = 1 at the left and right edges.
    std::optional<double> fieldCurvature;
    std::optional<double> radialBlurGain;  // κ of the gain 1 + κr² on the blur, with the same r

    bool operator==(const LensSettings&) const = default;
};

}  // namespace defocus
