#include "render/gpu_scene/surface_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "render/gpu_scene/shadow_maps.h"

namespace defocus::engine {

namespace {

constexpr std::size_t maxBackdrops = 8;      // max backdrops per frame, each a copy of all layers
constexpr GLuint backdropUnit = 28;          // texture unit in shaders/include/transmission.glsl
constexpr GLint materialNumberLocation = 4;  // uniform in shaders/accumulation/layers.frag
constexpr GLint shadowSlotLocation = 3;      // attribute location in shaders/shadows/caster.vert

struct SampleSpan {
    std::uint32_t begin = 0, end = 0;
    [[nodiscard]] bool empty() const { return begin >= end; }
    [[nodiscard]] std::uint32_t size() const { return empty() ? 0 : end - begin; }
};

// Returns the intersection of samples [first, first + count) with the sample range of `drawn`.
SampleSpan samplesOf(const auto& drawn, std::uint32_t first, std::uint32_t count) {
    return {std::max(first, drawn.firstSample), std::min(first + count, drawn.firstSample + drawn.sampleCount)};
}

bool isTranslucent(const Material& material) {
    return material.alphaMode == AlphaMode::blend || material.transmits();
}

GLenum modeOf(Refinement refinement) {
    return refinement == Refinement::subdivide ? GL_PATCHES : GL_TRIANGLES;
}

// Draws the index range `run` of the bound vertex array, with one instance per sample in `samples`.
void drawIndices(GLenum mode, const IndexRun& run, const SampleSpan& samples) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL expects the offset as a pointer
    const auto* const offset = reinterpret_cast<const void*>(std::size_t{run.first} * sizeof(std::uint32_t));
    glDrawElementsInstancedBaseInstance(mode, static_cast<GLsizei>(run.count), GL_UNSIGNED_INT, offset,
                                        static_cast<GLsizei>(samples.size()), samples.begin);
}

// Same as drawIndices(), but divided into calls with at most as many triangles as the pacer allows.
void submit(SubmissionPacer& pacer, GLenum mode, const IndexRun& run, const SampleSpan& samples) {
    const std::uint64_t max = pacer.maxTriangles();
    if (max == 0) return drawIndices(mode, run, samples);
    const auto step = static_cast<std::uint32_t>(std::min<std::uint64_t>(run.count, max * 3));
    for (std::uint32_t index = 0; index < run.count; index += step) {
        const std::uint32_t count = std::min(step, run.count - index);
        const auto sampleStep =
            static_cast<std::uint32_t>(std::clamp<std::uint64_t>(max * 3 / count, 1, samples.size()));
        for (std::uint32_t sample = samples.begin; sample < samples.end; sample += sampleStep) {
            const SampleSpan part{sample, std::min(sample + sampleStep, samples.end)};
            drawIndices(mode, {run.first + index, count}, part);
            pacer.submitted(std::uint64_t{count / 3} * part.size());
        }
    }
}

}  // namespace

void SurfacePass::prepare(const FramePlan& plan, const FrameUniforms& frame, const ShadowMaps* shadows) {
    frame_ = &frame;
    shadows_ = shadows != nullptr && !shadows->defines().empty() ? shadows : nullptr;
    objects_ = objectUniforms(plan, *scene_, poses_);
    for (const bool vertexShaderLayers : {false, true}) {
        passDefines_[vertexShaderLayers] = passDefines(vertexShaderLayers);
        passPrograms_[vertexShaderLayers] = &programs_[keyOf(passDefines_[vertexShaderLayers])];
    }
    addDraws(plan);
    uploadMaterials();
    arrays_ = VertexArrays([this](VertexArray& array) { addSamples(array); });
    skyArray_ = VertexArray();
    addSamples(skyArray_);
}

void SurfacePass::uploadMaterials() {
    std::vector<int> materials(materialSlots_.size());
    for (const auto& [material, slot] : materialSlots_) materials[slot] = material;
    materialBlocks_ = MaterialBlocks(*scene_, std::move(materials));
}

