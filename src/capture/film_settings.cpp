#include "capture/film_settings.h"

#include "frame/program_facts.h"
#include "frame/world_hash.h"
#include "render/layer_format.h"

namespace defocus {

FilmSettings filmSettings(const PreparedFrame& frame, const Request& options, const MethodUse& use,
                          const std::filesystem::path& shaderFolder) {
    return {.world = worldHash(frame.world, frame.view, shaderFolder),
            .program = programVersion(),
            .method = use.text(),
            .layerFormat = layerFormatName(options.layerFormat),
            .encoding = ""};
}

}  // namespace defocus
