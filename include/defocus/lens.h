#pragma once
// A camera's lens as it is asked for, in the words and units of photographers, USD and Blender. What isn't given is the
// file's camera's own, else the default. docs/lens.md shows what each value does.

#include <filesystem>
#include <optional>

namespace defocus {

struct LensSettings {
    // Camera.
    std::optional<double> focalLength;         // mm; sets the field of view, which is else the camera's
    std::optional<double> fStop;               // f-number, > 0; else 2.8
    std::optional<double> horizontalAperture;  // mm, width of the sensor; else 36
    std::optional<bool> dofEnabled;            // false: a pinhole, whatever the f-number
    std::optional<double> blurScale;           // 1 is physical; ≥ 0
    std::optional<bool> focusBreathing;        // the textbook thin lens: the view narrows as the focus comes nearer
    std::optional<double> exposureTime;        // s; exposes 8-bit images as a camera does; 0: it doesn't
    std::optional<double> iso;                 // sensitivity, > 0; else 100

    // Aperture.
    std::optional<int> bladeCount;                   // 3 … 64, or 0 for a disk
    std::optional<double> bladeRotation;             // degrees
    std::optional<double> bladeCurvature;            // 0: straight blades, 1: a circle
    std::optional<double> anamorphicRatio;           // > 1: tall ovals
    std::optional<double> obstruction;               // of a mirror lens: inner diameter over the outer, [0, 1)
    std::optional<double> sphericalAberration;       // [−1, 1]; > 0 brightens the rim, < 0 the middle
    std::optional<double> catEye;                    // [0, 1]; how far the barrel hides the aperture in the corners
    std::optional<double> axialChromaticAberration;  // dioptres by which red focuses farther away than blue
    std::optional<double> astigmatism;               // mm, length of a sharp point's image at the left and right edges
    std::optional<double> coma;                      // mm, length of its tail there; > 0 points outwards
    std::filesystem::path apertureImage;             // of the aperture, in place of the shape above; empty: none

    // An artist's controls of the blur (Munkberg, Toth and Akenine-Möller 2012).
    std::optional<double> foregroundLimit;    // px, largest blur in front of the focus
    std::optional<double> backgroundLimit;    // px, largest blur behind the focus
    std::optional<double> focusRangeFront;    // m in front of the focus distance that stay sharp
    std::optional<double> focusRangeBehind;   // m behind the focus distance that stay sharp
    std::optional<bool> focusRangeRefocuses;  // behind the range, the blur of a lens that is focused at its far end
    std::optional<double> focusTilt;          // degrees about the horizontal axis; > 0: the plane's top comes nearer
    std::optional<double> focusSwing;         // degrees about the vertical axis; > 0: its right side comes nearer
    std::optional<double> fieldCurvature;  // κ of the curved focus surface s/(1 + κr²); r is 1 at left and right edge
    std::optional<double> radialBlurGain;  // κ of the gain 1 + κr² on the blur

    bool operator==(const LensSettings&) const = default;
};

}  // namespace defocus
