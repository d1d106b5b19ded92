#pragma once
// Scissor test for the lifetime of the object: restricts drawing to a rectangle in px from the lower left corner.
// nullopt means no restriction.

#include <optional>

#include "gl/texture.h"

namespace defocus::engine {

class Scissor {
public:
    explicit Scissor(const std::optional<TexelRectangle>& part) : on_(part.has_value()) {
        if (!on_) return;
        glScissor(part->x, part->y, part->width, part->height);
        glEnable(GL_SCISSOR_TEST);
    }
    ~Scissor() {
        if (on_) glDisable(GL_SCISSOR_TEST);
    }
    Scissor(const Scissor&) = delete;
    Scissor& operator=(const Scissor&) = delete;

private:
    bool on_;
};

}  // namespace defocus::engine
