#include "render/line/line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/error.h"
#include "gl/context.h"
#include "render/lens_space/lens_space.h"
#include "render/lens_space/record_buffer.h"
#include "render/line/line_sets.h"

namespace defocus::engine {

namespace {

constexpr std::uint32_t lineTile = 8;  // tile side in px
constexpr std::size_t rangeBytes = 2 * sizeof(std::uint32_t);
constexpr std::size_t jobRanges = 2;  // elements of `ranges` (kernel.glsl) per deferred job (one line in one tile)
// Mesa's llvmpipe ends the loops of a shader invocation after a total of 65,535 iterations. Kernels may do up to twice
// softwareRounds iterations before they defer the rest to the next dispatch.
constexpr std::uint32_t softwareRounds = 30'000;
// Approximate size in bytes of the saved states of jobs (one line in one tile each) that take several dispatches.
constexpr std::size_t stateBytes = 32u << 20;
constexpr std::uint64_t expectedRecords = 6;    // initial buffer size in records (ray hits) per line
constexpr std::uint32_t maxShadingPoints = 16;  // max shading points per visible interval of a line
constexpr std::uint32_t firstCapacity = 48;     // initial max number of intervals per line, for the exact kernel
constexpr std::uint32_t maxCapacity = 1536;
constexpr std::uint32_t sharedBytes = 24;  // max bytes of shared memory per segment of a line
constexpr float lightUnit = 1.0f / 1024;   // unit of Counters::droppedLight

// Element of the uniform block BoundBlock in shaders/line/kernel.glsl (std140).
struct GpuBounds {
    glm::vec4 box;
    glm::vec4 strip;
};

// Counters at the start of the output buffer; `ranges` of shaders/line/kernel.glsl follows.
struct Counters {
    std::uint32_t records = 0;
    std::uint32_t droppedSegments = 0;
    std::uint32_t droppedLight = 0;
    std::uint32_t mergedSegments = 0;
    std::uint32_t laterJobs = 0;
    std::uint32_t unfinishedJobs = 0;
};

constexpr std::uint32_t standardSegments = 16;

class LineKernel final : public VisibilityKernel {
public:
    explicit LineKernel(const RendererOptions& options)
        : shaderFolder_(options.shaderFolder),
          exact_(options.settings.at("resolve") == "exact"),
          lightsVertices_(options.settings.at("shading") == "vertices"),
          turned_(options.settings.at("wheel") == "turned"),
          shortIntervals_(options.settings.at("interval-bits") == "16"),
          areaWeights_(options.settings.at("line-weights") == "area"),
          linesPerPosition_(static_cast<std::uint32_t>(numberOf(options.settings, "lines-per-position"))),
          binSize_(static_cast<std::uint32_t>(numberOf(options.settings, "bin-size"))),
          segments_(static_cast<std::uint32_t>(numberOf(options.settings, "segments"))),
          shadingStep_(static_cast<float>(numberOf(options.settings, "shading-step"))) {
        if (exact_ && segments_ != standardSegments)
            fail("method line: 'segments' has an effect only with resolve=published; leave it out");
        if (exact_ && shortIntervals_)
            fail("method line: 'interval-bits' has an effect only with resolve=published; leave it out");
    }

    [[nodiscard]] std::string name() const override { return "line"; }
    [[nodiscard]] std::uint32_t tileSize() const override { return lineTile; }
    [[nodiscard]] bool lightsVertices() const override { return lightsVertices_; }
    [[nodiscard]] RaySets raySets(const FramePlan& plan, std::uint32_t /*parts*/) const override {
        return lineSets(plan, turned_, linesPerPosition_).sets;
    }
    [[nodiscard]] ShaderDefines rayDefines() const override { return {{"lineSamples", "true"}}; }
    [[nodiscard]] const char* addShader() const override { return "line/add.comp"; }
    [[nodiscard]] std::uint64_t rayBytes() const override { return 2 * expectedRecords * recordBytes; }

