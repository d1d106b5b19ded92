#include "gl/fullscreen.h"

namespace defocus::engine {

void Fullscreen::draw(const Program& program) const {
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    noVertices_.use();
    program.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Fullscreen::drawSquares(const Program& program, int count) const {
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_PROGRAM_POINT_SIZE);
    noVertices_.use();
    program.use();
    glDrawArrays(GL_POINTS, 0, count);
    glDisable(GL_PROGRAM_POINT_SIZE);
}

void Fullscreen::drawAdding(const Program& program) const {
    drawBlended(program, GL_ONE);
}

void Fullscreen::drawOver(const Program& program) const {
    drawBlended(program, GL_ONE_MINUS_SRC_ALPHA);
}

void Fullscreen::drawBlended(const Program& program, GLenum kept) const {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, kept);
    noVertices_.use();
    program.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
}

}  // namespace defocus::engine
