// Sources: Niemitalo 2010, Circularly symmetric convolution and lens blur; Garcia 2018, Circular Separable Convolution
// Depth of Field. The appendix of Garcia 2018 describes the mapping of sums to [0, 1] (struct Bracket).

#include "render/circular/complex_blur.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <vector>

#include "gl/scissor.h"
#include "render/circular/circular_kernel.h"

namespace defocus::engine {

namespace {

constexpr int maxTargets = 8;
constexpr int reduction = 8;  // each reduction step writes the max of 8 x 8 texels
constexpr GLint firstComponentLocation = 15;
constexpr GLint bracketLocation = 16;
// Max number of components of a fitted kernel whose sums are stored as half floats. With more components, rounding
// errors are too large.
constexpr int maxFittedInHalf = 5;
// Max number of components of Niemitalo's kernels whose sums are stored as half floats. With more components, the large
// weights amplify rounding errors too much.
constexpr int maxPublishedInHalf = 3;
// Largest tap offset, as a multiple of the blur radius. Taps reach up to 1/2 px beyond the radius. The radius is at
// least 1/2 px, so the largest offset is at most twice the radius.
constexpr double outermostTap = 2;
constexpr int bracketSteps = 4096;
constexpr int publishedTaps = 8;  // number of taps on each side of the centre

TextureFormat textureFormat(ComplexStorage storage) {
    switch (storage) {
        case ComplexStorage::float32:
            return TextureFormat::rgba32f;
        case ComplexStorage::half:
            return TextureFormat::rgba16f;
        case ComplexStorage::rgb10A2:
            return TextureFormat::rgb10A2;
    }
    return TextureFormat::rgba16f;
}

int targetsFor(int components, ComplexStorage storage) {
    return storage == ComplexStorage::rgb10A2 ? 3 * components + 1 : 2 * components;
}

int componentsAtOnce(ComplexStorage storage) {
    return storage == ComplexStorage::rgb10A2 ? (maxTargets - 1) / 3 : maxTargets / 2;
}

ShaderDefines definesOf(const ComplexBlurInfo& info, int components) {
    return {{"kernelSize", std::to_string(info.components)},
            {"components", std::to_string(components)},
            {"kernelAxes", fmt::format("vec2({:.9f}, {:.9f})", info.across, info.upwards)},
            {"bracketed", info.storage == ComplexStorage::rgb10A2 ? "true" : "false"},
            {"largestSum", info.storage == ComplexStorage::half ? "65504.0" : "3.0e38"},
            {"exactTaps", info.taps == ComplexTaps::exact ? "true" : "false"}};
}

std::vector<double> realParts(const std::vector<std::complex<double>>& values) {
    std::vector<double> parts;
    for (const std::complex<double>& value : values) parts.push_back(value.real());
    return parts;
}

std::vector<double> imaginaryParts(const std::vector<std::complex<double>>& values) {
    std::vector<double> parts;
    for (const std::complex<double>& value : values) parts.push_back(value.imag());
    return parts;
}

// Returns the Bracket (mapping of a sum to [0, 1]) for taps whose weights are the same at all blur radii. `taps` holds
// one weight per tap.
Bracket bracketOfSum(const std::vector<double>& taps) {
    const double offset = std::ranges::min(taps);
    return {offset, std::reduce(taps.begin(), taps.end()) / static_cast<double>(taps.size()) - offset};
}

// Returns the Bracket (mapping of a sum to [0, 1]) for taps whose number and positions depend on the blur radius. The
// mapping assumes only that each weight lies between the min and the max of `taps`.
Bracket bracketOfRange(const std::vector<double>& taps) {
    const auto [min, greatest] = std::ranges::minmax(taps);
    return {min, greatest - min};
}

void setKernel(const Program& program, std::span<const CircularComponent> kernel) {
    std::vector<float> values;
    for (const CircularComponent& c : kernel)
        for (const double value : {c.decay, c.frequency, c.cosine, c.sine}) values.push_back(static_cast<float>(value));
    glProgramUniform4fv(program.name(), 0, static_cast<GLsizei>(kernel.size()), values.data());
}

}  // namespace

ComplexBracket bracketOf(const CircularComponent& component, ComplexTaps taps) {
    std::vector<std::complex<double>> factors;
    if (taps == ComplexTaps::eight) {
        for (int i = -publishedTaps; i <= publishedTaps; ++i)
            factors.push_back(circularFactor(component, double(i) / publishedTaps));
        return {bracketOfSum(realParts(factors)), bracketOfSum(imaginaryParts(factors))};
    }
    for (int i = 0; i <= bracketSteps; ++i)
        factors.push_back(circularFactor(component, outermostTap * i / bracketSteps));
    return {bracketOfRange(realParts(factors)), bracketOfRange(imaginaryParts(factors))};
}

ComplexBlur::ComplexBlur(const ComplexBlurInfo& info)
    : info_(info),
      result_({.format = TextureFormat::rgba32f, .width = info.width, .height = info.height, .linear = true}),
      resultTarget_({&result_}) {
    constexpr float black[4] = {};
    glClearNamedFramebufferfv(resultTarget_.name(), GL_COLOR, 0, black);
    const int maxInHalf = info_.constants == KernelConstants::fitted ? maxFittedInHalf : maxPublishedInHalf;
    if (info_.storage == ComplexStorage::half && info_.components > maxInHalf) info_.storage = ComplexStorage::float32;
    if (info_.direct) {
        direct_ = Program(
            {{fullscreenShader, "circular/direct.frag"}, definesOf(info_, info_.components), info_.shaderFolder});
        setKernel(direct_, circularKernel(info_.components, info_.constants));
        return;
    }
    makeGroups();
    const int largestGroup = groups_.front().count;
    std::vector<const GlTexture*> targets;
    for (int i = 0; i < targetsFor(largestGroup, info_.storage); ++i)
        sums_.push_back(GlTexture(
            {.format = textureFormat(info_.storage), .width = info_.width, .height = info_.height, .linear = true}));
    for (const GlTexture& sum : sums_) targets.push_back(&sum);
    sumTarget_ = Target(targets);
    if (!bracketed()) return;

    // Create the reduction chain for the max radiance and max weight of a field, down to one pixel.
    const auto pass = [&](const ShaderDefines& defines) {
        return Program({{fullscreenShader, "circular/tile.frag"}, defines, info_.shaderFolder});
    };
    reduce_ = pass({{"tileSize", std::to_string(reduction)}});
    reduceColor_ = pass({{"tileSize", std::to_string(reduction)}, {"ofChannels", "true"}});
    int width = info_.width;
    int height = info_.height;
    do {
        width = (width + reduction - 1) / reduction;
        height = (height + reduction - 1) / reduction;
        brightest_.push_back(GlTexture({.format = TextureFormat::rg32f, .width = width, .height = height}));
    } while (width > 1 || height > 1);
}

void ComplexBlur::makeGroups() {
    const std::span<const CircularComponent> kernel = circularKernel(info_.components, info_.constants);
    const int atOnce = componentsAtOnce(info_.storage);
    for (int first = 0; first < info_.components; first += atOnce) {
        Group group;
        group.first = first;
        group.count = std::min(atOnce, info_.components - first);
        const ShaderDefines defines = definesOf(info_, group.count);
        group.horizontal = Program({{fullscreenShader, "circular/horizontal.frag"}, defines, info_.shaderFolder});
        group.vertical = Program({{fullscreenShader, "circular/vertical.frag"}, defines, info_.shaderFolder});
        std::vector<float> brackets;
        for (const CircularComponent& component :
             kernel.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(group.count))) {
            if (!bracketed()) break;
            const ComplexBracket bracket = bracketOf(component, info_.taps);
            for (const double value :
                 {bracket.real.offset, bracket.real.scale, bracket.imaginary.offset, bracket.imaginary.scale})
                brackets.push_back(static_cast<float>(value));
        }
        for (const Program* program : {&group.horizontal, &group.vertical}) {
            setKernel(*program, kernel);
            glProgramUniform1i(program->name(), firstComponentLocation, first);
            if (bracketed()) glProgramUniform4fv(program->name(), bracketLocation, group.count, brackets.data());
        }
        groups_.push_back(std::move(group));
    }
}