void SurfacePass::addDraws(const FramePlan& plan) {
    opaque_.clear();
    dissolved_.clear();
    translucent_.clear();
    transmittingObjects_ = 0;
    blursBackdrop_ = false;
    materialSlots_.clear();
    std::vector<std::uint32_t> partIndices;
    const auto ordered = [&](int material) {
        return info_.look != SurfaceLook::caster && isTranslucent(scene_->material(material));
    };
    for (std::size_t index = 0; index < plan.objects.size(); ++index) {
        const ObjectPlan& object = plan.objects[index];
        const Mesh& mesh = scene_->world().scene->meshes[static_cast<std::size_t>(object.mesh)];
        for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p)
            if (!ordered(mesh.primitives[p].material))
                addPrimitive(plan, {static_cast<std::uint32_t>(index), p, 0, {}, false}, partIndices);
    }
    if (info_.look != SurfaceLook::caster)
        for (const BlendRun& run : plan.blendOrder) addPrimitive(plan, run, partIndices);
    partIndices_ = Buffer::of(std::span<const std::uint32_t>(partIndices));
    for (const ObjectPlan& object : plan.objects) transmittingObjects_ += object.transmits ? 1 : 0;
    for (const Draw& item : translucent_) {
        const Material& material = scene_->material(item.material);
        blursBackdrop_ |= material.transmits() && material.roughnessFactor > 0;
    }
}

// Adds the draw calls of a primitive. If `run` lists triangles of one level, draws only these triangles, and appends
// their indices to `partIndices`.
void SurfacePass::addPrimitive(const FramePlan& plan, const BlendRun& run, std::vector<std::uint32_t>& partIndices) {
    const ObjectPlan& object = plan.objects.at(run.object);
    const Mesh& mesh = scene_->world().scene->meshes[static_cast<std::size_t>(object.mesh)];
    Draw draw;
    draw.mesh = object.mesh;
    draw.primitive = run.primitive;
    draw.object = run.object;
    draw.material = mesh.primitives[run.primitive].material;
    draw.mirrored = object.mirrored;
    draw.refinement = object.refinement;
    draw.cuts = object.cuts;
    draw.blurMoves = object.blurMoves;
    draw.stochasticAlpha = info_.stochasticAlpha && run.stochastic;
    draw.partial = !run.triangles.empty();
    draw.materialSlot = materialSlots_.try_emplace(draw.material, materialSlots_.size()).first->second;
    const Pyramid& pyramid = scene_->world().pyramids[static_cast<std::size_t>(object.mesh)];
    const std::size_t first = partIndices.size();
    for (const IndexRange& range : run.triangles) {
        const auto begin = pyramid.indices.begin() + range.first;
        partIndices.insert(partIndices.end(), begin, begin + range.count);
    }
    draw.runs = {{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(partIndices.size() - first)}};
    const auto add = [&](const LevelDraw& level, ScreenDoor boundary) {
        if (level.sampleCount == 0 || (draw.partial && level.level != run.level)) return;
        if (!draw.partial)
            draw.runs = indexRuns(scene_->world(), object, scene_->mesh(object.mesh), level.level, run.primitive);
        addLevel(draw, object, level, boundary);
    };
    add(object.coarse, ScreenDoor::coarseShare);
    add(object.fine, ScreenDoor::fineShare);
}

// Adds the draws of a level of detail: one for the samples that draw only this level, one for the boundary sample,
// which draws two levels in different pixels.
void SurfacePass::addLevel(const Draw& draw, const ObjectPlan& object, const LevelDraw& level, ScreenDoor boundary) {
    std::uint32_t indexCount = 0;
    for (const IndexRun& run : draw.runs) indexCount += run.count;
    if (indexCount == 0) return;
    const bool translucent = isTranslucent(scene_->material(draw.material)) && !draw.stochasticAlpha;
    auto& list = translucent ? translucent_ : draw.partial ? dissolved_ : opaque_;
    const auto add = [&](std::uint32_t first, std::uint32_t end, ScreenDoor screenDoor) {
        if (first >= end) return;
        Draw& added = list.emplace_back(draw);
        added.level = level.level;
        added.firstSample = first;
        added.sampleCount = end - first;
        added.triangleCount = indexCount / 3;
        added.screenDoor = screenDoor;
        added.program = &program(added);
    };
    const std::uint32_t first = level.firstSample;
    const std::uint32_t end = first + level.sampleCount;
    const std::uint32_t shared = boundarySample(object).value_or(end);
    add(first, std::min(shared, end), ScreenDoor::open);
    if (shared < end) add(shared, shared + 1, boundary);
    add(shared + 1, end, ScreenDoor::open);
}

