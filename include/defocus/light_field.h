#pragma once
// A light field is a file of lens images: views of the scene from points on the lens, one for each lens sample. Images
// with another focus, f-number and aperture shape ("pictures") are computed from the lens images without rendering
// (docs/refocus.md). Example:
//
//   auto field = defocus::LightField::render(request, "scene.lens.exr");
//   defocus::writeImage("near.exr", field.refocus({.focus = defocus::FocusDistance{1.2}}));
//
// A LightField must be used by only one thread at a time; different LightFields may be used concurrently.

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "defocus/export.h"
#include "defocus/focus.h"
#include "defocus/image.h"
#include "defocus/lens.h"
#include "defocus/progress.h"
#include "defocus/request.h"
#include "defocus/scene.h"

namespace defocus {

// Settings that can be chosen after rendering. refocusSettings() lists them; any other setting throws UsageError.
struct RefocusSettings {
    // Focus of the picture: a FocusDistance or FocusPixel. CameraFocus keeps the focus distance of the rendered images.
    Focus focus = {};
    LensSettings lens = {};  // f-number and shape of the aperture. Default: those of the rendered images
    bool fillGaps = true;    // true: blurs each lens image, so that blur does not show as separate copies of a surface
};

// Properties of the lens images in a file.
struct LightFieldInfo {
    int width = 0;                  // px
    int height = 0;                 // px
    double focusDistance = 1;       // focus distance of the rendered images, m
    double fStop = 1;               // f-number of the rendered aperture; refocusing cannot use a smaller one
    double focalLength = 0;         // focal length in mm; 0: unknown
    double horizontalAperture = 0;  // sensor width in mm; 0: unknown
    FocusRange focusRange;          // focus distances in m that can be chosen
    // true: the rendered aperture is a full disk, so f-number and aperture shape can be chosen; false: both are fixed
    bool fullDisk = true;
    // For a focus at s, the image of lens point (u, v) moves by pixelsPerDioptre · (1/s − 1/focusDistance) · (u, v) px.
    double pixelsPerDioptre = 0;
    // Lens point (u, v) of each image in the unit disk; u points right, v up.
    std::vector<std::array<double, 2>> lensPoints;
};

// Images that are focused at different distances. The distances divide the rendered range evenly in 1/distance, from
// the nearest to the farthest.
struct FocalStack {
    std::vector<double> focusDistances;  // m
    std::vector<Image> pictures;         // linear, premultiplied RGBA
};

class DEFOCUS_API LightField {
public:
    // Opens a file of lens images. Throws Error if the file cannot be read, contains no lens images, or lacks some of
    // them.
    explicit LightField(const std::filesystem::path& path);
    // Render the lens images of a request to a file with the extension .exr, and open the file. `range`: focus
    // distances that can be chosen later, in addition to the request's own distance; nullopt: from the nearest to the
    // farthest visible surface. A failure leaves no file. Both functions throw:
    // - UsageError if the request's method, samples or target error don't suit lens images;
    // - Error if a change of focus would do more than shift the lens images, as with a tilted focus plane;
    // - the errors of SceneRenderer's constructor.
    static LightField render(const Request& request, const std::filesystem::path& path,
                             std::optional<FocusRange> range = {}, const Progress& progress = {});
    static LightField render(const Scene& scene, const Request& request, const std::filesystem::path& path,
                             std::optional<FocusRange> range = {}, const Progress& progress = {});
    ~LightField();
    LightField(LightField&&) noexcept;
    LightField& operator=(LightField&&) noexcept;

    [[nodiscard]] LightFieldInfo info() const;
    // Returns warnings about the scene and the request, one line each; empty if the lens images were read from a file.
    [[nodiscard]] std::vector<std::string> warnings() const;

    // Returns an image computed from the lens images: linear, premultiplied RGBA. Throws Error if the focus distance or
    // the f-number is outside the rendered range, if no lens point lies within the aperture, or if the file is damaged.
    // Also throws Error if the settings change the aperture's size or shape and LightFieldInfo::fullDisk is false.
    [[nodiscard]] Image refocus(const RefocusSettings& settings = {}, const Progress& progress = {});
    // Returns a focal stack of `count` ≥ 2 images. RefocusSettings::focus must be CameraFocus.
    [[nodiscard]] FocalStack stack(int count, const RefocusSettings& settings = {}, const Progress& progress = {});
    // Returns the view from the lens's centre, in which all surfaces are in focus.
    [[nodiscard]] Image allInFocus(const Progress& progress = {});
    // Returns the depths in m along the view axis of the surfaces visible from the lens's centre; +∞ for pixels without
    // a surface.
    [[nodiscard]] Image depth();
    // Returns the signed diameters in px of the circles of confusion of the surfaces visible from the lens's centre;
    // positive behind the focus plane.
    [[nodiscard]] Image coc(const RefocusSettings& settings = {});

private:
    class DEFOCUS_HIDDEN State;
    LightField(const std::filesystem::path& path, std::vector<std::string> warnings);
    std::unique_ptr<State> state_;
};

// Returns the names of the settings that can be chosen after rendering. docs/settings.md describes the settings.
DEFOCUS_API std::vector<std::string> refocusSettings();

}  // namespace defocus