void ComplexBlur::findBrightest(const GlTexture& field) {
    const GlTexture* source = &field;
    for (const GlTexture& level : brightest_) {
        const Target target({&level});
        target.bind();
        source->attach(0);
        fullscreen_.draw(source == &field ? reduceColor_ : reduce_);
        source = &level;
    }
}

void ComplexBlur::blur(const GlTexture& field, const GlTexture& radius, const std::optional<TexelRectangle>& part) {
    if (info_.direct) {
        resultTarget_.bind();
        field.attach(0);
        radius.attach(1);
        const Scissor scissor(part);
        fullscreen_.draw(direct_);
        return;
    }
    if (bracketed()) findBrightest(field);
    std::optional<TexelRectangle> columns = part;  // the columns of `part` over the full height
    if (columns) *columns = {part->x, 0, part->width, info_.height};
    for (const Group& group : groups_) {
        // Filter along rows.
        sumTarget_.bind();
        field.attach(0);
        radius.attach(1);
        if (bracketed()) brightest_.back().attach(2);
        {
            const Scissor scissor(columns);
            fullscreen_.draw(group.horizontal);
        }
        // Filter along columns; later groups of components add to the result.
        resultTarget_.bind();
        for (GLuint i = 0; i < sums_.size(); ++i) sums_[i].attach(i);
        radius.attach(8);
        const Scissor scissor(part);
        if (bracketed()) brightest_.back().attach(9);
        if (group.first == 0)
            fullscreen_.draw(group.vertical);
        else
            fullscreen_.drawAdding(group.vertical);
    }
}

std::size_t ComplexBlur::bytes() const {
    std::size_t total = result_.bytes();
    for (const GlTexture& sum : sums_) total += sum.bytes();
    for (const GlTexture& level : brightest_) total += level.bytes();
    return total;
}

}  // namespace defocus::engine
