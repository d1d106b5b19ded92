#pragma once
// Blurs a field with a disk as wide as each pixel asks for, by separable complex kernels (circular_kernel.h).
//
// A field is radiance times weight with the weight as alpha. Rows, then columns are filtered at each pixel's own
// radius; taps are normalised in every pass, so that a constant stays constant however the radius varies.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "gl/texture.h"

namespace defocus::engine {

// How the rows' complex sums are stored.
enum class ComplexStorage {
    float32,
    half,     // kernels of more than five components (published ones of more than three) take float32: rounding grows
    rgb10A2,  // Garcia's brackets, see Bracket; radiance and weight are divided by their largest
};

enum class ComplexTaps {
    exact,  // one a pixel
    eight,  // eight on each side, spread over the radius (as published)
    sets,   // 4, 8, 16 or 32 on each side, by the radius at the pixel
};

enum class KernelConstants {
    fitted,     // circularKernel: the closest to the disk
    published,  // publishedCircularKernel: those of Garcia's slides
};

struct ComplexBlurInfo {
    int width = 1;
    int height = 1;
    // Of an oval, shares of the radius to the right and up.
    double across = 1;
    double upwards = 1;
    int components = 1;  // 1 … circularKernelLimit, or publishedKernelLimit
    KernelConstants constants = KernelConstants::fitted;
    ComplexStorage storage = ComplexStorage::half;
    ComplexTaps taps = ComplexTaps::exact;
    bool direct = false;  // gather the whole square instead: the same image, O(radius²)
    std::filesystem::path shaderFolder;
};

class ComplexBlur {
public:
    // Needs a current GL context.
    explicit ComplexBlur(const ComplexBlurInfo& info);

    // `field` (RGBA) with the blur radius of each pixel in px in `radius` (R); both of the size given. With `part`,
    // only that of the result is drawn.
    void blur(const GlTexture& field, const GlTexture& radius, const std::optional<TexelRectangle>& part = {});
    // The blurred field of the last call, 32-bit floats, sampled linearly.
    [[nodiscard]] const GlTexture& result() const { return result_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    // Components [first, first + count) are filtered at a time: as many as there are render targets for.
    struct Group {
        int first = 0;
        int count = 0;
        Program horizontal;
        Program vertical;
    };

    void makeGroups();
    void findBrightest(const GlTexture& field);
    [[nodiscard]] bool bracketed() const { return info_.storage == ComplexStorage::rgb10A2; }

    ComplexBlurInfo info_;
    std::vector<Group> groups_;
    Program direct_;
    Program reduce_, reduceColor_;
    std::vector<GlTexture> brightest_;  // each a tile's largest radiance and weight, down to one pixel
    std::vector<GlTexture> sums_;
    Target sumTarget_;
    GlTexture result_;
    Target resultTarget_;
    Fullscreen fullscreen_;
};

// How the sums of a component's real or imaginary taps G over n samples J in [0, 1] are stored (Garcia's appendix): as
// I′ = (ΣG·J/n − offset·ΣJ/n)/scale with the least tap as offset.
// Where the taps don't depend on the radius, scale = Σ(G − offset)/n as published: I′ is 1 for a white field, and no
// tap weighs more than its share. Else scale is the range of the taps at any radius, which bounds I′ to [0, 1] as well,
// but leaves its upper half unused.
struct Bracket {
    double offset = 0;
    double scale = 1;
};
struct ComplexBracket {
    Bracket real;
    Bracket imaginary;
};
struct CircularComponent;
ComplexBracket bracketOf(const CircularComponent& component, ComplexTaps taps);

}  // namespace defocus::engine
