#include "render/lens_space/lens_front.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "render/lens_space/record_buffer.h"

namespace defocus::engine {

namespace {

constexpr std::size_t clipBytes = 4 * sizeof(float);
constexpr std::size_t ownBlurBytes = 2 * sizeof(float);
// Mesa's software driver ends the loops of a thread after a total of 65,535 iterations.
constexpr std::uint32_t maxTilesAtOnce = 50'000;  // max tiles that a thread tests for one triangle
// Max length of a tile's triangle list that one dispatch sorts. The bitonic sort of a list of this length has 136
// steps, in each of which a thread runs 256 iterations.
constexpr std::uint32_t maxSortedAtOnce = 65'536;
constexpr std::size_t vertexLightBytes = 8 * sizeof(float);  // per vertex; see LightBlock of shade_vertices.comp
constexpr std::size_t attributeBytes = 20 * sizeof(float);   // per vertex; output of shaders/lens_space/attributes.vert

// Returns the end of the range of rays for which a level of an object is drawn. Ray i of each pixel sees the level that
// the plan selects for lens sample i. If the plan divides a sample between two levels, each in some of the pixels, ray
// i of all pixels sees the level with more pixels.
std::uint32_t endOf(const ObjectPlan& object, const LevelDraw& level, bool coarse) {
    const std::uint32_t end = level.firstSample + level.sampleCount;
    const bool shared = boundarySample(object).has_value();
    return coarse && shared && object.boundaryShare < 0.5 ? end - 1 : end;
}

std::uint32_t beginOf(const ObjectPlan& object, const LevelDraw& level, bool coarse) {
    const bool shared = boundarySample(object).has_value();
    return !coarse && shared && object.boundaryShare >= 0.5 ? level.firstSample + 1 : level.firstSample;
}

void checkDrawable(const FramePlan& plan, const World& world, const std::string& method) {
    if (plan.coc.chromatic > 0)
        fail("method {}: axial chromatic aberration is not supported; leave it out or choose accumulation", method);
    if (plan.usesLens && plan.view.lens.catEye > 0)
        fail("method {}: cat's-eye bokeh (--cat-eye) is not supported; leave it out or choose accumulation", method);
    if (!plan.moments.empty() && world.shutter.perSample)
        fail("method {}: exact motion is not supported; give a number of motion segments or choose accumulation",
             method);
}

}  // namespace

std::uint64_t BinStatistics::entriesBeyond(std::uint32_t size) const {
    std::uint64_t beyond = 0;
    if (size > 0)
        for (const std::uint32_t count : counts) beyond += std::max(count, size) - size;
    return beyond;
}

void dispatchOver(std::uint64_t count) {
    constexpr std::uint64_t max = 65535;  // min GL_MAX_COMPUTE_WORK_GROUP_COUNT that OpenGL guarantees
    const std::uint64_t needed = (count + 255) / 256;
    if (needed == 0) return;
    glDispatchCompute(static_cast<GLuint>(std::min(needed, max)), static_cast<GLuint>((needed + max - 1) / max), 1);
}

LensFront::LensFront(GpuScene& scene, LensFrontOptions options)
    : scene_(&scene),
      options_(std::move(options)),
      divided_(options_.shaderFolder, options_.lightsVertices),
      unused_({.format = TextureFormat::rgba8}),
      unusedTarget_({&unused_}) {
    sortProgram_ = Program({{"lens_space/sort.comp"}, {}, options_.shaderFolder});
    ShaderDefines defines;
    if (options_.lightsVertices) defines.emplace_back("lightsVertices", "true");
    trianglesProgram_ = Program({{"lens_space/triangles.comp"}, defines, options_.shaderFolder});
}

void LensFront::prepare(const FramePlan& plan, const FrameUniforms& frame, const std::string& method) {
    checkDrawable(plan, scene_->world(), method);
    plan_ = plan;
    frame_ = &frame;
    const bool moving = !plan.moments.empty();
    const std::size_t moments = std::max(scene_->world().shutter.poses.size(), plan.view.shutterCameras.size());
    parts_ = moving ? static_cast<std::uint32_t>(std::clamp<std::size_t>(moments - 1, 1, plan.samples.size())) : 1;
    defines_ = frame.defines();
    if (moving) defines_.emplace_back("moving", "true");
    objects_ = objectUniforms(plan, *scene_, poses_);
    arrays_ = VertexArrays();

    // Collect vertices and triangles of all levels that are drawn for at least one ray.
    vertices_.clear();
    runs_.clear();
    groups_.clear();
    groupNumbers_.clear();
    vertexCount_ = 0;
    triangleCount_ = 0;
    divided_.start(defines_);
    std::vector<GpuDraw> draws;
    const auto bent = std::ranges::count_if(
        plan.objects, [](const ObjectPlan& object) { return object.refinement != Refinement::none; });
    const double maxOfLevel = maxSmallTriangles / (2.0 * static_cast<double>(std::max<std::ptrdiff_t>(bent, 1)));
    for (std::uint32_t i = 0; i < plan.objects.size(); ++i)
        for (const LevelDraw* level : {&plan.objects[i].coarse, &plan.objects[i].fine})
            if (level->sampleCount > 0) addLevel(i, *level, maxOfLevel, draws);
    const std::uint32_t posed = vertexCount_;
    addDivisions();
    ownBlurs_ = divided_.empty() ? Buffer() : Buffer(std::size_t{posed} * ownBlurBytes);
    draws_ = Buffer::of(std::span<const GpuDraw>(draws));
    clips_ = storage(std::uint64_t{vertexCount_} * clipBytes, "the frame's vertices");
    clipsAtEnd_ = moving ? Buffer(clips_.bytes()) : Buffer();
    attributes_ = storage(std::uint64_t{vertexCount_} * attributeBytes, "the attributes of the frame's vertices");
    if (options_.lightsVertices) {
        firstTriangles_ = Buffer(std::size_t{vertexCount_} * sizeof(std::uint32_t));
        vertexLight_ =
            storage(std::uint64_t{vertexCount_} * vertexLightBytes, "the lighting values of the frame's vertices");
    }
    triangles_ = storage(std::uint64_t{triangleCount_} * 4 * sizeof(std::uint32_t), "the frame's triangles");
    depths_ = Buffer(std::size_t{triangleCount_} * sizeof(std::uint32_t));
    makeTriangles();

    ShaderDefines binDefines = defines_;
    binDefines.emplace_back("tileSize", std::to_string(options_.tileSize));
    if (binDefines != binDefines_) {
        binDefines_ = binDefines;
        fillProgram_ = Program({{"lens_space/bin.comp"}, binDefines, options_.shaderFolder});
        binDefines.emplace_back("countsOnly", "true");
        countProgram_ = Program({{"lens_space/bin.comp"}, binDefines, options_.shaderFolder});
        depthsProgram_ = Program({{"lens_space/depths.comp"}, defines_, options_.shaderFolder});
    }
}

void LensFront::addLevel(std::uint32_t objectIndex, const LevelDraw& level, double maxSmall,
                         std::vector<GpuDraw>& draws) {
    const World& world = scene_->world();
    const ObjectPlan& object = plan_.objects[objectIndex];
    const Mesh& mesh = world.scene->meshes[static_cast<std::size_t>(object.mesh)];
    const bool coarse = &level == &object.coarse;
    const Vertices vertices{objectIndex, level.level, vertexCount_,
                            world.pyramids[static_cast<std::size_t>(object.mesh)].levels[level.level].vertexCount};
    const std::uint32_t parts =
        options_.divides ? partsOfEdges(object, level.triangleCount, plan_.settings.cocTolerance, maxSmall) : 1;
    for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p) {
        const int material = mesh.primitives[p].material;
        const auto draw = static_cast<std::uint32_t>(draws.size());
        const std::uint32_t group = groupOf(object.mesh, material, level.level);
        draws.push_back({beginOf(object, level, coarse), endOf(object, level, coarse), group,
                         scene_->material(material).doubleSided ? 1u : 0u, groups_[group - 1].seeThrough() ? 1u : 0u});
        for (const IndexRun& run : indexRuns(world, object, scene_->mesh(object.mesh), level.level, p)) {
            if (run.count < 3) continue;
            runs_.push_back({objectIndex, run.first, run.count / 3, vertices.first, draw, parts});
            triangleCount_ += run.count / 3 * parts * parts;
        }
    }
    vertices_.push_back(vertices);
    vertexCount_ += vertices.count;
}