ShaderDefines SurfacePass::passDefines(bool vertexShaderLayers) const {
    ShaderDefines defines = frame_->defines();
    defines.insert(defines.end(), info_.defines.begin(), info_.defines.end());
    if (shadows_ != nullptr) defines.insert(defines.end(), shadows_->defines().begin(), shadows_->defines().end());
    if (info_.readsOwnBlur && frame_->usesOwnBlur()) defines.emplace_back("passesOwnBlur", "true");
    if (vertexShaderLayers) defines.emplace_back("VERTEX_LAYER", "");
    return defines;
}

// Returns whether the draw needs a geometry shader, to split triangles or to select their layer.
bool SurfacePass::needsGeometryShader(const Draw& draw) const {
    if (draw.refinement == Refinement::none) return !info_.vertexShaderLayers;
    return draw.refinement == Refinement::split || draw.cuts || !info_.vertexShaderLayers ||
           !tessellationMayPickLayer();
}

const Program& SurfacePass::program(const Draw& draw) {
    const Material& material = scene_->material(draw.material);
    const GpuMesh& mesh = scene_->mesh(draw.mesh);
    ShaderDefines defines = surfaceDefines(*scene_, mesh, draw.material, draw.level, info_.look);
    const auto set = [&](bool condition, const char* name) {
        if (condition) defines.emplace_back(name, "true");
    };
    const bool receivesShadows = shadows_ != nullptr && shaded() && !material.unlit;
    if (receivesShadows || info_.readsPosition) defines.emplace_back("PLACED", "");
    const bool colored = mesh.has(colorLocation);
    set(colored && shaded() && draw.level == 0, "colorRanges");
    set(colored && shaded() && draw.level > 0, "levelColorRange");
    set(mesh.has(blurLocation), "vertexBlurs");
    set(draw.blurMoves && frame_->moments(), "blurMoves");
    set(material.alphaMode == AlphaMode::mask, "alphaTested");
    const bool blended = material.alphaMode == AlphaMode::blend;
    set(blended && !draw.stochasticAlpha, "alphaBlended");
    set(material.alphaMode == AlphaMode::mask || draw.stochasticAlpha || (info_.writesNumbers && blended) ||
            (info_.look == SurfaceLook::caster && (blended || material.transmits())),
        "choosesByAlpha");
    set(draw.screenDoor == ScreenDoor::coarseShare, "coarseShare");
    set(draw.screenDoor == ScreenDoor::fineShare, "fineShare");
    poseDefines(defines, poses_[draw.object], mesh);
    if (info_.writesLayers && poses_[draw.object].moving)
        defines.emplace_back("lastPose", std::to_string(poses_[draw.object].count - 1));
    const std::size_t pass = needsGeometryShader(draw) ? 0 : 1;
    const std::string key = fmt::format("{}{}", keyOf(defines), static_cast<int>(draw.refinement));
    const auto [entry, isNew] = passPrograms_[pass]->try_emplace(key);
    if (isNew) {
        defines.insert(defines.begin(), passDefines_[pass].begin(), passDefines_[pass].end());
        entry->second = Program({shadersOf(draw), std::move(defines), info_.shaderFolder});
    }
    return entry->second;
}

