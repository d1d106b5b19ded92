#pragma once
// The background of a transmitting surface: a copy of the layers made just before the surface is drawn into them.

#include "gl/texture.h"

namespace defocus::engine {

class Backdrop {
public:
    // Copies layers [0, count) of `colors` (or its single image). Reallocates only if size or format change. `blurred`:
    // also makes mipmaps, which serve rough transmission. The bound framebuffer stays bound.
    void take(const GlTexture& colors, std::uint32_t count, bool blurred);
    void attach(GLuint unit) const { copy_.attach(unit); }
    [[nodiscard]] std::size_t bytes() const { return copy_.bytes(); }

private:
    GlTexture copy_;
};

}  // namespace defocus::engine
