#include "gl/shader_constants.h"

#include <algorithm>
#include <string_view>

#include "core/error.h"

namespace defocus::engine {

namespace {

struct ShaderConstant {
    std::string_view type;  // GLSL type
    std::string_view name;
    std::string_view defaultValue;
    // Macro that is defined if the constant differs from its default; empty: no macro. Shaders use it to declare inputs
    // and outputs that depend on the constant, because `if` cannot remove declarations.
    std::string_view macro = {};
};

// Shaders branch on these constants with `if`, and compilers drop the branches that are never taken.
constexpr ShaderConstant constants[] = {
    // Constants of a frame: lens, environment, lights and accumulation
    {"int", "blockSamples", "64"},     // number of lens samples that are summed as one block
    {"int", "positionsPerAxis", "1"},  // width of an image pixel, in pixels of a lens sample's layer
    {"int", "environmentType", "0"},
    {"int", "backgroundType", "0"},
    {"float", "environmentLevels", "0.0"},    // coarsest mip level of the environment map
    {"float", "environmentLighting", "1.0"},  // factor on the light that surfaces receive from the environment
    {"bool", "multipleScattering", "false"},
    {"int", "lightCount", "0"},
    {"int", "maxLights", "1"},         // length of the lights' uniform arrays
    {"bool", "usesOwnBlur", "false"},  // true if surfaces scale their blur or add to it
    {"bool", "chromatic", "false"},
    {"bool", "cocControls", "false"},
    {"bool", "aberrations", "false"},
    {"float", "catEye", "0.0"},
    {"float", "layerLargest", "0.0"},  // colours in a layer are clamped to this value; 0: no clamping
    {"bool", "startsBlock", "false"},
    {"bool", "keepsNearest", "false"},  // true for the depth layer, which also stores the nearest depth
    {"bool", "sumsAlpha", "false"},     // true for a data layer that sums alpha, which usually the depth layer does
    {"int", "waveSamples", "1"},        // number of samples that a pass adds up; constant, so drivers unroll the loop
    {"int", "tableEntries", "1"},       // max number of objects or materials counted separately in a pixel

    // Constants of a surface's material and mesh
    {"bool", "lit", "false", "LIT"},
    {"bool", "coarseLevel", "false", "COARSE_LEVEL"},
    {"bool", "transmissive", "false", "TRANSMISSIVE"},
    {"bool", "ownReflectance", "false"},
    {"bool", "clearcoat", "false"},
    {"bool", "sheen", "false"},
    {"bool", "anisotropic", "false"},
    {"bool", "iridescent", "false"},
    {"bool", "dispersive", "false"},
    {"bool", "diffusesThrough", "false"},  // KHR_materials_diffuse_transmission
    {"bool", "emissive", "false"},
    {"bool", "localLights", "false"},
    {"bool", "doubleSided", "false"},
    {"bool", "alphaTested", "false"},
    {"bool", "alphaBlended", "false"},
    {"bool", "choosesByAlpha", "false",
     "CHOOSES_BY_ALPHA"},                // alpha decides in which lens samples a fragment is visible
    {"bool", "letsLightPass", "false"},  // true if a shadow caster transmits light
    {"bool", "vertexColors", "false"},
    {"bool", "colorRanges", "false", "COLOR_RANGES"},
    {"bool", "levelColorRange", "false"},
    {"bool", "uvTransforms", "false", "UV_TRANSFORMS"},
    {"int", "textureCount", "1"},
    {"int[19]", "textureUnits", "int[](-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1)"},
    {"bool", "passesOwnBlur", "false", "PASSES_OWN_BLUR"},  // the fragment stage reads the blur modifiers
    {"bool", "coarseShare", "false"},  // draws only the coarser level's pixels in samples that mix two levels of detail
    {"bool", "fineShare", "false"},    // draws only the finer level's pixels in samples that mix two levels of detail

    // Constants for the poses that vertex shaders apply to moving, skinned and morphed objects
    {"bool", "moving", "false", "MOVING"},
    {"int", "lastPose", "0"},  // index of the pose at the end of the exposure
    {"bool", "cameraMoves", "false"},
    {"int", "skinInfluences", "0"},
    {"bool", "morphed", "false"},
    {"int", "morphAttributes", "1"},
    {"bool", "morphNormals", "false"},
    {"bool", "morphTangents", "false"},
    {"bool", "vertexBlurs", "false"},
    {"bool", "blurMoves", "false"},

    // Constants of shadow maps
    {"bool", "shadowed", "false", "SHADOWED"},
    {"bool", "tintedShadows", "false", "TINTED_SHADOWS"},  // shadow maps have one depth per colour channel
    {"int", "shadowMapCount", "0"},
    {"int", "shadowPoints", "0"},
    {"int", "shadowSize", "0"},
    {"float", "shadowError", "0.0"},
    {"int[]", "shadowFirst", "int[](-1)"},
    {"int[]", "shadowFaces", "int[](0)"},

    // Constants for blurring each sample's image by its lens cell, the part of the lens that the sample stands for
    {"int", "cellsInFront", "0"},
    {"int", "cellsBehind", "0"},
    {"float", "minCellVariance", "0.0"},
    {"bool", "nearestClass", "false"},

    // Constants of the layered method
    {"bool", "blendedLayers", "false"},
    {"bool", "finestExtents", "false"},
    {"int", "extentLevels", "1"},

    // Constants of the lens-space methods
    {"int", "tileSize", "1"},  // tile side in px; the circular method has tiles, too
    {"int", "maxRays", "1"},   // max number of lens samples drawn in one pass
    {"uint", "rayVariants", "1u"},
    {"bool", "countsOnly", "false", "COUNTS_ONLY"},
    {"bool", "lineSamples", "false"},
    {"int", "segmentCapacity", "1"},
    {"bool", "shortIntervals", "false"},  // true: the interval of a line segment is stored in 16 bits
    {"bool", "areaWeights", "true"},      // true: a part of a line sample is weighted by its light; false: by length
    {"bool", "lightsVertices", "false", "LIGHTS_VERTICES"},
    {"int", "maxShadingPoints", "1"},

    // Constants of the circular method
    {"int", "kernelSize", "1"},
    {"int", "components", "1"},  // number of kernel components that a pass filters
    {"vec2", "kernelAxes", "vec2(1.0)"},
    {"bool", "bracketed", "false"},
    {"float", "largestSum", "0.0"},
    {"bool", "exactTaps", "false"},
    {"bool", "ofChannels", "false"},
    {"int", "reduction", "1"},  // downsampling factor per axis; also used by the Scheuermann method
    {"bool", "nearPremultiplied", "false"},
    {"bool", "biasByLuminance", "false"},

    // Constants of the Scheuermann method
    {"int", "pinholeSamples", "1", "MULTISAMPLED"},  // samples per pixel of the pinhole image
    {"bool", "thinLens", "false"},
    {"bool", "encodedColor", "false"},
    {"int", "diskTaps", "1"},
    {"int", "maxDiskTaps", "1"},
    {"float", "smallPixel", "1.0"},
    {"float", "smallRadiusScale", "1.0"},

    // Constants of the display pass
    {"bool", "compares", "false"},
    {"bool", "overlays", "false"},
    {"bool", "marks", "false"},
};

bool isMacro(const std::string& name) {
    return std::ranges::none_of(name, [](char c) { return c >= 'a' && c <= 'z'; });
}

}  // namespace

std::string shaderPreamble(const ShaderDefines& defines, const std::string& source) {
    std::string macros;
    for (const auto& [name, value] : defines) {
        if (isMacro(name))
            macros += fmt::format("#define {} {}\n", name, value);
        else if (std::ranges::find(constants, name, &ShaderConstant::name) == std::end(constants))
            fail("shaders: unknown constant '{}'", name);
    }
    std::string declarations;
    for (const ShaderConstant& constant : constants) {
        const auto set = std::ranges::find(defines, constant.name, &ShaderDefines::value_type::first);
        const std::string_view value = set != defines.end() ? std::string_view(set->second) : constant.defaultValue;
        if (!constant.macro.empty() && value != constant.defaultValue)
            macros += fmt::format("#define {}\n", constant.macro);
        // Declare only the constants that the source mentions: compilers take about 5 µs for each declaration.
        if (source.find(constant.name) == std::string::npos) continue;
        declarations += fmt::format("const {} {} = {};\n", constant.type, constant.name, value);
    }
    return macros + declarations;
}

}  // namespace defocus::engine