std::vector<std::string> SurfacePass::shadersOf(const Draw& draw) const {
    const bool geometry = needsGeometryShader(draw);
    if (draw.refinement == Refinement::none) {
        const bool casts = info_.look == SurfaceLook::caster;
        std::vector<std::string> shaders = {casts ? "shadows/caster.vert" : "accumulation/object.vert",
                                            info_.fragmentShader};
        if (geometry) shaders.emplace_back("accumulation/object.geom");
        return shaders;
    }
    std::vector<std::string> shaders = {"accumulation/refined.vert", info_.fragmentShader};
    if (geometry) shaders.emplace_back("accumulation/refined.geom");
    if (draw.refinement == Refinement::subdivide)
        shaders.insert(shaders.end(), {"accumulation/refined.tesc",
                                       geometry ? "accumulation/refined.tese" : "accumulation/divided.tese"});
    return shaders;
}

void SurfacePass::bindFrame() {
    bound_ = {};
    frame_->bind(0);
    glEnable(GL_DEPTH_TEST);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

// Adds the per-instance attributes of the lens samples to a vertex array.
void SurfacePass::addSamples(VertexArray& array) const {
    const auto add = [&](GLuint location, GLint components, const Buffer& buffer, std::size_t offset,
                         std::size_t stride) {
        if (!buffer) return;
        array.attribute(location, components, GL_FLOAT, false, true);
        array.bind(location, buffer, offset, stride);
    };
    add(lensLocation, 4, frame_->samples(), 0, sizeof(GpuSample));
    add(eyeLocation, 4, frame_->samples(), sizeof(glm::vec4), sizeof(GpuSample));
    add(momentLocation, 3, frame_->moments(), 0, sizeof(glm::vec3));
    add(bandShiftLocation, 1, frame_->bandShifts(), 0, sizeof(float));
}

// Binds all inputs of draw `item`, whose first sample is `sample`.
void SurfacePass::bindDraw(const Draw& item, std::uint32_t sample, const Buffer& indices) {
    const bool otherProgram = bound_.program != item.program;
    if (otherProgram || bound_.mesh != item.mesh || bound_.level != item.level || bound_.indices != indices.name())
        bindVertices(item, indices);
    if (otherProgram || bound_.sample != sample) {
        frame_->bindWave(sample);
        if (shadows_ != nullptr) shadows_->bind(sample);  // also for a new program: bind() sets one of its uniforms
        bound_.sample = sample;
    }
    if (otherProgram || bound_.object != item.object) {
        setObject(objects_[item.object]);
        bound_.object = item.object;
    }
    if (info_.writesNumbers) {  // the default material, −1, gets the last index
        const auto last = static_cast<int>(scene_->world().scene->materials.size());
        glUniform1f(materialNumberLocation, static_cast<float>((item.material >= 0 ? item.material : last) + 1));
    }
    if (poses_[item.object].texels) poses_[item.object].texels.attach(6);
    if (bound_.materialSlot != item.materialSlot) {
        materialBlocks_.bind(item.materialSlot);
        bound_.materialSlot = item.materialSlot;
    }
    glFrontFace(item.mirrored ? GL_CW : GL_CCW);
    if (modeOf(item.refinement) == GL_PATCHES) glPatchParameteri(GL_PATCH_VERTICES, 3);
}

// Binds the program and the vertices of draw `item`.
void SurfacePass::bindVertices(const Draw& item, const Buffer& indices) {
    const GpuMesh& mesh = scene_->mesh(item.mesh);
    VertexArray& array = arrays_.attach(mesh, item.level);
    array.indices(indices);
    array.use();
    item.program->use();
    if (mesh.morphs) mesh.morphs.texels.attach(7);
    if (info_.look == SurfaceLook::caster) glUniform1i(shadowSlotLocation, shadowSlot_);
    if (const GpuLevel& level = mesh.levels[item.level]; mesh.has(colorLocation) && shaded() && item.level > 0) {
        glUniform4fv(0, 1, &level.minColor.x);
        glUniform4fv(1, 1, &level.maxColor.x);
    }
    bound_.program = item.program;
    bound_.mesh = item.mesh;
    bound_.level = item.level;
    bound_.indices = indices.name();
}

void SurfacePass::draw(const Draw& item, std::uint32_t first, std::uint32_t count) {
    const SampleSpan samples = samplesOf(item, first, count);
    if (samples.empty()) return;
    bindDraw(item, samples.begin, item.partial ? partIndices_ : scene_->mesh(item.mesh).buffers->indices);
    for (const IndexRun& run : item.runs) submit(*pacer_, modeOf(item.refinement), run, samples);
}

void SurfacePass::bindSolid(GLenum depthTest) {
    bindFrame();
    glDisable(GL_BLEND);
    glDepthFunc(depthTest);
    glDepthMask(GL_TRUE);
}

void SurfacePass::drawSolid(const std::vector<Draw>& items, std::uint32_t first, std::uint32_t count, GLenum depthTest,
                            const ObjectSet& objects) {
    bindSolid(depthTest);
    drawFronts(items, first, count, objects);
}

void SurfacePass::drawFronts(const std::vector<Draw>& items, std::uint32_t first, std::uint32_t count,
                             const ObjectSet& objects) {
    for (const Draw& item : items)
        if (contains(objects, item.object)) drawFront(item, first, count);
}

void SurfacePass::drawFront(const Draw& item, std::uint32_t first, std::uint32_t count) {
    setFaces(item);
    draw(item, first, count);
}

// Enables culling of back faces except for double-sided materials and shadow casters.
void SurfacePass::setFaces(const Draw& item) const {
    if (scene_->material(item.material).doubleSided || info_.look == SurfaceLook::caster)
        glDisable(GL_CULL_FACE);
    else
        glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
}

void SurfacePass::drawOpaque(std::uint32_t first, std::uint32_t count) {
    drawSolid(opaque_, first, count);
    drawSolid(dissolved_, first, count);
}

std::vector<OccludableDraw> SurfacePass::opaqueDraws() const {
    std::vector<OccludableDraw> draws;
    for (const Draw& draw : opaque_)
        draws.push_back({draw.object, draw.level, draw.primitive, draw.firstSample, draw.sampleCount});
    return draws;
}

std::uint64_t SurfacePass::drawOpaqueVisible(std::uint32_t first, std::uint32_t count, const GlTexture& depths,
                                             std::uint32_t layer, const Occlusion& occlusion, WaveVisibility& block) {
    if (!occlusion.culls()) {
        drawOpaque(first, count);
        return 0;
    }
    if (block.made) {
        drawOpaque(first, 1);
        block.make(occlusion.visibilityIn(first, depths, layer));
        return count == 1 ? 0 : drawOpaqueVisible(first + 1, count - 1, depths, layer + 1, occlusion, block);
    }
    const std::shared_ptr<const PieceVisibility> visibility = block.shared.get();
    if (!visibility->hidesMuch) {
        drawOpaque(first, count);
        return 0;
    }
    std::uint64_t all = 0;
    for (const Draw& item : opaque_) all += std::uint64_t{item.triangleCount} * samplesOf(item, first, count).size();
    bindSolid(GL_GREATER);
    const std::uint64_t shown = drawRemaining(visibility->draws, first, count);
    const std::uint64_t uncovered =
        drawRemaining(occlusion.uncovered(*visibility, first, count, depths, layer), first, count);
    drawFronts(dissolved_, first, count);
    return all - shown - uncovered;
}

// Draws the triangles that remain after the occlusion test. Returns the number of drawn triangles, summed over samples.
std::uint64_t SurfacePass::drawRemaining(const RemainingDraws& remaining, std::uint32_t first, std::uint32_t count) {
    const Buffer indices = Buffer::of(std::span<const std::uint32_t>(remaining.indices));
    // Forget the bound buffers. `indices` may have the OpenGL name of a deleted buffer, so a comparison of names would
    // wrongly skip a bind.
    bound_ = {};
    std::uint64_t triangles = 0;
    for (const RemainingDraw& part : remaining.draws) {
        const SampleSpan samples = samplesOf(part, first, count);
        if (samples.empty()) continue;
        const Draw& item = opaque_[part.draw];
        setFaces(item);
        bindDraw(item, samples.begin, indices);
        submit(*pacer_, modeOf(item.refinement), {part.firstIndex, part.indexCount}, samples);
        triangles += std::uint64_t{part.indexCount / 3} * samples.size();
    }
    return triangles;
}

void SurfacePass::drawSurfaces(std::uint32_t first, std::uint32_t count) {
    drawOpaque(first, count);
    drawSolid(translucent_, first, count);
}

void SurfacePass::drawCasters(std::uint32_t first, std::uint32_t count, int slot, bool tinted) {
    shadowSlot_ = slot;
    if (!tinted) return drawSurfaces(first, count);
    // Keep the max depth per colour channel: depth is reversed, so this is the nearest surface that blocks the
    // channel's light.
    bindSolid(GL_GREATER);
    glEnable(GL_BLEND);
    glBlendEquation(GL_MAX);
    drawFronts(opaque_, first, count);
    glDepthMask(GL_FALSE);
    drawFronts(translucent_, first, count);
    glDepthMask(GL_TRUE);
    glBlendEquation(GL_FUNC_ADD);
    glDisable(GL_BLEND);
}

void SurfacePass::drawTouched(std::uint32_t first, std::uint32_t count) {
    bindFrame();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    for (const auto* list : {&opaque_, &dissolved_, &translucent_}) drawFronts(*list, first, count);
    glDisable(GL_BLEND);
}

void SurfacePass::drawTranslucent(std::uint32_t first, std::uint32_t count, const GlTexture& colors,
                                  const ObjectSet& objects) {
    if (translucent_.empty()) return;
    bindFrame();
    glDepthFunc(GL_GREATER);
    std::size_t left = transmittingObjects_;
    std::optional<std::uint32_t> shown;  // transmitting object for which the latest backdrop was copied
    for (const Draw& item : translucent_) {
        if (!contains(objects, item.object)) continue;
        if (!scene_->material(item.material).transmits()) {
            drawBlended(item, first, count);
            continue;
        }
        if (shown != item.object) {
            if (!shown || left <= maxBackdrops) backdrop_.take(colors, count, blursBackdrop_);
            shown = item.object;
            --left;
        }
        glDisable(GL_BLEND);
        glDepthMask(GL_TRUE);
        backdrop_.attach(backdropUnit);
        drawFront(item, first, count);
    }
    glDisable(GL_BLEND);
}

void SurfacePass::drawBlended(const Draw& item, std::uint32_t first, std::uint32_t count) {
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, marksBlended_ ? GL_ONE : GL_ONE_MINUS_SRC_ALPHA);
    if (scene_->material(item.material).doubleSided && !item.partial) {
        glEnable(GL_CULL_FACE);
        glCullFace(GL_FRONT);  // draw back faces before front faces
        draw(item, first, count);
        glCullFace(GL_BACK);
        draw(item, first, count);
    } else {
        drawFront(item, first, count);
    }
}