// Assigns ranges of vertices and triangles to the small triangles that replace divided triangles. The new vertices
// follow the vertices of all levels, and the small triangles follow the triangles that are not divided.
void LensFront::addDivisions() {
    std::uint32_t bases = 0;
    std::uint32_t triangles = 0;
    for (const Run& run : runs_)
        if (run.parts == 1) triangles += run.triangles;
    for (const Run& run : runs_) {
        if (run.parts == 1) continue;
        const DividedRun divided{bases, run.triangles, run.parts, vertexCount_, triangles};
        divided_.add(divided);
        bases += run.triangles;
        triangles += static_cast<std::uint32_t>(divided.triangleCount());
        vertexCount_ += static_cast<std::uint32_t>(divided.vertexCount());
    }
    if (divided_.empty()) return;
    bases_ = storage(std::uint64_t{bases} * 4 * sizeof(std::uint32_t), "the frame's subdivided triangles");
}

std::uint32_t LensFront::groupOf(int mesh, int material, std::uint32_t level) {
    ShaderDefines defines = surfaceDefines(*scene_, scene_->mesh(mesh), material, level, SurfaceLook::lit);
    const std::string key = keyOf(defines) + std::to_string(material);
    const auto [entry, isNew] = groupNumbers_.try_emplace(key, static_cast<std::uint32_t>(groups_.size()) + 1);
    if (isNew) groups_.push_back({std::move(defines), material, scene_->material(material).alphaMode});
    return entry->second;
}

