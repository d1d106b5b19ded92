#include "gl/target.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "core/error.h"

namespace defocus::engine {

namespace {

const char* inWords(GLenum status) {
    switch (status) {
        case GL_FRAMEBUFFER_UNSUPPORTED:
            return "the driver does not support this combination of formats";
        case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
            return "an attachment is not renderable";
        case GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS:
            return "some attachments are layered and others are not";
        case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
            return "it has no attachment";
        default:
            return "it is incomplete";
    }
}

}  // namespace

Target::Target(const std::vector<const GlTexture*>& colors, const GlTexture* depth) {
    create();
    for (const GlTexture* color : colors) addColor(*color, std::nullopt);
    finish(depth);
}

Target Target::ofImageAndLayers(const GlTexture& image, const GlTexture& array, int layers) {
    Target target;
    target.create();
    target.addColor(image, std::nullopt);
    for (int layer = 0; layer < layers; ++layer) target.addColor(array, static_cast<std::uint32_t>(layer));
    target.finish(nullptr);
    return target;
}

Target Target::ofLayer(const std::vector<const GlTexture*>& colors, std::uint32_t layer, int level,
                       const GlTexture* depth) {
    Target target;
    target.create();
    for (const GlTexture* color : colors) target.addColor(*color, layer, level);
    target.finish(depth);
    return target;
}

void Target::create() {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    handle_ = GlHandle<destroyFramebuffer>(name);
}

void Target::addColor(const GlTexture& color, std::optional<std::uint32_t> layer, int level) {
    const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(colors_++);
    if (layer)
        glNamedFramebufferTextureLayer(name(), attachment, color.name(), level, static_cast<GLint>(*layer));
    else
        glNamedFramebufferTexture(name(), attachment, color.name(), level);
    width_ = std::max(color.info().width >> level, 1);
    height_ = std::max(color.info().height >> level, 1);
}

void Target::drawAllColors() const {
    std::array<GLenum, 8> drawBuffers{};
    std::iota(drawBuffers.begin(), drawBuffers.end(), GL_COLOR_ATTACHMENT0);
    glNamedFramebufferDrawBuffers(name(), colors_, drawBuffers.data());
}

void Target::finish(const GlTexture* depth) {
    drawAllColors();
    if (depth != nullptr) {
        glNamedFramebufferTexture(name(), GL_DEPTH_ATTACHMENT, depth->name(), 0);
        width_ = depth->info().width;
        height_ = depth->info().height;
    }
    const GLenum status = glCheckNamedFramebufferStatus(name(), GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        fail("cannot create a render target of {} x {} px: {}", width_, height_, inWords(status));
}

void Target::resolve(const Target& to, bool depth) const {
    for (GLsizei color = 0; color < colors_; ++color) {
        const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(color);
        glNamedFramebufferReadBuffer(name(), attachment);
        std::array<GLenum, 8> drawn{};  // all GL_NONE except the attachment to copy to
        drawn[static_cast<std::size_t>(color)] = attachment;
        glNamedFramebufferDrawBuffers(to.name(), color + 1, drawn.data());
        const GLbitfield depthBit = depth && color == 0 ? GL_DEPTH_BUFFER_BIT : 0;
        glBlitNamedFramebuffer(name(), to.name(), 0, 0, width_, height_, 0, 0, width_, height_,
                               GL_COLOR_BUFFER_BIT | depthBit, GL_NEAREST);
    }
    to.drawAllColors();
}

void Target::bind() const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, name());
    glViewport(0, 0, width_, height_);
}

}  // namespace defocus::engine
