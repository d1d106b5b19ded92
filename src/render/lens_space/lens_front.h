#pragma once
// Front end of the lens-space methods (Tzeng et al. 2012, High-Quality Parallel Depth-of-Field Using Line Samples). The
// front end computes the triangles and vertices of a frame, and the signed circle of confusion of each vertex. For each
// image tile, it lists the triangles that are visible in the tile from some lens point.
//
// The lists have no fixed capacity, so no triangle is lost: triangles are counted per tile, list offsets are prefix
// sums of the counts, and then the lists are filled.

#include <map>
#include <string>
#include <vector>

#include "gl/program.h"
#include "gl/target.h"
#include "render/gpu_scene/surface_draws.h"
#include "render/gpu_scene/vertex_arrays.h"
#include "render/lens_space/divided_triangles.h"

namespace defocus::engine {

// Surfaces with the same shading program and material.
struct ShadedGroup {
    ShaderDefines defines;
    int material = -1;
    AlphaMode alphaMode = AlphaMode::opaque;
    [[nodiscard]] bool seeThrough() const { return alphaMode != AlphaMode::opaque; }
};

// Tiles [first, end) whose triangle lists fit into one buffer. Tiles are numbered row by row from the lower left.
struct TileBand {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
    std::uint64_t entries = 0;
};

struct BinStatistics {
    std::uint32_t tiles = 0;
    std::uint64_t entries = 0;          // number of entries in the triangle lists of all tiles
    std::uint32_t largestTile = 0;      // max number of entries in a tile's triangle list
    std::uint64_t bytes = 0;            // bytes of the buffer with the lists of one band of tiles
    std::vector<std::uint32_t> counts;  // number of entries in each tile's triangle list
    // Returns the number of entries after the first `size` entries of each tile's triangle list, summed over all tiles;
    // 0 for size 0.
    [[nodiscard]] std::uint64_t entriesBeyond(std::uint32_t size) const;
};

struct LensFrontOptions {
    std::uint32_t tileSize = 0;   // tile side in px
    bool lightsVertices = false;  // lighting is computed per vertex (RecordShading)
    // true: divides triangles in which the circle of confusion is not linear. false: interpolates the circle of
    // confusion linearly between a triangle's corners, as in Tzeng et al. 2012.
    bool divides = true;
    // Max bytes of the tiles' lists of triangles. If the lists need more, the tiles are processed in several bands.
    std::uint64_t entryBytes = 0;
    std::filesystem::path shaderFolder;
};

class LensFront {
public:
    LensFront(GpuScene& scene, LensFrontOptions options);

    // Collects the vertices and triangles of `plan`. `frame` holds the uniforms of the plan, and must exist until all
    // rays of the plan are traced. Throws Error, with the object or feature in its message, for a plan that the
    // lens-space methods cannot draw; `method` is the method's name.
    void prepare(const FramePlan& plan, const FrameUniforms& frame, const std::string& method);
    // Computes the vertices and the sizes of the tiles' triangle lists for part `part` of the exposure, from shutter
    // time number `part` to the next shutter time. If nothing moves, there is only part 0.
    void pose(std::uint32_t part);
    // Fills the triangle lists of a band of tiles, and sorts each list front to back. Does nothing if the band's lists
    // are already filled.
    void fill(const TileBand& band);
    // Binds the buffers of vertices, triangles, draws and tile lists at the binding points in shaders/lens_space/.
    void bindTriangles() const;
    void bindAttributes() const;
    void bindVertexLight(GLuint point = 3) const;
    // Binds the inputs and outputs of shaders/lens_space/shade_vertices.comp.
    void bindVertices() const;
    // Binds the buffers of triangles, draw records and attributes for shaders/lens_space/let_through.comp.
    void bindTests() const;

