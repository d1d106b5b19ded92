#pragma once
// What the lens-space methods share in front of their own kernels (Tzeng et al. 2012, High-Quality Parallel
// Depth-of-Field Using Line Samples): the vertices of a frame with their signed C, its triangles, and for each tile of
// the image the triangles that any point of the lens may show in it.
//
// The lists of the tiles grow as needed: triangles are counted, the places of the lists are summed up, and the lists
// filled. No triangle is lost to a full tile.

#include <map>
#include <string>
#include <vector>

#include "gl/program.h"
#include "gl/target.h"
#include "render/gpu_scene/surface_draws.h"

namespace defocus::engine {

// Surfaces that are shaded alike.
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
    std::uint64_t entries = 0;      // of all tiles together
    std::uint32_t largestTile = 0;  // triangles
    std::uint64_t bytes = 0;        // of the lists that are held at once
};

class LensFront {
public:
    // `tileSize`: px. `lightsVertices`: whether vertices have
    // light of their own (RecordShading). `entryBytes`: the most memory for lists at once; beyond it the tiles come in
    // several bands.
    LensFront(GpuScene& scene, std::uint32_t tileSize, bool lightsVertices, std::uint64_t entryBytes,
              std::filesystem::path shaderFolder);

    // The triangles of `plan`. `frame` must outlive the drawing. Throws Error, naming the object, for what no method of
    // this family can draw.
    void prepare(const FramePlan& plan, const FrameUniforms& frame, const std::string& method);
    // Vertices and tiles in a part of the exposure: from moment `part` of the shutter to the next. 0 if nothing moves.
    void pose(std::uint32_t part);
    // Fills the lists of a band, if they aren't yet: front to back.
    void fill(const TileBand& band);
    // Binds vertices, triangles, draws, ends of the tiles' lists and the lists as shaders/lens_space/ has them.
    void bindTriangles() const;
    void bindAttributes() const;
    void bindVertexLight() const;
    // Binds what shaders/lens_space/shade_vertices.comp reads and writes.
    void bindVertices() const;

    [[nodiscard]] const std::vector<TileBand>& bands() const { return bands_; }
    // Group i of triangles is shaded as groups()[i − 1]; 0 is the sky.
    [[nodiscard]] const std::vector<ShadedGroup>& groups() const { return groups_; }
    [[nodiscard]] const ShaderDefines& defines() const { return defines_; }  // that kernels over triangles need
    [[nodiscard]] bool lightsVertices() const { return lightsVertices_; }
    [[nodiscard]] std::uint32_t vertexCount() const { return vertexCount_; }
    [[nodiscard]] std::uint32_t triangleCount() const { return triangleCount_; }
    [[nodiscard]] std::uint32_t parts() const { return parts_; }  // of the exposure; 1 if nothing moves
    [[nodiscard]] const BinStatistics& statistics() const { return statistics_; }
    [[nodiscard]] std::size_t bytes() const;

private:
    struct Run {  // of indices
        std::uint32_t object = 0;
        std::uint32_t first = 0;
        std::uint32_t triangles = 0;
        std::uint32_t firstVertex = 0;
        std::uint32_t draw = 0;
    };
    struct Vertices {  // of an object at a level
        std::uint32_t object = 0;
        std::uint32_t level = 0;
        std::uint32_t first = 0;
        std::uint32_t count = 0;
    };
    struct GpuDraw {  // of shaders/lens_space/triangles.glsl
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
    void binInto(std::uint32_t firstTile, std::uint32_t endTile);  // with the program and the buffers that are bound
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
    GlTexture unused_;  // drivers want a target even where nothing is rasterised
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
    Buffer firstTriangles_, vertexLight_;  // where vertices have light of their own
    Buffer depths_;                        // of triangles, by which lists are sorted
    Buffer tileCounts_, tileEnds_, entries_;
    std::vector<std::uint32_t> tilePlaces_;  // where each tile's list begins in its band
    std::vector<TileBand> bands_;
    std::uint32_t filled_ = 0;  // the first tile of the band that is filled; its end if none is
    bool isFilled_ = false;
    BinStatistics statistics_;
};

// The kernels' dispatch over `count` items in groups of 256 threads.
void dispatchOver(std::uint64_t count);

}  // namespace defocus::engine