void LensFront::makeTriangles() {
    // First write the triangles that will be divided to bases_, the input of divided_.makeTriangles(). This also fills
    // firstTriangles_, which holds the first triangle of each vertex. Clear firstTriangles_ afterwards, because small
    // triangles replace these triangles in the frame.
    if (options_.lightsVertices) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, firstTriangles_.name());
    convertRuns(bases_, true);
    if (options_.lightsVertices) {
        const GLuint none = ~0u;
        glClearNamedBufferData(firstTriangles_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &none);
    }
    convertRuns(triangles_, false);
    divided_.makeTriangles(bases_);
}

void LensFront::convertRuns(const Buffer& target, bool divided) {
    trianglesProgram_.use();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, target.name());
    std::uint32_t first = 0;
    for (const Run& run : runs_) {
        if ((run.parts > 1) != divided) continue;
        const ObjectPlan& object = plan_.objects[run.object];
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, scene_->mesh(object.mesh).buffers->indices.name());
        glUniform1ui(0, run.first);
        glUniform1ui(1, run.triangles);
        glUniform1ui(2, run.firstVertex);
        glUniform1ui(3, first);
        glUniform1ui(4, run.draw);
        glUniform1i(5, object.mirrored ? 1 : 0);
        dispatchOver(run.triangles);
        first += run.triangles;
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void LensFront::pose(std::uint32_t part) {
    const bool moving = static_cast<bool>(clipsAtEnd_);
    const auto makeClips = [&](const Buffer& clips, std::uint32_t moment) {
        makeVertices(clips, clipBytes, false, moment, 0);
        divided_.makeClips(bases_, clips, ownBlurs_);
    };
    makeClips(clips_, part);
    if (moving) makeClips(clipsAtEnd_, part + 1);
    // Moving surfaces are shaded as they are at the middle of this part of the exposure.
    makeVertices(attributes_, attributeBytes, true, part, moving ? 0.5f : 0.0f);
    divided_.makeAttributes(bases_, attributes_);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    makeDepths();
    countTiles();
}

