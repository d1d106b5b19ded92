#pragma once
// What lies behind a transmitting surface: a copy of the layers that surface is about to be drawn into.

#include "gl/texture.h"

namespace defocus::engine {

class Backdrop {
public:
    // Copies layers [0, count) of `colors` (or the one image that it holds), made anew when size or format change.
    // `blurred`: with mipmaps, which serve as rough transmission. The framebuffer stays bound.
    void take(const GlTexture& colors, std::uint32_t count, bool blurred);
    void attach(GLuint unit) const { copy_.attach(unit); }
    [[nodiscard]] std::size_t bytes() const { return copy_.bytes(); }

private:
    GlTexture copy_;
};

}  // namespace defocus::engine
