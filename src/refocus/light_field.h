#pragma once
// Describes and reads files of lens images. A lens image is the image of the scene from one lens sample, with its
// depth. Together, the images are a light field of the scene, as the lens sees it (Levoy and Hanrahan 1996, Light Field
// Rendering; Ng 2005, Fourier Slice Photography).
//
// A point (u, v) of the lens moves a vertex in clip space by C(w)·(u, k·v). Here k is the image's aspect ratio, w the
// vertex's clip-space w, and C the blur function: C(w) = a + b·w for a thin lens (lens/circle_of_confusion.h). The
// focus distance s appears only in b = (A/2)/(tan(θx/2)·s). Another focus distance s′ thus moves the complete image
// seen from the lens point by
//   P · (1/s′ − 1/s) · (u, v) px,   P = A·W / (4·tan(θx/2)),
// at every depth; u points right and v points up. A is the aperture's diameter in m, W the image's width in px, and θx
// the horizontal field of view.
//
// The file is a multi-part EXR file (image/image_parts.h) with one part per lens sample.

#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "image/image_parts.h"
#include "plan/frame_plan.h"

namespace defocus::engine {

struct LightFieldInfo {
    PartSize size;                   // size of refocused images, and width of each lens image's margin, px
    double focusDistance = 1;        // focus distance s of the rendered images, m
    double fStop = 1;                // f-number of the rendered aperture
    double pixelsPerDioptre = 0;     // shift P of the image seen from lens point (1, 1) per dioptre of focus, px
    FocusRange range;                // focus distances for which the margin and levels of detail of the images suffice
    bool disk = true;                // the rendered aperture is a uniform disk
    std::vector<glm::dvec2> points;  // lens point (u, v) of each image
    std::vector<glm::dvec2> pixels;  // position of each image's sample in its pixel: px right and up from the centre
    Metadata metadata;               // metadata of the frame, without the attributes that store the other members

    // Returns the shift in px, to the right and up, of the image seen from lens point (1, 1) if the focus distance
    // changes to `otherFocus`.
    [[nodiscard]] double shift(double otherFocus) const {
        return pixelsPerDioptre * (1 / otherFocus - 1 / focusDistance);
    }
    // Returns the number stored under `name` in `metadata`, or `fallback` if it is missing.
    [[nodiscard]] double number(const char* name, double fallback) const;
};

// Returns the information about the lens images of a view, without lens points and metadata. The margin suffices for
// all focus distances in `range`, which must contain the view's focus distance. Throws Error if a change of focus does
// not merely shift the images of this lens, or if the margin exceeds the image's longer side.
LightFieldInfo lightFieldInfo(const View& view, const FocusRange& range);

// Adds the lens point and the position within the pixel of each sample in a plan. Throws Error if the plan has objects
// or vertices with a blur scale of their own.
void addSamples(LightFieldInfo& info, const FramePlan& plan);

// Returns the metadata for each part of the EXR file; a part is the image of one lens point.
std::vector<Metadata> partMetadata(const LightFieldInfo& info);

// Access to the images seen from the lens points, in a file or in memory.
class LensImages {
public:
    virtual ~LensImages() = default;
    [[nodiscard]] virtual const LightFieldInfo& info() const = 0;
    [[nodiscard]] virtual const std::string& name() const = 0;  // name by which messages refer to the images
    // Returns the image seen from lens point i, including the margin: linear, premultiplied RGBA.
    [[nodiscard]] virtual std::shared_ptr<const HalfImage> colour(std::size_t i) = 0;
};

class LightField : public LensImages {
public:
    // Throws Error, with the path in its message, if the file cannot be read, is not a file of lens images, or lacks
    // one of its images.
    explicit LightField(const std::filesystem::path& path);

    [[nodiscard]] const std::string& name() const override { return name_; }
    [[nodiscard]] const LightFieldInfo& info() const override { return info_; }
    // colour() and depth() throw Error if the file is damaged.
    [[nodiscard]] std::shared_ptr<const HalfImage> colour(std::size_t i) override;
    // Returns the depths in m of the image seen from lens point i, including the margin.
    [[nodiscard]] Image depth(std::size_t i) { return parts_.depth(i); }
    // Keeps colours in memory after the first read if all of them fit into half of the free memory. This saves time if
    // several refocused images are computed.
    void keepImages();
    // Returns the index of the image whose lens point is nearest to the lens's centre.
    [[nodiscard]] std::size_t central() const;

private:
    std::string name_;
    ImagePartReader parts_;
    LightFieldInfo info_;
    std::vector<std::shared_ptr<const HalfImage>> kept_;  // colours of each image; empty if the images are not kept
};

}  // namespace defocus::engine
