#pragma once
// Builds an Embree bounding-volume hierarchy of a posed scene in camera space, from the loaded meshes instead of their
// level-of-detail pyramids. Transforms are composed in double and passed to Embree relative to the camera.
//
// Back faces of single-sided materials are culled; mirroring transforms reverse the winding, as glTF requires. Packets
// are traced without a filter function; rays that hit a culled back face are traced again with the filter. All surfaces
// are opaque: alpha masks and blending are ignored.

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

// A primitive of an object, as one Embree geometry.
struct TracedGeometry {
    const Mesh* mesh = nullptr;
    const std::vector<glm::vec3>* normals = nullptr;  // normals of the mesh, or posed normals if the object deforms
    const Primitive* primitive = nullptr;
    const Material* material = nullptr;
    glm::mat3 worldNormalFromObject{1.0f};  // transforms normals to world space, without normalising
    glm::mat3 worldFromCamera{1.0f};        // transforms directions to world space
    glm::dvec3 camera{0.0};                 // position of the camera in world space, m
    float facing = 1;                       // −1 if the transform mirrors and thus reverses the winding, else 1
};

struct TraceOptions {
    bool watertight = true;  // true: no ray passes between adjacent triangles; slightly slower
    bool coherent = true;    // true: the rays of a packet have similar directions
};

class TracedScene {
public:
    TracedScene(const World& world, const glm::dmat4& worldFromCamera, const TraceOptions& options);
    ~TracedScene();
    TracedScene(const TracedScene&) = delete;
    TracedScene& operator=(const TracedScene&) = delete;

    // Finds the nearest hits of camera-space rays with ray parameters from tnear to `farthest`, for the lanes in
    // `mask`; the hits of other lanes stay unchanged. Thread-safe.
    void trace(const LaneMask& mask, float farthest, RTCRayHit16& packet) const;
    // Returns whether a camera-space ray hits anything at ray parameters up to `farthest`. Thread-safe.
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
    std::deque<TracedGeometry> geometries_;         // by Embree geometry id; a deque, so addresses stay valid
    std::deque<std::vector<glm::vec4>> positions_;  // in camera space, one array per object; Embree doesn't copy them
    std::deque<std::vector<glm::vec3>> normals_;    // in world space, one array per deformed object
    // By Embree geometry id: TracedGeometry::facing if back faces are culled, 0 if both sides are visible. One more
    // entry, 0, is for rays that hit nothing.
    std::vector<float> culledFacing_;
    std::uint64_t triangleCount_ = 0;
    std::atomic<std::int64_t> bytes_ = 0;
    std::atomic<std::int64_t> peakBytes_ = 0;
};

}  // namespace defocus::engine
