#pragma once
// One fish as numbers: its outline, fins, relief and swimming bend. All lengths are in body lengths (snout to root of
// the tail fin) but `length`; `a` runs from 0 at the snout to 1 at the root of the tail fin. The fish looks along +x,
// its back is +y.

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace defocus::engine {

// Where the outline's knots lie; the outline is round at the snout (it grows with the root of `a`).
inline constexpr std::array<float, 9> fishKnots{0.0f, 0.04f, 0.12f, 0.25f, 0.4f, 0.55f, 0.7f, 0.85f, 1.0f};

struct FishOutline {
    std::array<float, 9> top{};     // height of the back above the axis, at the knots
    std::array<float, 9> bottom{};  // depth of the belly below the axis
    std::array<float, 9> width{};   // half thickness
};

// The elliptical cross-section at `a`.
struct FishSection {
    float centre = 0;  // height of its middle above the axis
    float halfHeight = 0;
    float halfWidth = 0;
};

enum class FinKind { dorsal, anal, caudal, pectoral, pelvic };

struct MedianFin {
    FinKind kind = FinKind::dorsal;
    float start = 0.3f;  // a of its first and last ray
    float end = 0.9f;
    std::array<float, 6> heights{};  // lengths of evenly spaced rays, from the first to the last
    float leanFront = 0.5f;          // radians from upright, backwards
    float leanRear = 0.8f;
    float curl = 0.1f;      // how far the tips trail backwards, in ray lengths
    float scallop = 0.03f;  // notches between the rays, in ray lengths
    int rays = 20;
};

struct CaudalFin {
    float length = 0.28f;
    float spread = 0.6f;    // radians, of the outer rays from the axis
    float fork = 0.4f;      // how much shorter the middle rays are, 0 … 1
    float rounding = 0.1f;  // how much shorter the outermost rays are, 0 … 1
    int rays = 22;
};

struct PairedFin {
    FinKind kind = FinKind::pectoral;
    float a = 0.3f;        // root
    float height = -0.2f;  // of the root, in half heights of the section
    float length = 0.2f;
    float spread = 0.9f;     // radians between the first and the last ray
    float outwards = 0.5f;   // radians off the body
    float downwards = 0.4f;  // radians below the axis
    float rootWidth = 0.05f;
    int rays = 12;
};

struct FishShape {
    float length = 0.3f;  // m
    FishOutline outline;
    float eyeA = 0.13f;
    float eyeHeight = 0.25f;  // in half heights of the section
    float eyeRadius = 0.034f;
    float mouthLength = 0.05f;
    float mouthDrop = 0.02f;
    float gillA = 0.27f;  // rear edge of the gill cover
    float scaleSize = 0.043f;
    float finRipple = 0.02f;  // sideways waves at the fins' edges
    float finPhase = 0.0f;
    float swimAmplitude = 0.3f;  // radians of heading at the tail
    float swimPhase = 0.0f;
    float turn = 0.0f;  // radians of even bend from head to tail
    std::vector<MedianFin> medianFins;
    CaudalFin caudal;
    PairedFin pectoral;
    PairedFin pelvic;
};

FishSection fishSection(const FishShape& shape, float a);

// A point of the straight fish's skin.
struct FishSkinPoint {
    float a = 0;
    float y = 0;           // height above the axis
    float halfHeight = 0;  // of the section
    float height = 0;      // −1 … 1 from belly to back: y in half heights of the section
    float alongGirth = 0;  // on the skin from the section's middle, upwards
};

// Displacement of the skin along its normal, in body lengths, and how dark its grooves are: eye socket, mouth, gill
// cover, scales and lateral line. `detail` is the edge length of the mesh: relief that it can't hold fades out.
struct FishRelief {
    float displacement = 0;
    float groove = 0;     // 0 … 1
    float scaleEdge = 0;  // 0 … 1, on the pale rim of a scale
    float scaleTone = 0;  // −1 … 1, one value a scale
};
FishRelief fishRelief(const FishShape& shape, const FishSkinPoint& point, float detail);

// The swimming bend: a point of the straight fish, moved sideways with its spine (all in body lengths, x = −a).
class FishSpine {
public:
    explicit FishSpine(const FishShape& shape);
    [[nodiscard]] glm::vec3 bend(const glm::vec3& straight) const;

private:
    static constexpr int steps = 256;
    static constexpr float first = -0.2f;  // a of the table's ends
    static constexpr float last = 2.3f;
    struct Station {
        glm::vec2 position{0.0f};  // x, z
        float heading = 0;
    };
    std::array<Station, steps + 1> table_;
};

}  // namespace defocus::engine
