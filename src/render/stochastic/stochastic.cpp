#include "render/stochastic/stochastic.h"

#include <cmath>

#include "render/lens_space/lens_space.h"
#include "render/lens_space/record_buffer.h"

namespace defocus::engine {

namespace {

constexpr std::uint32_t pointTile = 8;        // tile side in px
constexpr std::uint32_t maxEntries = 40'000;  // max triangles of a tile's list that one dispatch tests
// Size in bytes of the lens bounds of all rays that are traced together: one vec4 per ray, the bounding box of its lens
// points.
constexpr std::size_t boundBytes = blockSamples * sizeof(glm::vec4);

class StochasticKernel final : public VisibilityKernel {
public:
    explicit StochasticKernel(const RendererOptions& options)
        : shaderFolder_(options.shaderFolder), lightsVertices_(options.settings.at("shading") == "vertices") {}

    [[nodiscard]] std::string name() const override { return "stochastic"; }
    [[nodiscard]] std::uint32_t tileSize() const override { return pointTile; }
    [[nodiscard]] bool lightsVertices() const override { return lightsVertices_; }
    [[nodiscard]] RaySets raySets(const FramePlan& plan, std::uint32_t parts) const override {
        return pointRaySets(plan, parts);
    }
    [[nodiscard]] ShaderDefines rayDefines() const override { return {}; }
    [[nodiscard]] std::uint64_t rayBytes() const override { return recordBytes; }

    void start(const FramePlan& plan, const RaySets& rays, const ShaderDefines& defines) override {
        imageSize_ = {plan.view.width, plan.view.height};
        bounds_ = rays.lensBounds;
        boundBlock_ = Buffer(boundBytes);
        const std::uint32_t none[2] = {0, 0};
        tests_ = Buffer(sizeof none, none);
        groups_ = 0;
        ShaderDefines all = defines;
        all.emplace_back("tileSize", std::to_string(pointTile));
        all.emplace_back("maxRays", std::to_string(blockSamples));
        if (program_ && defines_ == all) return;
        defines_ = all;
        program_ = Program({{"stochastic/visible.comp"}, defines_, shaderFolder_});
    }

    std::uint64_t find(LensFront& front, RayWave& wave) override {
        const std::uint64_t pixels = pixelCount(imageSize_.x, imageSize_.y);
        const std::uint64_t records = pixels * wave.count;
        records_.reserve(records);
        boundBlock_.update(0, wave.count * sizeof(glm::vec4), bounds_.data() + wave.first);
        for (const TileBand& band : front.bands()) {
            front.fill(band);
            program_.use();
            front.bindTriangles();
            bindRecords();
            glBindBufferBase(GL_UNIFORM_BUFFER, 7, boundBlock_.name());
            glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 8, tests_.name());
            glUniform2i(0, imageSize_.x, imageSize_.y);
            glUniform1ui(1, wave.first);
            glUniform1ui(2, band.first);
            for (std::uint32_t first = 0; first == 0 || first < front.statistics().largestTile; first += maxEntries) {
                glUniform2ui(3, first, first + maxEntries);
                glDispatchCompute(band.end - band.first, wave.count, 1);
                glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
            }
        }
        groups_ += std::uint64_t{front.statistics().tiles} * wave.count;
        return records;
    }

    void bindRecords() const override { records_.bind(); }
    void addTo(RenderStats& stats) const override {
        if (groups_ == 0) return;
        std::uint32_t words[2] = {0, 0};
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        tests_.read(0, sizeof words, words);
        const double tests = std::ldexp(static_cast<double>(words[1]), 32) + static_cast<double>(words[0]);
        stats.figures.push_back({"triangles tested per ray", tests / static_cast<double>(groups_)});
    }
    [[nodiscard]] std::size_t bytes() const override { return records_.bytes(); }

private:
    std::filesystem::path shaderFolder_;
    bool lightsVertices_;
    glm::ivec2 imageSize_{0};
    std::vector<glm::vec4> bounds_;
    ShaderDefines defines_;
    Program program_;
    Buffer boundBlock_;
    Buffer tests_;  // shader storage block TestBlock of shaders/stochastic/visible.comp
    // Number of pairs of a tile and a ray number that were traced so far. Each pair traces one ray per pixel of the
    // tile.
    std::uint64_t groups_ = 0;
    RecordBuffer records_;
};

}  // namespace

Method stochasticMethod() {
    return {.name = "stochastic",
            .description = "lens space: different lens points for each pixel (Munkberg, Toth and Akenine-Möller 2012)",
            .showsThrough = false,
            .drawsShadows = false,
            .settings = {shadingSetting(), cocInterpolationSetting()},
            .make = [](const World& world, const RendererOptions& options) {
                return makeLensSpaceRenderer(world, options, std::make_unique<StochasticKernel>(options));
            }};
}

}  // namespace defocus::engine
