#include "embree/traced_scene.h"

#include <algorithm>
#include <glm/gtc/matrix_inverse.hpp>
#include <limits>

#include "core/error.h"
#include "plan/motion/object_pose.h"
#include "scene/posed_mesh.h"

namespace defocus::engine {

namespace {

// Filter function for Embree that rejects hits on the back of single-sided surfaces. Embree's geometric normal is (p1 −
// p0) × (p2 − p0).
void cullBackFaces(const RTCFilterFunctionNArguments* arguments) {
    const auto& geometry = *static_cast<const TracedGeometry*>(arguments->geometryUserPtr);
    if (geometry.material->doubleSided) return;
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] != -1) continue;
        const float towards =
            RTCRayN_dir_x(arguments->ray, arguments->N, i) * RTCHitN_Ng_x(arguments->hit, arguments->N, i) +
            RTCRayN_dir_y(arguments->ray, arguments->N, i) * RTCHitN_Ng_y(arguments->hit, arguments->N, i) +
            RTCRayN_dir_z(arguments->ray, arguments->N, i) * RTCHitN_Ng_z(arguments->hit, arguments->N, i);
        if (towards * geometry.facing > 0) arguments->valid[i] = 0;
    }
}

// Sets `back` to the lanes of `mask` that hit the back of a single-sided surface. Returns whether any lane does.
DEFOCUS_VECTOR_CLONES bool findBackFaces(const float* culledFacing, std::uint32_t miss, const LaneMask& mask,
                                         const RTCRayHit16& packet, LaneMask& back) {
    int any = 0;
    for (int i = 0; i < packetSize; ++i) {
        const float towards = packet.ray.dir_x[i] * packet.hit.Ng_x[i] + packet.ray.dir_y[i] * packet.hit.Ng_y[i] +
                              packet.ray.dir_z[i] * packet.hit.Ng_z[i];
        const auto geometry = static_cast<std::int32_t>(std::min(packet.hit.geomID[i], miss));
        back[i] = towards * culledFacing[geometry] > 0 ? mask[i] : 0;
        any |= back[i];
    }
    return any != 0;
}

void forgetHits(const LaneMask& mask, float farthest, RTCRayHit16& packet) {
    for (int i = 0; i < packetSize; ++i) {
        packet.ray.tfar[i] = mask[i] != 0 ? farthest : packet.ray.tfar[i];
        packet.hit.geomID[i] = mask[i] != 0 ? RTC_INVALID_GEOMETRY_ID : packet.hit.geomID[i];
    }
}

std::vector<glm::vec4> cameraPositions(const Mesh& mesh, const Object& object, const glm::dmat4& cameraFromWorld) {
    std::vector<glm::vec4> positions;
    positions.reserve(mesh.vertices.count());
    for (const glm::dvec3& position : posedPositions(mesh, object))
        positions.emplace_back(cameraFromWorld * glm::dvec4(position, 1.0));
    return positions;
}

}  // namespace

void TracedScene::checkEmbree(const char* doing) const {
    const RTCError error = rtcGetDeviceError(device_);
    if (error != RTC_ERROR_NONE) fail("Embree: {} failed (error {})", doing, static_cast<int>(error));
}

bool TracedScene::countMemory(void* scene, ssize_t bytes, bool) {
    auto& self = *static_cast<TracedScene*>(scene);
    const std::int64_t now = self.bytes_ += bytes;
    std::int64_t peak = self.peakBytes_;
    while (now > peak && !self.peakBytes_.compare_exchange_weak(peak, now)) {
    }
    return true;
}

void TracedScene::addPrimitive(const TracedGeometry& geometry, const std::vector<glm::vec4>& positions) {
    const std::vector<std::uint32_t>& indices = geometry.primitive->indices;
    const RTCGeometry handle = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(handle, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                               sizeof(glm::vec4), positions.size());
    rtcSetSharedGeometryBuffer(handle, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(), 0,
                               3 * sizeof(std::uint32_t), indices.size() / 3);
    geometries_.push_back(geometry);
    rtcSetGeometryUserData(handle, &geometries_.back());
    culledFacing_.push_back(geometry.material->doubleSided ? 0 : geometry.facing);
    rtcCommitGeometry(handle);
    rtcAttachGeometryByID(scene_, handle, static_cast<unsigned>(geometries_.size() - 1));
    rtcReleaseGeometry(handle);
    checkEmbree("adding a geometry");
    triangleCount_ += indices.size() / 3;
}

void TracedScene::addObject(const World& world, const Object& object, const glm::dmat4& cameraFromWorld) {
    if (object.mesh < 0) return;
    const Mesh& mesh = world.scene->meshes[static_cast<std::size_t>(object.mesh)];
    positions_.push_back(cameraPositions(mesh, object, cameraFromWorld));
    bytes_ += static_cast<std::int64_t>(positions_.back().size() * sizeof(glm::vec4));

    TracedGeometry geometry;
    geometry.mesh = &mesh;
    geometry.normals = &mesh.vertices.normals;
    if (deformed(object))
        geometry.normals = &normals_.emplace_back(posedNormals(mesh, object));
    else
        geometry.worldNormalFromObject = glm::mat3(glm::inverseTranspose(glm::dmat3(object.worldFromObject)));
    const glm::dmat4 worldFromCamera = glm::inverse(cameraFromWorld);
    geometry.worldFromCamera = glm::mat3(worldFromCamera);
    geometry.camera = glm::dvec3(worldFromCamera[3]);
    geometry.facing = mirrors(objectPose(object, glm::dmat4(1))) ? -1.0f : 1.0f;
    for (const Primitive& primitive : mesh.primitives) {
        if (primitive.indices.empty()) continue;
        geometry.primitive = &primitive;
        geometry.material = &materialAt(*world.scene, primitive.material);
        addPrimitive(geometry, positions_.back());
    }
}

TracedScene::TracedScene(const World& world, const glm::dmat4& worldFromCamera, const TraceOptions& options)
    : device_(rtcNewDevice(nullptr)), options_(options) {
    if (device_ == nullptr) fail("Embree: no device (error {})", static_cast<int>(rtcGetDeviceError(nullptr)));
    rtcSetDeviceMemoryMonitorFunction(device_, countMemory, this);
    scene_ = rtcNewScene(device_);
    try {
        rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION |
                                                            (options_.watertight ? RTC_SCENE_FLAG_ROBUST : 0)));
        const glm::dmat4 cameraFromWorld = glm::inverse(worldFromCamera);
        for (const Object& object : world.pose.objects) addObject(world, object, cameraFromWorld);
        culledFacing_.push_back(0);
        rtcCommitScene(scene_);
        checkEmbree("building the hierarchy");
    } catch (...) {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
        throw;
    }
}

TracedScene::~TracedScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

void TracedScene::trace(const LaneMask& mask, float farthest, RTCRayHit16& packet) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = options_.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    forgetHits(mask, farthest, packet);
    rtcIntersect16(mask.values.data(), scene_, &context, &packet);

    LaneMask back;
    if (!findBackFaces(culledFacing_.data(), geometryCount(), mask, packet, back)) return;
    context.filter = cullBackFaces;
    forgetHits(back, farthest, packet);
    rtcIntersect16(back.values.data(), scene_, &context, &packet);
}

bool TracedScene::occluded(const glm::vec3& origin, const glm::vec3& direction, float farthest) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tnear = 0;
    ray.tfar = farthest;
    ray.mask = ~0u;
    rtcOccluded1(scene_, &context, &ray);
    return ray.tfar < 0;
}

}  // namespace defocus::engine