    void start(const FramePlan& plan, const RaySets& rays, const ShaderDefines& defines) override {
        if (!plan.moments.empty()) fail("method line: motion blur is not supported; choose stochastic or accumulation");
        imageSize_ = {plan.view.width, plan.view.height};
        if (plan.usesLens && plan.coc.aberrates())
            fail(
                "method line: astigmatism and coma are not supported, because they bend the lines through the lens; "
                "leave both out or choose stochastic");
        const LineSets lines = lineSets(plan, turned_, linesPerPosition_);
        bounds_.clear();
        for (std::uint32_t line = 0; line < rays.rays; ++line)
            bounds_.push_back({rays.lensBounds[line], lines.strips[line]});
        boundBlock_ = Buffer(blockSamples * sizeof(GpuBounds));
        const Lens& lens = plan.view.lens;
        lightOverRadius_ = {static_cast<float>(lens.sphericalAberration),
                            static_cast<float>(lens.obstruction * lens.obstruction)};
        defines_ = defines;
        maxRounds_ = currentIsSoftware() ? softwareRounds : 0;
        totals_ = {};
        lines_ = 0;
        droppedEntries_ = 0;
        if (exact_) {
            build(capacity_);
            return;
        }
        GLint max = 0;
        glGetIntegerv(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE, &max);
        const auto beside =
            static_cast<GLint>(lineTile * lineTile * (3 * sizeof(glm::vec4) + 2 * sizeof(std::uint32_t)) + 64);
        const GLint fit = (max - beside) / static_cast<GLint>(lineTile * lineTile * sharedBytes);
        if (static_cast<GLint>(segments_) > fit)
            fail("method line: segments must be at most {} on this driver, which has {} bytes of shared memory", fit,
                 max);
        build(segments_);
    }

    std::uint64_t find(LensFront& front, RayWave& wave) override {
        const std::uint64_t pixels = pixelCount(imageSize_.x, imageSize_.y);
        boundBlock_.update(0, wave.count * sizeof(GpuBounds), bounds_.data() + wave.first);
        records_.reserve(std::min(pixels * wave.count * expectedRecords, RecordBuffer::maxRecords()));
        droppedEntries_ = front.statistics().entriesBeyond(binSize_);
        while (true) {
            const Counters counters = draw(front, wave);
            if (exact_ && counters.droppedSegments > 0 && capacity_ < maxCapacity) {
                build(capacity_ *= 2);
                continue;
            }
            if (counters.records > RecordBuffer::maxRecords()) {
                if (wave.count == 1)
                    fail(
                        "method line: with one line per pixel, the image needs {} shaded points, but a buffer of this "
                        "driver holds at most {}; choose a smaller image or a larger --shading-step",
                        counters.records, RecordBuffer::maxRecords());
                wave.count /= 2;
                continue;
            }
            if (counters.records > records_.capacity()) {
                records_.reserve(counters.records);
                continue;
            }
            totals_.droppedSegments += counters.droppedSegments;
            totals_.droppedLight += counters.droppedLight;
            totals_.mergedSegments += counters.mergedSegments;
            totals_.records += counters.records;
            lines_ += pixels * wave.count;
            return counters.records;
        }
    }

    void bindRecords() const override {
        records_.bind();
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 1, output_.name(), 0, static_cast<GLsizeiptr>(output_.bytes()));
    }

    void addTo(RenderStats& stats) const override {
        if (lines_ == 0) return;
        const auto perLine = [&](std::uint64_t count) {
            return static_cast<double>(count) / static_cast<double>(lines_);
        };
        stats.figures.push_back({"shaded points per line", perLine(totals_.records)});
        stats.figures.push_back({"dropped segments per line", perLine(totals_.droppedSegments)});
        stats.figures.push_back({"dropped share of the light", perLine(totals_.droppedLight) * double{lightUnit}});
        stats.figures.push_back({"merged segments per line", perLine(totals_.mergedSegments)});
        if (binSize_ > 0)
            stats.figures.push_back({"triangles beyond the size of a bin", static_cast<double>(droppedEntries_)});
    }

    [[nodiscard]] std::size_t bytes() const override { return records_.bytes() + output_.bytes(); }

private:
    struct Places {  // offsets in `ranges` of shaders/line/kernel.glsl
        std::uint64_t jobs = 0;
        std::uint64_t states = 0;
        std::uint64_t slots = 0;  // number of unfinished jobs (one line in one tile) whose states fit into the buffer
    };
    struct Totals {
        std::uint64_t records = 0;
        std::uint64_t droppedSegments = 0;
        std::uint64_t droppedLight = 0;
        std::uint64_t mergedSegments = 0;
    };