void SurfacePass::drawTranslucentDepth(std::uint32_t first, std::uint32_t count, const ObjectSet& objects) {
    if (translucent_.empty()) return;
    glColorMaski(0, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    // Use GL_GEQUAL, because transmitting surfaces have already written their depth.
    drawSolid(translucent_, first, count, GL_GEQUAL, objects);
    glColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void SurfacePass::drawSky(std::uint32_t first, std::uint32_t count) {
    if (!sky_ || skyDefines_ != passDefines(info_.vertexShaderLayers)) {
        skyDefines_ = passDefines(info_.vertexShaderLayers);
        std::vector<std::string> shaders = {"accumulation/sky.vert", "accumulation/sky.frag"};
        if (!info_.vertexShaderLayers) shaders.emplace_back("accumulation/sky.geom");
        sky_ = Program({std::move(shaders), skyDefines_, info_.shaderFolder});
    }
    bindFrame();
    skyArray_.use();
    sky_.use();
    glDisable(GL_CULL_FACE);
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_GEQUAL);  // depth is reversed: the sky, at depth 0, passes only where nothing was drawn
    glDrawArraysInstancedBaseInstance(GL_TRIANGLES, 0, 3, static_cast<GLsizei>(count), first);
}

std::size_t SurfacePass::bytes() const {
    std::size_t total = materialBlocks_.bytes() + backdrop_.bytes();
    for (const GpuPoses& poses : poses_) total += poses.texels.bytes();
    return total;
}

}  // namespace defocus::engine
