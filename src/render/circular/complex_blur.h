#pragma once
// Blurs a field by a disk of per-pixel radius, using separable complex kernels (circular_kernel.h).
//
// A field is radiance multiplied by a weight, with the weight in alpha. Rows and then columns are filtered at each
// pixel's own radius. Taps are normalised in each pass, so a constant image stays constant for any radii.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "gl/texture.h"

namespace defocus::engine {

// Storage format of the complex sums of the row pass.
enum class ComplexStorage {
    float32,
    // Kernels of more than five components (more than three if published) use float32, because rounding errors grow.
    half,
    rgb10A2,  // Garcia's brackets (see Bracket); radiance and weight are divided by their max
};

enum class ComplexTaps {
    exact,  // one tap per pixel
    eight,  // eight taps on each side, spread over the radius (as published)
    sets,   // 4, 8, 16 or 32 taps on each side, depending on the pixel's radius
};

enum class KernelConstants {
    fitted,     // circularKernel(): best fit to the disk
    published,  // publishedCircularKernel(): the constants of Garcia's slides
};

struct ComplexBlurInfo {
    int width = 1;
    int height = 1;
    // Semi-axes of an oval blur, horizontal and vertical, as a share of the radius.
    double across = 1;
    double upwards = 1;
    int components = 1;  // 1 … circularKernelLimit, or publishedKernelLimit
    KernelConstants constants = KernelConstants::fitted;
    ComplexStorage storage = ComplexStorage::half;
    ComplexTaps taps = ComplexTaps::exact;
    bool direct = false;  // Gathers the full square instead of two passes: the same image at O(radius²) cost.
    std::filesystem::path shaderFolder;
};

class ComplexBlur {
public:
    // Needs a current GL context.
    explicit ComplexBlur(const ComplexBlurInfo& info);

    // Blurs `field` (RGBA) by the radius in px that the red channel of `radius` holds per pixel. Both have the size of
    // the info. With `part`, only this rectangle of the result is drawn.
    void blur(const GlTexture& field, const GlTexture& radius, const std::optional<TexelRectangle>& part = {});
    // The result of the last blur() call: 32-bit floats, linear filtering.
    [[nodiscard]] const GlTexture& result() const { return result_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    // Components [first, first + count) that one pair of passes filters; the number of render targets limits the count.
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
    std::vector<GlTexture> brightest_;  // reduction chain, down to one pixel: max radiance and max weight of each tile
    std::vector<GlTexture> sums_;
    Target sumTarget_;
    GlTexture result_;
    Target resultTarget_;
    Fullscreen fullscreen_;
};

// Storage of the sums of a component's real or imaginary taps G over n samples J in [0, 1] (Garcia's appendix): I′ =
// (ΣG·J/n − offset·ΣJ/n)/scale. `offset` is the smallest tap.
//
// If the taps don't depend on the radius, scale = Σ(G − offset)/n as published: I′ is 1 for a white field. Otherwise
// scale is the range of the taps at any radius. This also bounds I′ to [0, 1] but leaves the upper half unused.
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
