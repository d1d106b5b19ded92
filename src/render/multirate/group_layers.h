#pragma once
// The images that groups of lens samples share: layers of colour and depth, from which those of the samples start.

#include <cstdint>
#include <vector>

#include "gl/target.h"
#include "plan/lens_cells/rates.h"
#include "render/accumulation/layer_sum.h"

namespace defocus::engine {

class GroupLayers {
public:
    // As many layers of the size and format of `sum` as groups that the samples of one of its waves can belong to.
    explicit GroupLayers(const LayerSum& sum);

    // K of the groups: group g is drawn into layer g mod count().
    [[nodiscard]] std::uint32_t count() const { return count_; }
    // Clears the layers of groups [first, end) to nothing and makes all layers the render target.
    void begin(std::uint32_t first, std::uint32_t end);
    // Copies what `group` shares, within `areas`, to a layer of `sum`.
    void copyTo(const LayerSum& sum, std::uint32_t layer, std::uint32_t group,
                const std::vector<PixelArea>& areas) const;
    [[nodiscard]] std::size_t bytes() const { return colors_.bytes() + depths_.bytes(); }

private:
    std::uint32_t count_;
    GlTexture colors_;
    GlTexture depths_;
    Target target_;
};

}  // namespace defocus::engine