    [[nodiscard]] const std::vector<TileBand>& bands() const { return bands_; }
    // Returns the groups of surfaces that are shaded alike. In shaders, index 0 is the sky, and index i ≥ 1 is
    // groups()[i − 1].
    [[nodiscard]] const std::vector<ShadedGroup>& groups() const { return groups_; }
    [[nodiscard]] const ShaderDefines& defines() const { return defines_; }  // defines for programs that read triangles
    [[nodiscard]] bool lightsVertices() const { return options_.lightsVertices; }
    [[nodiscard]] std::uint32_t vertexCount() const { return vertexCount_; }
    [[nodiscard]] std::uint32_t triangleCount() const { return triangleCount_; }
    [[nodiscard]] std::uint32_t parts() const { return parts_; }  // number of parts into which the exposure is divided
    [[nodiscard]] const BinStatistics& statistics() const { return statistics_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    struct Run {  // a range of the mesh's index buffer
        std::uint32_t object = 0;
        std::uint32_t first = 0;
        std::uint32_t triangles = 0;
        std::uint32_t firstVertex = 0;
        std::uint32_t draw = 0;
        std::uint32_t parts = 1;  // number of parts into which each triangle edge is divided; 1: undivided
    };
    struct Vertices {  // the vertices of an object at one level of detail
        std::uint32_t object = 0;
        std::uint32_t level = 0;
        std::uint32_t first = 0;
        std::uint32_t count = 0;
    };
    struct GpuDraw {  // matches shaders/lens_space/triangles.glsl
        std::uint32_t firstRay = 0;
        std::uint32_t endRay = 0;
        std::uint32_t group = 0;
        std::uint32_t doubleSided = 0;
        std::uint32_t seeThrough = 0;
    };

    // Adds the triangles of a level. If the circle of confusion is not linear inside the object's triangles, they are
    // divided into at most `maxSmall` small triangles in total.
    void addLevel(std::uint32_t object, const LevelDraw& level, double maxSmall, std::vector<GpuDraw>& draws);
    void addDivisions();
    std::uint32_t groupOf(int mesh, int material, std::uint32_t level);
    void makeTriangles();
    // Converts index ranges to triangles in `target`: the ranges whose triangles will be divided (if `divided`), or all
    // other ranges.
    void convertRuns(const Buffer& target, bool divided);
    void makeVertices(const Buffer& target, std::size_t vertexBytes, bool attributes, std::uint32_t moment,
                      float fraction);
    [[nodiscard]] bool changesBlur(const Vertices& vertices) const;
    const Program& vertexProgram(const Vertices& vertices, bool attributes);
    void makeDepths();
    void countTiles();
    void binInto(std::uint32_t firstTile, std::uint32_t endTile);  // the compute program and its buffers must be bound
    void sort(const TileBand& band);

    GpuScene* scene_;
    LensFrontOptions options_;
    DividedTriangles divided_;
    FramePlan plan_;
    const FrameUniforms* frame_ = nullptr;
    ShaderDefines defines_;
    std::map<std::string, Program> programs_;
    ShaderDefines binDefines_;
    Program trianglesProgram_, depthsProgram_, countProgram_, fillProgram_, sortProgram_;
    GlTexture unused_;  // dummy target, which drivers need even with rasterization disabled
    Target unusedTarget_;
    std::vector<GpuObject> objects_;
    VertexArrays arrays_;
    std::vector<GpuPoses> poses_;
    std::vector<Vertices> vertices_;
    std::vector<Run> runs_;
    std::vector<ShadedGroup> groups_;
    std::map<std::string, std::uint32_t> groupNumbers_;
    std::uint32_t vertexCount_ = 0;
    std::uint32_t triangleCount_ = 0;
    std::uint32_t parts_ = 1;
    Buffer clips_, clipsAtEnd_, attributes_, triangles_, draws_;
    Buffer bases_;                         // original triangles that small triangles replace, see DividedTriangles
    Buffer ownBlurs_;                      // blur modifiers of the vertices; used only if triangles are divided
    Buffer firstTriangles_, vertexLight_;  // used only with per-vertex lighting
    Buffer depths_;                        // min depth of each triangle, the sort key of the tiles' lists
    Buffer tileCounts_, tileEnds_, entries_;
    std::vector<std::uint32_t> tilePlaces_;  // offset of each tile's triangle list in the buffer of its band of tiles
    std::vector<TileBand> bands_;
    std::uint32_t filled_ = 0;  // first tile of the band of tiles whose triangle lists are in entries_
    bool isFilled_ = false;
    BinStatistics statistics_;
};

// Dispatches the current compute program with at least `count` invocations, in groups of 256.
void dispatchOver(std::uint64_t count);

}  // namespace defocus::engine
