#pragma once
// Describes the shape of one fish by parameters: outline, fins, relief and swimming bend. Lengths are in body lengths
// (snout to root of the tail fin), except FishShape::length in m. The position `a` along the body runs from 0 at the
// snout to 1 at the root of the tail fin. The fish faces +x; its back is +y.

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace defocus::engine {

// Positions along the body (0 at the snout, 1 at the root of the tail fin) at which outlines are specified. The outline
// grows with the square root of the position, so that the snout is round.
inline constexpr std::array<float, 9> fishKnots{0.0f, 0.04f, 0.12f, 0.25f, 0.4f, 0.55f, 0.7f, 0.85f, 1.0f};

struct FishOutline {
    std::array<float, 9> top{};     // height of the back above the body's axis, at each position in fishKnots
    std::array<float, 9> bottom{};  // depth of the belly below the body's axis
    std::array<float, 9> width{};   // half thickness of the body
};

// Elliptical cross-section of the fish at position `a` along the body.
struct FishSection {
    float centre = 0;  // height of the cross-section's centre above the body's axis
    float halfHeight = 0;
    float halfWidth = 0;
};

enum class FinKind { dorsal, anal, caudal, pectoral, pelvic };

struct MedianFin {
    FinKind kind = FinKind::dorsal;
    float start = 0.3f;  // position of the first fin ray along the body, 0 (snout) to 1 (tail)
    float end = 0.9f;
    std::array<float, 6> heights{};  // lengths of evenly spaced fin rays, from first to last
    float leanFront = 0.5f;          // angle of the first fin ray in radians, backwards from upright
    float leanRear = 0.8f;
    float curl = 0.1f;      // backward displacement of the fin rays' tips, in fin ray lengths
    float scallop = 0.03f;  // depth of notches between the tips of fin rays, in fin ray lengths
    int rays = 20;
};

struct CaudalFin {
    float length = 0.28f;
    float spread = 0.6f;    // angle in radians between the body's axis and the outermost fin rays
    float fork = 0.4f;      // relative shortening of the middle fin rays, 0 to 1
    float rounding = 0.1f;  // relative shortening of the outermost fin rays, 0 to 1
    int rays = 22;
};

struct PairedFin {
    FinKind kind = FinKind::pectoral;
    float a = 0.3f;  // position of the fin's root along the body, 0 (snout) to 1 (tail)
    // Height of the fin's root above the cross-section's centre, relative to the section's half height.
    float height = -0.2f;
    float length = 0.2f;
    float spread = 0.9f;     // angle in radians between the first and last fin ray
    float outwards = 0.5f;   // angle in radians between the fin and the side of the body
    float downwards = 0.4f;  // downward angle in radians between the fin and the body's axis
    float rootWidth = 0.05f;
    int rays = 12;
};

struct FishShape {
    float length = 0.3f;  // body length in m, without the tail fin
    FishOutline outline;
    float eyeA = 0.13f;
    // Height of the eye above the cross-section's centre, relative to the section's half height.
    float eyeHeight = 0.25f;
    float eyeRadius = 0.034f;
    float mouthLength = 0.05f;
    float mouthDrop = 0.02f;
    float gillA = 0.27f;  // position of the gill cover's rear edge along the body, 0 (snout) to 1 (tail)
    float scaleSize = 0.043f;
    float finRipple = 0.02f;  // amplitude of sideways waves at the edges of fins, body lengths
    float finPhase = 0.0f;
    float swimAmplitude = 0.3f;  // amplitude of the heading at the tail while the fish swims, radians
    float swimPhase = 0.0f;
    float turn = 0.0f;  // bend of the whole body from head to tail, radians
    std::vector<MedianFin> medianFins;
    CaudalFin caudal;
    PairedFin pectoral;
    PairedFin pelvic;
};

FishSection fishSection(const FishShape& shape, float a);

// Point on the skin of the straight fish, before the swimming bend.
struct FishSkinPoint {
    float a = 0;
    float y = 0;           // height above the body's axis
    float halfHeight = 0;  // half the height of the body's cross-section
    float height = 0;      // height in the cross-section, from −1 at the belly to 1 at the back
    float alongGirth = 0;  // distance along the skin from the middle of the flank, > 0 towards the back
};

// Relief of the skin at a point: eye socket, mouth, gill cover, scales and lateral line. The displacement is along the
// normal, in body lengths. Features fade out if they are small compared with `detail`, the mesh's edge length.
struct FishRelief {
    float displacement = 0;
    float groove = 0;     // darkness of grooves, 0 to 1
    float scaleEdge = 0;  // 1 on the pale rim of a fish scale, 0 elsewhere
    float scaleTone = 0;  // brightness offset from −1 to 1, constant per fish scale
};
FishRelief fishRelief(const FishShape& shape, const FishSkinPoint& point, float detail);

// Spine of the swimming fish. bend() moves a point of the straight fish along with the spine. Coordinates
// are in body lengths; x = −a, where `a` is the position along the body.
class FishSpine {
public:
    explicit FishSpine(const FishShape& shape);
    [[nodiscard]] glm::vec3 bend(const glm::vec3& straight) const;

private:
    static constexpr int steps = 256;
    static constexpr float first = -0.2f;  // position of the first tabulated spine point along the body
    static constexpr float last = 2.3f;
    struct Station {
        glm::vec2 position{0.0f};  // x and z coordinates of the spine point
        float heading = 0;
    };
    std::array<Station, steps + 1> table_;
};

}  // namespace defocus::engine
