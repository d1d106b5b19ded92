#include "render/multirate/multirate.h"

#include <algorithm>
#include <optional>

#include "plan/lens_cells/rates.h"
#include "plan/sample_range.h"
#include "render/accumulation/accumulation.h"
#include "render/accumulation/shared_images.h"
#include "render/gpu_scene/shadow_maps.h"
#include "render/multirate/group_layers.h"

namespace defocus::engine {

namespace {

static_assert(rateBlock == blockSamples);

// The images that groups of neighbouring lens samples share.
class GroupImages final : public SharedImages {
public:
    explicit GroupImages(bool cells) : usesCells_(cells) {}

    void prepareTarget(GpuScene& scene, const SurfacePassInfo& info, const LayerSum& sum) override {
        scene_ = &scene;
        sum_ = &sum;
        shadows_.emplace(scene, info.vertexShaderLayers, info.shaderFolder);
        surfaces_.emplace(scene, info);
    }

    void releaseTarget() override { layers_.reset(); }

    void prepareFrame(const FramePlan& plan) override {
        plan_ = &plan;
        rates_ = frameRates(plan, usesCells_);
    }

    [[nodiscard]] const LensCells& cells() const override { return rates_.cells; }

    FramePlan prepareBlock(std::uint32_t first, std::uint32_t count) override {
        block_ = ratedBlock(*plan_, rates_, first, count);
        groupsDrawn_ = 0;
        if (block_.groupsShare > 0) {
            if (!layers_) layers_.emplace(*sum_);
            frame_.upload(scene_->world(), block_.groups, layers_->count());
            shadows_->prepare(block_.groups, frame_);
            surfaces_->prepare(block_.groups, frame_, &*shadows_);
        }
        return std::move(block_.samples);
    }

    std::uint64_t draw(std::uint32_t first, std::uint32_t count) override {
        const std::uint32_t size = block_.groupSize;
        const std::uint32_t begin = std::max(groupsDrawn_, first / size);
        const std::uint32_t end = std::min((first + count + size - 1) / size, block_.groupsShare);
        if (begin >= end) return 0;
        shadows_->draw(begin, end - begin);
        layers_->begin(begin, end);
        surfaces_->drawOpaque(begin, end - begin);
        groupsDrawn_ = end;
        return trianglesDrawn(block_.groups, begin, end - begin);
    }

    void copyToLayers(std::uint32_t first, std::uint32_t count) const override {
        for (std::uint32_t layer = 0; layer < count; ++layer)
            if (const std::uint32_t group = (first + layer) / block_.groupSize; group < block_.groupsShare)
                layers_->copyTo(*sum_, layer, group, block_.sharedAreas);
    }

    [[nodiscard]] std::size_t bytes() const override {
        return frame_.bytes() + (surfaces_ ? surfaces_->bytes() + shadows_->bytes() : 0) +
               (layers_ ? layers_->bytes() : 0);
    }

private:
    bool usesCells_;
    GpuScene* scene_ = nullptr;
    const LayerSum* sum_ = nullptr;
    const FramePlan* plan_ = nullptr;
    FrameRates rates_;
    // The current block, without the plan of its samples.
    RatedBlock block_;
    std::uint32_t groupsDrawn_ = 0;  // groups before this one have been drawn
    FrameUniforms frame_;
    std::optional<ShadowMaps> shadows_;
    std::optional<SurfacePass> surfaces_;
    std::optional<GroupLayers> layers_;
};

std::vector<MethodSetting> multirateSettings() {
    return {{.name = "cells",
             .standard = "on",
             .description = "blur each sample's image as its part of the lens would; off: what is hardly blurred is "
                            "drawn once for several neighbouring samples instead",
             .choices = {"on", "off"}}};
}

std::unique_ptr<Renderer> makeMultirate(const World& world, const RendererOptions& options) {
    const MethodSettings settings = completeSettings("multirate", multirateSettings(), options.settings);
    return makeSharingAccumulation(world, options, std::make_unique<GroupImages>(settings.at("cells") == "on"));
}

}  // namespace

Method multirateMethod() {
    return {.name = "multirate",
            .description = "the same, each image blurred as its part of the lens would blur it: fewer samples do",
            .sumsBlocks = true,
            .settings = multirateSettings(),
            .make = makeMultirate};
}

}  // namespace defocus::engine
