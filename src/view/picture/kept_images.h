#pragma once
// Stores the image of each lens sample (lens image) of a view at rest. From these images, the window computes images
// with another focus distance or a smaller aperture in one frame, with the equations of refocus/refocus.h. The levels
// of detail of the lens images suit all focus distances of a range around the view's focus distance.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "refocus/refocus.h"
#include "render/lens_images/image_stack.h"
#include "render/methods.h"

namespace defocus::engine {

// Returns the range of focus distances for which lens images (one per lens sample) of the view are stored: from the
// nearest to the farthest bounding box of the plan's objects. The range is limited to distances at which a lens image
// shifts by at most an eighth of the picture's longer side, and it contains the view's own focus distance. Throws Error
// in the same cases as lightFieldInfo().
FocusRange keptRange(const View& view, const FramePlan& plan);

class KeptImages {
public:
    static constexpr std::uint32_t maxImages = ImageStack::maxImages;
    static constexpr std::uint32_t minImages = 16;  // with fewer images, blurred surfaces look like overlapping copies

    // `world` must outlive this object. `software`: OpenGL runs on the CPU. Needs a current GL context.
    KeptImages(const World& world, RendererOptions options, bool software);

    // Plans the lens images of a view: at most maxImages, and only as many as fit into `bytes` and into a quarter of
    // the free memory. Replaces the lens images of the previous view. `plan`: frame plan of the view. If the lens or
    // the memory doesn't allow lens images, none are planned; see obstacle().
    void begin(const View& view, const RenderSettings& settings, const FramePlan& plan, std::uint64_t bytes);
    // Draws at least one lens image, and more until about `milliseconds` have passed. Returns false once all are drawn.
    bool grow(double milliseconds);
    // Frees the memory of all lens images.
    void discard();

    // Returns the number of lens images drawn so far, and the number planned; both are 0 without a plan.
    [[nodiscard]] std::uint32_t drawn() const { return drawn_; }
    [[nodiscard]] std::uint32_t planned() const { return static_cast<std::uint32_t>(plan_.samples.size()); }
    [[nodiscard]] bool complete() const { return planned() > 0 && drawn_ == planned(); }
    // Returns why no lens images are planned; empty if some are planned or begin() was not called.
    [[nodiscard]] const std::string& obstacle() const { return obstacle_; }
    // Returns how many planned lens images contribute to a picture with this focus distance and f-number. Returns 0 if
    // either value is outside the range of the lens images, or if fewer than a quarter of them lie within the aperture.
    [[nodiscard]] std::uint32_t serving(const Lens& lens) const {
        return static_cast<std::uint32_t>(imagesFor(lens).size());
    }

    // Computes the picture for the lens's focus distance and f-number from the lens images that can contribute to it;
    // serving() returns their number. serving() must be at least 1, and all planned lens images must be drawn. `lens`
    // may differ from the lens of begin() in these two values only.
    void refocus(const Lens& lens);
    // Returns the latest picture of refocus(): linear, premultiplied RGBA, row 0 at the bottom.
    [[nodiscard]] const GlTexture& picture() const { return stack_.mean(); }

    [[nodiscard]] const LightFieldInfo& info() const { return info_; }
    [[nodiscard]] std::size_t bytes() const { return stack_.bytes(); }

private:
    [[nodiscard]] std::vector<ShiftedImage> imagesFor(const Lens& lens) const;
    void drawImage();

    const World* world_;
    RendererOptions options_;
    std::unique_ptr<Renderer> renderer_;  // draws lens images; null when none are being drawn
    LightFieldInfo info_;
    FramePlan plan_;
    std::uint32_t drawn_ = 0;
    std::string obstacle_;
    ImageStack stack_;
};

}  // namespace defocus::engine