void LensFront::makeDepths() {
    frame_->bind(0);
    depthsProgram_.use();
    bindTriangles();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, depths_.name());
    glUniform1ui(0, triangleCount_);
    dispatchOver(triangleCount_);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void LensFront::makeVertices(const Buffer& target, std::size_t vertexBytes, bool attributes, std::uint32_t moment,
                             float fraction) {
    frame_->bind(0);
    unusedTarget_.bind();
    glEnable(GL_RASTERIZER_DISCARD);
    for (const Vertices& vertices : vertices_) {
        if (vertices.count == 0) continue;
        const ObjectPlan& object = plan_.objects[vertices.object];
        const GpuMesh& mesh = scene_->mesh(object.mesh);
        const GpuPoses& poses = poses_[vertices.object];
        const Program& program = vertexProgram(vertices, attributes);
        arrays_.attach(mesh, vertices.level).use();
        program.use();
        const float place = static_cast<float>(moment) + fraction;
        if (poses.moving || (changesBlur(vertices) && !attributes))
            glUniform3f(0, static_cast<float>(moment), fraction, place / static_cast<float>(parts_));
        setObject(objects_[vertices.object]);
        if (poses.texels) poses.texels.attach(6);
        if (mesh.morphs) mesh.morphs.texels.attach(7);
        glBindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, target.name(),
                          static_cast<GLintptr>(vertices.first * vertexBytes),
                          static_cast<GLsizeiptr>(vertices.count * vertexBytes));
        if (ownBlurs_ && !attributes)
            glBindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 1, ownBlurs_.name(),
                              static_cast<GLintptr>(vertices.first * ownBlurBytes),
                              static_cast<GLsizeiptr>(vertices.count * ownBlurBytes));
        glBeginTransformFeedback(GL_POINTS);
        glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(vertices.count));
        glEndTransformFeedback();
    }
    for (GLuint point = 0; point < 2; ++point) glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, point, 0);
    glDisable(GL_RASTERIZER_DISCARD);
}

bool LensFront::changesBlur(const Vertices& vertices) const {
    return plan_.objects[vertices.object].blurMoves && !plan_.moments.empty();
}

const Program& LensFront::vertexProgram(const Vertices& vertices, bool attributes) {
    const GpuMesh& mesh = scene_->mesh(plan_.objects[vertices.object].mesh);
    ShaderDefines defines = frame_->defines();
    if (mesh.has(colorLocation)) defines.emplace_back("vertexColors", "true");
    if (mesh.has(blurLocation)) defines.emplace_back("vertexBlurs", "true");
    if (changesBlur(vertices) && !attributes) defines.emplace_back("blurMoves", "true");
    if (ownBlurs_ && !attributes) defines.emplace_back("passesOwnBlur", "true");
    poseDefines(defines, poses_[vertices.object], mesh);
    const char* shader = attributes ? "lens_space/attributes.vert" : "lens_space/clip.vert";
    const auto [entry, isNew] = programs_.try_emplace(shader + keyOf(defines));
    if (isNew) entry->second = Program({{shader}, defines, options_.shaderFolder});
    return entry->second;
}

