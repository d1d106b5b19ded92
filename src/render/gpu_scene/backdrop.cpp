#include "render/gpu_scene/backdrop.h"

#include <algorithm>

namespace defocus::engine {

void Backdrop::take(const GlTexture& colors, std::uint32_t count, bool blurred) {
    TextureInfo info = colors.info();
    info.layers = std::max(info.layers, 1);
    info.levels = blurred ? mipmapLevels(info.width, info.height) : 1;
    const TextureInfo& now = copy_.info();
    const bool same = copy_ && now.format == info.format && now.width == info.width && now.height == info.height &&
                      now.layers == info.layers && now.levels == info.levels;
    if (!same) {
        copy_ = GlTexture();  // free the old copy first: there may not be enough memory for both
        copy_ = GlTexture(info);
        copy_.sampling(blurred ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
    }
    colors.copyLayers(copy_, count);
    if (blurred) copy_.generateMipmaps();
}

}  // namespace defocus::engine
