#pragma once
// Blurs an image by a disk of per-pixel radius, with separable complex kernels (circular_kernel.h).
//
// The image, a "field", has a weight (such as coverage) in alpha, and in RGB the radiance times this weight. Rows and
// then columns are filtered with the radius of the output pixel. Taps are normalised in each pass, so a constant image
// stays constant for any radii.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "gl/fullscreen.h"
#include "gl/target.h"
#include "gl/texture.h"
#include "render/circular/circular_kernel.h"

namespace defocus::engine {

// Storage format of the complex sums between the row pass and the column pass.
enum class ComplexStorage {
    float32,
    // half float; kernels of more than five components (three for Niemitalo's kernels) use float32 because of rounding
    // errors
    half,
    // 10 bits per channel. Radiance and weight are divided by their max over the image, then sums are mapped to [0, 1]
    // (Bracket).
    rgb10A2,
};

enum class ComplexTaps {
    exact,  // one tap per pixel
    eight,  // eight taps on each side of the centre, evenly spaced over the radius (as published)
};

struct ComplexBlurInfo {
    int width = 1;
    int height = 1;
    // Horizontal and vertical semi-axes of an elliptical blur, relative to the radius.
    double across = 1;
    double upwards = 1;
    int components = 1;  // number of components: see circularKernel()
    KernelConstants constants = KernelConstants::fitted;
    ComplexStorage storage = ComplexStorage::half;
    ComplexTaps taps = ComplexTaps::exact;
    bool direct = false;  // true: one pass with O(radius²) taps instead of two separable passes; same image
    std::filesystem::path shaderFolder;
};

class ComplexBlur {
public:
    // Needs a current OpenGL context.
    explicit ComplexBlur(const ComplexBlurInfo& info);

    // Blurs `field` (RGBA) by the per-pixel radius in px in the red channel of `radius`. Both have the size in
    // ComplexBlurInfo. With `part`, only this rectangle of the result is drawn.
    void blur(const GlTexture& field, const GlTexture& radius, const std::optional<TexelRectangle>& part = {});
    // Returns the result of the latest blur(): 32-bit floats, with linear filtering.
    [[nodiscard]] const GlTexture& result() const { return result_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    // Components [first, first + count) of the kernel, filtered by one pair of passes. The number of render targets
    // limits `count`.
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
    // Max radiance and max weight of each tile of 8 × 8, 64 × 64, … px, one texture per tile size. The last texture has
    // one texel.
    std::vector<GlTexture> brightest_;
    std::vector<GlTexture> sums_;
    Target sumTarget_;
    GlTexture result_;
    Target resultTarget_;
    Fullscreen fullscreen_;
};

// Mapping of a sum over n taps to [0, 1], the range in which it is stored (Garcia's appendix). The taps have pixel
// values J in [0, 1] and weights G, the real or imaginary parts of a kernel component. The stored value is I′ = (ΣG·J/n
// − offset·ΣJ/n)/scale. `offset` is the min of G.
//
// If the taps do not depend on the radius, scale = Σ(G − offset)/n as published, so that I′ is 1 for a white field.
// Otherwise `scale` is max G − min G over all radii. I′ then also stays in [0, 1], but at large radii a white field
// reaches only about half of this range.
struct Bracket {
    double offset = 0;
    double scale = 1;
};
struct ComplexBracket {
    Bracket real;
    Bracket imaginary;
};
ComplexBracket bracketOf(const CircularComponent& component, ComplexTaps taps);

}  // namespace defocus::engine