void LensFront::countTiles() {
    const auto width = static_cast<std::uint32_t>(plan_.view.width);
    const auto height = static_cast<std::uint32_t>(plan_.view.height);
    const std::uint32_t tiles =
        ((width + options_.tileSize - 1) / options_.tileSize) * ((height + options_.tileSize - 1) / options_.tileSize);
    std::vector<std::uint32_t> counts(tiles, 0);
    if (tileCounts_.bytes() != tiles * sizeof(std::uint32_t)) {
        tileCounts_ = Buffer(tiles * sizeof(std::uint32_t));
        tileEnds_ = Buffer(tiles * sizeof(std::uint32_t));
    }
    tileCounts_.update(0, tileCounts_.bytes(), counts.data());
    frame_->bind(0);
    countProgram_.use();
    bindTriangles();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, tileCounts_.name());
    binInto(0, tiles);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
    tileCounts_.read(0, tileCounts_.bytes(), counts.data());

    // Compute the offsets of the tiles' lists. A new band of tiles begins when the next tile's list would exceed the
    // memory limit.
    bands_.clear();
    statistics_ = {};
    statistics_.tiles = tiles;
    tilePlaces_.assign(tiles, 0);
    std::vector<std::uint32_t> ends(tiles, 0);
    const std::uint64_t max = std::min(options_.entryBytes, largestStorage()) / sizeof(std::uint32_t);
    TileBand band;
    for (std::uint32_t tile = 0; tile < tiles; ++tile) {
        if (band.entries > 0 && band.entries + counts[tile] > max) {
            band.end = tile;
            bands_.push_back(band);
            band = {tile, tile, 0};
        }
        tilePlaces_[tile] = static_cast<std::uint32_t>(band.entries);
        band.entries += counts[tile];
        ends[tile] = static_cast<std::uint32_t>(band.entries);
        statistics_.entries += counts[tile];
        statistics_.largestTile = std::max(statistics_.largestTile, counts[tile]);
    }
    band.end = tiles;
    bands_.push_back(band);
    statistics_.counts = std::move(counts);
    tileEnds_.update(0, tileEnds_.bytes(), ends.data());
    std::uint64_t largest = 0;
    for (const TileBand& each : bands_) largest = std::max(largest, each.entries);
    const std::uint64_t bytes = std::max<std::uint64_t>(largest, 1) * sizeof(std::uint32_t);
    if (entries_.bytes() < bytes) {
        entries_ = Buffer();  // free the old lists first: memory might not suffice for old and new lists
        entries_ = storage(bytes, "the triangles of a tile");
    }
    statistics_.bytes = entries_.bytes();
    isFilled_ = false;
}

void LensFront::fill(const TileBand& band) {
    if (isFilled_ && filled_ == band.first) return;
    filled_ = band.first;
    isFilled_ = true;
    tileCounts_.update(0, tileCounts_.bytes(), tilePlaces_.data());
    frame_->bind(0);
    fillProgram_.use();
    bindTriangles();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, tileCounts_.name());
    binInto(band.first, band.end);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    sort(band);
}

void LensFront::binInto(std::uint32_t firstTile, std::uint32_t endTile) {
    glUniform2i(0, plan_.view.width, plan_.view.height);
    glUniform1ui(1, triangleCount_);
    for (std::uint32_t first = firstTile; first < endTile; first += maxTilesAtOnce) {
        glUniform1ui(2, first);
        glUniform1ui(3, std::min(endTile - first, maxTilesAtOnce) + first);
        dispatchOver(triangleCount_);
    }
}

void LensFront::sort(const TileBand& band) {
    sortProgram_.use();
    bindTriangles();
    // Save the ray buffer's binding, to restore it below: the depths temporarily use the same binding point.
    GLint rays = 0;
    glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, 6, &rays);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, depths_.name());
    glUniform1ui(0, band.first);
    const auto dispatch = [&](std::uint32_t block, std::uint32_t step) {
        glUniform2ui(1, block, step);
        glDispatchCompute(band.end - band.first, 1, 1);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    };
    if (statistics_.largestTile <= maxSortedAtOnce)
        dispatch(0, 0);
    else
        for (std::uint32_t block = 2; block / 2 < statistics_.largestTile; block *= 2)
            for (std::uint32_t step = block / 2; step > 0; step /= 2) dispatch(block, step);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, static_cast<GLuint>(rays));
}

void LensFront::bindTriangles() const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, clips_.name());
    if (clipsAtEnd_) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, clipsAtEnd_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, triangles_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, draws_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, tileEnds_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, entries_.name());
}

void LensFront::bindAttributes() const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, attributes_.name());
}

void LensFront::bindVertexLight(GLuint point) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, point, vertexLight_.name());
}

void LensFront::bindTests() const {
    bindTriangles();
    bindAttributes();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, draws_.name());
}

void LensFront::bindVertices() const {
    bindTests();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, vertexLight_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, firstTriangles_.name());
}

std::size_t LensFront::bytes() const {
    std::size_t total = 0;
    for (const Buffer* buffer : {&clips_, &clipsAtEnd_, &attributes_, &triangles_, &draws_, &depths_, &firstTriangles_,
                                 &vertexLight_, &tileCounts_, &tileEnds_, &entries_, &bases_, &ownBlurs_})
        total += buffer->bytes();
    for (const GpuPoses& poses : poses_) total += poses.texels.bytes();
    return total;
}

}  // namespace defocus::engine
