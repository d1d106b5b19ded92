#pragma once
// Draws a full-screen triangle, for passes that compute a value at each pixel.

#include "gl/buffer.h"
#include "gl/program.h"

namespace defocus::engine {

// Path of the vertex shader for all programs that draw a full-screen triangle.
inline constexpr const char* fullscreenShader = "include/fullscreen.vert";

class Fullscreen {
public:
    // Runs `program` on every pixel of the bound target, without depth test, culling or blending.
    void draw(const Program& program) const;
    // Draws `count` point sprites with `program`, whose vertex shader sets their positions and sizes.
    void drawSquares(const Program& program, int count) const;
    // Same as draw(), with additive blending.
    void drawAdding(const Program& program) const;
    // Same as draw(), with "over" blending of premultiplied colours.
    void drawOver(const Program& program) const;

private:
    void drawBlended(const Program& program, GLenum kept) const;

    VertexArray noVertices_;
};

}  // namespace defocus::engine