    void build(std::uint32_t segments) {
        ShaderDefines all = defines_;
        all.emplace_back("tileSize", std::to_string(lineTile));
        all.emplace_back("maxRays", std::to_string(blockSamples));
        all.emplace_back("maxShadingPoints", std::to_string(maxShadingPoints));
        all.emplace_back("segmentCapacity", std::to_string(segments));
        if (shortIntervals_) all.emplace_back("shortIntervals", "true");
        if (!areaWeights_) all.emplace_back("areaWeights", "false");
        if (lightsVertices_) all.emplace_back("lightsVertices", "true");
        if (program_ && built_ == all) return;
        built_ = all;
        program_ = Program({{exact_ ? "line/exact.comp" : "line/published.comp"}, all, shaderFolder_});
    }

    // Returns the size of the state that a shader invocation saves between dispatches, in elements of `ranges`
    // (shaders/line/kernel.glsl). Two elements are the bit masks `sides` (visible.glsl) of visible triangles whose
    // segments are not yet added. The others are stateSize in envelope.glsl (exact kernel) or segment_buffer.glsl
    // (published kernel).
    [[nodiscard]] std::size_t stateRanges() const {
        return 2 + (exact_ ? 2 + 4 * std::size_t{capacity_} : 3 + 3 * std::size_t{segments_});
    }

    // Finds the visible intervals on the lines of batch `wave` in all tiles.
    Counters draw(LensFront& front, const RayWave& wave) {
        // Allocate one element of `ranges` (shaders/line/kernel.glsl) per line. If jobs (one line in one tile each) may
        // be deferred to later dispatches, also allocate space for all jobs, and for as many saved states of unfinished
        // jobs as fit into stateBytes.
        const std::uint64_t rays = pixelCount(imageSize_.x, imageSize_.y) * wave.count;
        const std::size_t jobs = maxRounds_ > 0 ? std::size_t{front.statistics().tiles} * wave.count : 0;
        const std::size_t slotBytes = stateRanges() * rangeBytes * lineTile * lineTile;
        const std::size_t slots = jobs > 0 ? std::clamp<std::size_t>(stateBytes / slotBytes, 1, jobs) : 0;
        const Places places{rays, rays + jobRanges * jobs, slots};
        const std::size_t bytes = sizeof(Counters) + places.states * rangeBytes + slots * slotBytes;
        if (output_.bytes() < bytes) {
            output_ = Buffer();  // free the old buffer first: memory might not suffice for old and new buffers
            output_ = storage(bytes, "the lines drawn at once");
        }

        Counters counters;
        output_.update(0, sizeof counters, &counters);
        for (const TileBand& band : front.bands()) {
            front.fill(band);
            use(front, wave, band);
            dispatch({0, 0, 0, places.jobs}, band.end - band.first, wave.count);
            if (maxRounds_ > 0) finishJobs(places);
        }
        return readCounters();
    }

    // Runs the deferred jobs to completion; a job is one line in one tile. The buffer holds the states of
    // `places.slots` unfinished jobs, so at most that many jobs run at a time.
    void finishJobs(const Places& places) {
        const std::uint32_t count = readCounters().laterJobs;
        for (std::uint32_t first = 0; first < count; first += static_cast<std::uint32_t>(places.slots)) {
            const auto atOnce = std::min(count - first, static_cast<std::uint32_t>(places.slots));
            do {
                setCounter(offsetof(Counters, unfinishedJobs), 0);
                dispatch({1, places.jobs + jobRanges * first, places.states, 0}, atOnce, 1);
            } while (readCounters().unfinishedJobs > 0);
        }
        setCounter(offsetof(Counters, laterJobs), 0);
    }

    void use(const LensFront& front, const RayWave& wave, const TileBand& band) {
        program_.use();
        front.bindTriangles();
        bindRecords();
        if (lightsVertices_ && !exact_) front.bindVertexLight(8);
        glBindBufferBase(GL_UNIFORM_BUFFER, 7, boundBlock_.name());
        glUniform2i(0, imageSize_.x, imageSize_.y);
        glUniform1ui(1, wave.first);
        glUniform1ui(2, band.first);
        glUniform1ui(3, static_cast<GLuint>(records_.capacity()));
        glUniform2f(4, lightOverRadius_.x, lightOverRadius_.y);
        glUniform1f(5, shadingStep_);
        glUniform1ui(6, maxRounds_);
        glUniform1ui(8, binSize_);
    }

