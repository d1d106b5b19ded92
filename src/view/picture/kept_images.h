#pragma once
// Keeps lens images of a still view: the image of each lens sample. The window computes pictures with another focus
// distance or a smaller aperture from these images in one frame, by the mathematics of refocus/refocus.h. Levels of
// detail of the images suit all focus distances of a range around the view's own.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "refocus/refocus.h"
#include "render/lens_images/image_stack.h"
#include "render/methods.h"

namespace defocus::engine {

// Returns the focus distances for which images of the view are kept: from the nearest to the farthest box of the
// plan's objects, limited to distances at which an image moves by at most an eighth of the picture's longer side. The
// range contains the view's own focus distance. Throws Error in the cases of lightFieldInfo.
FocusRange keptRange(const View& view, const FramePlan& plan);

class KeptImages {
public:
    static constexpr std::uint32_t maxImages = ImageStack::maxImages;
    static constexpr std::uint32_t minImages = 16;  // with fewer images, blurred surfaces show as copies

    // `world` must outlive this object. `software`: OpenGL runs on the CPU. Needs a current GL context.
    KeptImages(const World& world, RendererOptions options, bool software);

    // Plans the images of a view: maxImages, or as many as fit into `bytes` and into a quarter of the free memory.
    // Replaces the images of the previous view.
    // `plan`: a plan of the view. If the lens or the memory doesn't allow images, none are planned; see obstacle().
    void begin(const View& view, const RenderSettings& settings, const FramePlan& plan, std::uint64_t bytes);
    // Draws images until about `milliseconds` have passed, at least one. Returns false once all images are drawn.
    bool grow(double milliseconds);
    // Frees the images.
    void discard();

    // Returns the number of images drawn, and the number of planned images; 0 without a plan.
    [[nodiscard]] std::uint32_t drawn() const { return drawn_; }
    [[nodiscard]] std::uint32_t planned() const { return static_cast<std::uint32_t>(plan_.samples.size()); }
    [[nodiscard]] bool complete() const { return planned() > 0 && drawn_ == planned(); }
    // Returns why no images are planned; empty if images are planned or begin() was not called.
    [[nodiscard]] const std::string& obstacle() const { return obstacle_; }
    // Returns how many planned images contribute to a picture with the lens's focus distance and f-number. Returns 0 if
    // either value is outside the range of the images, or if less than a quarter of the images lie within the aperture.
    [[nodiscard]] std::uint32_t serving(const Lens& lens) const {
        return static_cast<std::uint32_t>(imagesFor(lens).size());
    }

    // Draws the picture for the lens's focus distance and f-number from the images that serving() counts. serving()
    // must be at least 1, and all planned images must be drawn. `lens` may differ from the lens of begin() in these two
    // values only.
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
    std::unique_ptr<Renderer> renderer_;  // draws images; null when none are being drawn
    LightFieldInfo info_;
    FramePlan plan_;
    std::uint32_t drawn_ = 0;
    std::string obstacle_;
    ImageStack stack_;
};

}  // namespace defocus::engine
