#include "render/layered/depth_layers.h"

namespace defocus::engine {

namespace {

constexpr GLuint frontUnit = 31;  // texture unit of the previous layer in shaders/layered/peel.frag

GlTexture layersOf(const DepthLayersInfo& info, TextureFormat format, std::uint32_t count) {
    return GlTexture({.format = format, .width = info.width, .height = info.height, .layers = static_cast<int>(count)});
}

ShaderDefines definesOf(const DepthLayersInfo& info) {
    ShaderDefines defines = layerFormatDefines(info.format);
    if (info.blended) defines.emplace_back("blendedLayers", "true");
    return defines;
}

GlHandle<destroyQuery> newQuery() {
    GLuint name = 0;
    glCreateQueries(GL_ANY_SAMPLES_PASSED, 1, &name);
    return GlHandle<destroyQuery>(name);
}

}  // namespace

// A position n in normalised device coordinates becomes n·(W, H)/(W', H') when the image size changes from W x H to W'
// x H'. The coefficients of the circle of confusion (lens/circle_of_confusion.h) are scaled so that the circle does not
// change in px.
FramePlan widened(const FramePlan& plan, int border) {
    FramePlan wide = plan;
    wide.tile.reset();
    wide.view.width = plan.view.width + 2 * border;
    wide.view.height = plan.view.height + 2 * border;
    const double wider = static_cast<double>(wide.view.width) / plan.view.width;
    const double higher = static_cast<double>(wide.view.height) / plan.view.height;
    wide.tanHalfHorizontal *= wider;
    ClipCircleOfConfusion& coc = wide.coc;
    for (double* share : {&coc.a, &coc.aBehind, &coc.front, &coc.behind, &coc.foregroundLimit, &coc.backgroundLimit,
                          &coc.chromatic, &coc.shareOfMillimetre})
        *share /= wider;
    coc.tilt *= glm::dvec2(wider, higher);
    coc.curvature *= wider * wider;
    coc.gain *= wider * wider;
    coc.aspect = static_cast<double>(wide.view.width) / wide.view.height;
    for (LensSample& sample : wide.samples) sample.lens = glm::vec2(0);
    for (ObjectPlan& object : wide.objects) object.refinement = Refinement::none;  // a pinhole view needs no refinement
    return wide;
}

DepthLayers::DepthLayers(GpuScene& scene, const DepthLayersInfo& info)
    : info_(info),
      colors_(layersOf(info, layerTextureFormat(info.format), info.layers)),
      surfaces_(layersOf(info, TextureFormat::rgba32f, info.layers)),
      front_(layersOf(info, TextureFormat::rgba32f, 1)),
      depth_(layersOf(info, TextureFormat::depth32f, 0)),
      shadows_(scene, scene.pacer(), vertexShaderMayPickLayer(), info.shaderFolder),
      pass_(scene, scene.pacer(),
            {.fragmentShader = "layered/peel.frag",
             .defines = definesOf(info),
             .look = SurfaceLook::lit,
             .readsOwnBlur = true,
             .vertexShaderLayers = vertexShaderMayPickLayer(),
             .shaderFolder = info.shaderFolder}),
      anyDrawn_(newQuery()) {
    for (std::uint32_t layer = 0; layer < info.layers; ++layer)
        targets_.push_back(Target::ofLayer({&colors_, &surfaces_}, layer, 0, &depth_));
}

void DepthLayers::prepare(const FramePlan& pinholes, const FrameUniforms& frame) {
    shadows_.prepare(pinholes, frame);
    pass_.prepare(pinholes, frame, &shadows_);
}

void DepthLayers::peel(std::uint32_t index) {
    shadows_.draw(index, 1);
    front_.clearLayer(0);
    for (count_ = 0; count_ < info_.layers; ++count_) {
        if (!peelLayer(index, count_)) break;
        surfaces_.copyLayer(count_, {0, 0, info_.width, info_.height}, front_, 0);
    }
}

bool DepthLayers::peelLayer(std::uint32_t index, std::uint32_t layer) {
    const Target& target = targets_[layer];
    target.bind();
    glDepthMask(GL_TRUE);
    constexpr float farthest = 0;  // depth is reversed
    constexpr float transparent[4] = {};
    constexpr float noSurface[4] = {0, 0, 0, -1};
    glClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &farthest);
    glClearNamedFramebufferfv(target.name(), GL_COLOR, 0, transparent);
    glClearNamedFramebufferfv(target.name(), GL_COLOR, 1, noSurface);
    front_.attach(frontUnit);
    glBeginQuery(GL_ANY_SAMPLES_PASSED, anyDrawn_.name());
    pass_.drawSurfaces(index, 1);
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    GLuint any = 0;
    glGetQueryObjectuiv(anyDrawn_.name(), GL_QUERY_RESULT, &any);
    return any != 0;
}

std::size_t DepthLayers::bytes() const {
    return colors_.bytes() + surfaces_.bytes() + front_.bytes() + depth_.bytes() + shadows_.bytes() + pass_.bytes();
}

}  // namespace defocus::engine
