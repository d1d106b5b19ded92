#pragma once
// A triangle over the whole render target, for passes that compute a value at each pixel.

#include "gl/buffer.h"
#include "gl/program.h"

namespace defocus::engine {

// The vertex shader of such programs.
inline constexpr const char* fullscreenShader = "include/fullscreen.vert";

class Fullscreen {
public:
    // Runs `program` on every pixel of the bound target, without depth test, culling or blending.
    void draw(const Program& program) const;
    // Runs `program` on squares of pixels alone, as many points, whose vertex shader sets their places and sizes.
    void drawSquares(const Program& program, int count) const;
    // As draw(), adding to what the target holds.
    void drawAdding(const Program& program) const;
    // The same, laid over what the target holds: premultiplied by its alpha.
    void drawOver(const Program& program) const;

private:
    void drawBlended(const Program& program, GLenum kept) const;

    VertexArray noVertices_;
};

}  // namespace defocus::engine
