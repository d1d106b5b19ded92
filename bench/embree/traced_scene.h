#pragma once
// A posed scene as one Embree bounding-volume hierarchy in camera space: level 0 of every mesh as it was read, not the
// pyramid's copy of it. Transforms are composed in double and reach Embree relative to the camera.
//
// Single-sided materials are culled from behind, with the winding turned by mirroring transforms, as glTF asks. Packets
// are traced without asking at every hit; only rays that ended on the back of such a surface are traced once more, with
// a filter. Every surface is opaque: alpha masks and blending are not traced.

#include <embree3/rtcore.h>

#include <atomic>
#include <cstdint>
#include <deque>
#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "embree/ray_packet.h"
#include "plan/view.h"

namespace defocus::engine {

// A primitive of an object.
struct TracedGeometry {
    const Mesh* mesh = nullptr;
    const std::vector<glm::vec3>* normals = nullptr;  // the mesh's, or as posed
    const Primitive* primitive = nullptr;
    const Material* material = nullptr;
    glm::mat3 worldNormalFromObject{1.0f};  // not normalised
    glm::mat3 worldFromCamera{1.0f};        // of directions
    glm::dvec3 camera{0.0};                 // its place in the world, m
    float facing = 1;                       // −1 where the transform mirrors, so that front faces are clockwise
};

struct TraceOptions {
    bool watertight = true;  // no ray slips through between two triangles; a little slower
    bool coherent = true;    // the rays of a packet go much the same way
};

class TracedScene {
public:
    TracedScene(const World& world, const glm::dmat4& worldFromCamera, const TraceOptions& options);
    ~TracedScene();
    TracedScene(const TracedScene&) = delete;
    TracedScene& operator=(const TracedScene&) = delete;

    // Nearest hits of camera-space rays, from tnear to `farthest`, of the lanes in `mask`; the others stay as they are.
    // Called from any number of threads.
    void trace(const LaneMask& mask, float farthest, RTCRayHit16& packet) const;
    // Does anything lie along a camera-space ray, as far as `farthest` times its direction? Called from any number of
    // threads.
    [[nodiscard]] bool occluded(const glm::vec3& origin, const glm::vec3& direction, float farthest) const;
    [[nodiscard]] const TracedGeometry& geometry(std::uint32_t id) const { return geometries_[id]; }
    [[nodiscard]] std::uint32_t geometryCount() const { return static_cast<std::uint32_t>(geometries_.size()); }
    [[nodiscard]] std::uint64_t triangleCount() const { return triangleCount_; }
    [[nodiscard]] std::uint64_t peakBytes() const { return peakBytes_; }

private:
    void addObject(const World& world, const Object& object, const glm::dmat4& cameraFromWorld);
    void addPrimitive(const TracedGeometry& geometry, const std::vector<glm::vec4>& positions);
    void checkEmbree(const char* doing) const;
    static bool countMemory(void* scene, ssize_t bytes, bool after);

    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    TraceOptions options_;
    Material defaultMaterial_;
    std::deque<TracedGeometry> geometries_;         // by Embree geometry id; addresses stay put for the filter
    std::deque<std::vector<glm::vec4>> positions_;  // camera space, one array an object; Embree reads them in place
    std::deque<std::vector<glm::vec3>> normals_;    // world space, one array a deformed object
    // By Embree geometry id, and one more for a miss: facing of single-sided surfaces, 0 of all else.
    std::vector<float> culledFacing_;
    std::uint64_t triangleCount_ = 0;
    std::atomic<std::int64_t> bytes_ = 0;
    std::atomic<std::int64_t> peakBytes_ = 0;
};

}  // namespace defocus::engine