    // Dispatches the kernel; `jobs` is the uniform of this name in shaders/line/kernel.glsl.
    static void dispatch(const std::array<std::uint64_t, 4>& jobs, std::uint32_t width, std::uint32_t height) {
        glUniform4ui(7, static_cast<GLuint>(jobs[0]), static_cast<GLuint>(jobs[1]), static_cast<GLuint>(jobs[2]),
                     static_cast<GLuint>(jobs[3]));
        glDispatchCompute(width, height, 1);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }

    [[nodiscard]] Counters readCounters() const {
        Counters counters;
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
        output_.read(0, sizeof counters, &counters);
        return counters;
    }

    void setCounter(std::size_t offset, std::uint32_t value) { output_.update(offset, sizeof value, &value); }

    std::filesystem::path shaderFolder_;
    bool exact_;
    bool lightsVertices_;
    bool turned_;
    bool shortIntervals_;
    bool areaWeights_;
    std::uint32_t linesPerPosition_;
    std::uint32_t binSize_;
    std::uint32_t segments_;
    float shadingStep_;
    std::uint32_t capacity_ = firstCapacity;
    glm::ivec2 imageSize_{0};
    glm::vec2 lightOverRadius_{0};
    std::vector<GpuBounds> bounds_;
    ShaderDefines defines_, built_;
    Program program_;
    Buffer boundBlock_, output_;
    RecordBuffer records_;
    std::uint32_t maxRounds_ = 0;  // max loop iterations of a shader invocation per dispatch; 0: unlimited
    Totals totals_;
    std::uint64_t lines_ = 0;
    std::uint64_t droppedEntries_ = 0;  // number of triangles dropped from tiles with more than binSize_ triangles
};

}  // namespace

Method lineMethod() {
    const std::vector<MethodSetting> settings = {
        {.name = "resolve",
         .defaultValue = "exact",
         .description = "Visible segments that are stored for each line sample. exact: all. published: at most as many "
                        "as --segments; further segments are dropped or merged by the rules of Tzeng et al. 2012",
         .choices = {"exact", "published"}},
        {.name = "segments",
         .defaultValue = std::to_string(standardSegments),
         .description = "With --resolve published: maximum number of segments that are stored for each line sample",
         .choices = {},
         .min = 2,
         .max = 64,
         .onlyWith = "resolve=published"},
        {.name = "shading-step",
         .defaultValue = "4",
         .description =
             "Spacing of the shading points along a visible segment, in px. The length of a segment is the shift of "
             "its surface in the image from the lens point at one end to the lens point at the other end. Smaller "
             "values are more accurate and slower. 0: one point in the middle of each segment, as in Tzeng et al. 2012",
         .choices = {},
         .min = 0,
         .max = 64},
        {.name = "interval-bits",
         .defaultValue = "64",
         .description =
             "With --resolve published: number of bits that store both ends of a segment together; 16 in Tzeng et al. "
             "2012",
         .choices = {"64", "16"},
         .onlyWith = "resolve=published"},
        {.name = "line-weights",
         .defaultValue = "area",
         .description = "Weight of each part of a line. area: the lens area that it represents (κ in Tzeng et al. "
                        "2012). length: its length, which makes the middle of bokeh disks too bright",
         .choices = {"area", "length"}},
        {.name = "lines-per-position",
         .defaultValue = "1",
         .description = "Number of lines, in different directions, through each sample position in a pixel",
         .choices = {},
         .min = 1,
         .max = 64},
        {.name = "bin-size",
         .defaultValue = "0",
         .description = "Maximum number of triangles in a bin, a tile of 8 x 8 px. If a bin has more, the farthest are "
                        "dropped, and --stats reports how many. 0: unlimited",
         .choices = {},
         .min = 0,
         .max = 1'000'000},
        shadingSetting(),
        cocInterpolationSetting(),
        {.name = "wheel",
         .defaultValue = "turned",
         .description = "Directions of the lines in each pixel, like the spokes of a wheel. turned: rotated from pixel "
                        "to pixel in an "
                        "8 x 8 pattern. shared: the same in all pixels, as in Tzeng et al. 2012",
         .choices = {"turned", "shared"}},
    };
    return {.name = "line",
            .description = "lens space: line samples across the lens for each pixel (Tzeng et al. 2012)",
            .showsThrough = false,
            .drawsShadows = false,
            .drawsMotion = false,
            .settings = settings,
            .make = [](const World& world, const RendererOptions& options) {
                return makeLensSpaceRenderer(world, options, std::make_unique<LineKernel>(options));
            }};
}

}  // namespace defocus::engine
