#pragma once
// Keeps a copy of the layers, made just before a transmitting surface is drawn into them. The surface shows the copy as
// its background.

#include "gl/texture.h"

namespace defocus::engine {

class Backdrop {
public:
    // Copies layers [0, count) of `colors`, or its only image if it is a 2D texture. If `blurred`, also generates
    // mipmaps for rough transmission. Does not change the bound framebuffer.
    void take(const GlTexture& colors, std::uint32_t count, bool blurred);
    void attach(GLuint unit) const { copy_.attach(unit); }
    [[nodiscard]] std::size_t bytes() const { return copy_.bytes(); }

private:
    GlTexture copy_;
};

}  // namespace defocus::engine
