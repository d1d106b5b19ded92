#pragma once
// The common front end of the lens-space methods (Tzeng et al. 2012, High-Quality Parallel Depth-of-Field Using Line
// Samples). It computes a frame's vertices with their signed C, and its triangles. A list per image tile holds the
// triangles that some lens point may see in that tile.
//
// The lists have no fixed capacity: triangles are counted, the list offsets are prefix sums of the counts, and then the
// lists are filled. No triangle is lost to a full tile.

#include <map>
#include <string>
#include <vector>

#include "gl/program.h"
#include "gl/target.h"
#include "render/gpu_scene/surface_draws.h"

namespace defocus::engine {

// Surfaces that share one shading program and material.
struct ShadedGroup {
    ShaderDefines defines;
    int material = -1;
};

// Tiles [first, end), in rows from the lower left, whose lists fit into one buffer.
struct TileBand {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
    std::uint64_t entries = 0;
};

struct BinStatistics {
    std::uint32_t tiles = 0;
    std::uint64_t entries = 0;      // list entries of all tiles
    std::uint32_t largestTile = 0;  // number of triangles in the fullest tile
    std::uint64_t bytes = 0;        // memory of the lists that are held at the same time
};

class LensFront {
public:
    // `tileSize`: px. `lightsVertices`: whether lighting is computed per vertex (RecordShading). `entryBytes`: memory
    // limit for the lists; beyond it the tiles are processed in several bands.
    LensFront(GpuScene& scene, std::uint32_t tileSize, bool lightsVertices, std::uint64_t entryBytes,
              std::filesystem::path shaderFolder);

    // Prepares the triangles of `plan`. `frame` must outlive the drawing. Throws Error, naming the object or the
    // feature, for a plan that the lens-space methods can't draw.
    void prepare(const FramePlan& plan, const FrameUniforms& frame, const std::string& method);
    // Computes vertices and tile counts for a part of the exposure: from moment `part` of the shutter to the next
    // moment. Use part 0 if nothing moves.
    void pose(std::uint32_t part);
    // Fills and sorts the lists of a band, front to back, unless it is the current band.
    void fill(const TileBand& band);
    // Binds vertices, triangles, draws, list ends and lists to the bindings of shaders/lens_space/.
    void bindTriangles() const;
    void bindAttributes() const;
    void bindVertexLight() const;
    // Binds the inputs and outputs of shaders/lens_space/shade_vertices.comp.
    void bindVertices() const;

    [[nodiscard]] const std::vector<TileBand>& bands() const { return bands_; }
    // Group i of triangles has the shading of groups()[i − 1]; group 0 is the sky.
    [[nodiscard]] const std::vector<ShadedGroup>& groups() const { return groups_; }
    [[nodiscard]] const ShaderDefines& defines() const { return defines_; }  // defines for kernels that read triangles
    [[nodiscard]] bool lightsVertices() const { return lightsVertices_; }
    [[nodiscard]] std::uint32_t vertexCount() const { return vertexCount_; }
    [[nodiscard]] std::uint32_t triangleCount() const { return triangleCount_; }
    [[nodiscard]] std::uint32_t parts() const { return parts_; }  // parts of the exposure; 1 if nothing moves
    [[nodiscard]] const BinStatistics& statistics() const { return statistics_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    struct Run {  // A range of indices.
        std::uint32_t object = 0;
        std::uint32_t first = 0;
        std::uint32_t triangles = 0;
        std::uint32_t firstVertex = 0;
        std::uint32_t draw = 0;
    };
    struct Vertices {  // The vertices of an object at one level.
        std::uint32_t object = 0;
        std::uint32_t level = 0;
        std::uint32_t first = 0;
        std::uint32_t count = 0;
    };
    struct GpuDraw {  // Layout of shaders/lens_space/triangles.glsl.
        std::uint32_t firstRay = 0;
        std::uint32_t endRay = 0;
        std::uint32_t group = 0;
        std::uint32_t doubleSided = 0;
    };

    void addLevel(std::uint32_t object, const LevelDraw& level, std::vector<GpuDraw>& draws);
    std::uint32_t groupOf(int mesh, int material, std::uint32_t level);
    void makeTriangles();
    void makeVertices(const Buffer& target, std::size_t vertexBytes, bool attributes, std::uint32_t moment,
                      float fraction);
    [[nodiscard]] bool changesBlur(const Vertices& vertices) const;
    const Program& vertexProgram(const Vertices& vertices, bool attributes);
    void makeDepths();
    void countTiles();
    void binInto(std::uint32_t firstTile, std::uint32_t endTile);  // the program and its buffers must be bound
    void sort(const TileBand& band);

    GpuScene* scene_;
    std::uint32_t tileSize_;
    bool lightsVertices_;
    std::uint64_t entryBytes_;
    std::filesystem::path shaderFolder_;
    FramePlan plan_;
    const FrameUniforms* frame_ = nullptr;
    ShaderDefines defines_;
    std::map<std::string, Program> programs_;
    ShaderDefines binDefines_;
    Program trianglesProgram_, depthsProgram_, countProgram_, fillProgram_, sortProgram_;
    GlTexture unused_;  // dummy target: drivers need one even with rasterization disabled
    Target unusedTarget_;
    UniformBlocks<GpuObject> objects_;
    std::vector<GpuPoses> poses_;
    std::vector<Vertices> vertices_;
    std::vector<Run> runs_;
    std::vector<ShadedGroup> groups_;
    std::map<std::string, std::uint32_t> groupNumbers_;
    std::uint32_t vertexCount_ = 0;
    std::uint32_t triangleCount_ = 0;
    std::uint32_t parts_ = 1;
    Buffer clips_, clipsAtEnd_, attributes_, triangles_, draws_;
    Buffer firstTriangles_, vertexLight_;  // allocated only with per-vertex lighting
    Buffer depths_;                        // one per triangle: sort key of the lists
    Buffer tileCounts_, tileEnds_, entries_;
    std::vector<std::uint32_t> tilePlaces_;  // offset of each tile's list in its band
    std::vector<TileBand> bands_;
    std::uint32_t filled_ = 0;  // first tile of the band that is filled
    bool isFilled_ = false;
    BinStatistics statistics_;
};

// Dispatches the current kernel over `count` items in groups of 256 threads.
void dispatchOver(std::uint64_t count);

}  // namespace defocus::engine
