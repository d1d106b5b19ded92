#pragma once
// Builds scenes for comparing the rasterizer with the ray tracer. Lighting is baked into unlit materials, and a wide
// lens blurs the image. Further functions measure how two images differ.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>

#include "baked_scene.h"
#include "bokeh.h"
#include "image/image.h"
#include "plan/frame_plan.h"
#include "render/renderer.h"
#include "scene/gltf/gltf.h"
#include "school/fish_school.h"

namespace defocus::engine {

struct TruthScene {
    explicit TruthScene(const std::shared_ptr<Scene>& owned) : scene(*owned) { world.scene = owned; }
    TruthScene(const TruthScene&) = delete;
    TruthScene& operator=(const TruthScene&) = delete;

    Scene& scene;  // the scene that `world` refers to
    World world;
    View view;
};

namespace truth_detail {

// Focuses at a third of the scene's depth range, and sets the f-number so that the larger of the blurs of the nearest
// and the farthest point is `blur` px. Lens values of the scene's camera take precedence.
inline void setLens(TruthScene& baked, const Camera& camera, double blur) {
    View& view = baked.view;
    const double tanHalf = std::tan(camera.yfov / 2) * view.width / view.height;
    view.lens.focalLength = view.lens.horizontalAperture / (2 * tanHalf);
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = 0;
    for (const glm::dvec3& corner : baked.world.pose.bounds.corners()) {
        const double depth = -(glm::inverse(view.worldFromCamera) * glm::dvec4(corner, 1)).z;
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    nearest = std::max(nearest, 0.05 * farthest);
    const double focus = nearest + (farthest - nearest) / 3;
    const double defocus = std::max(1 / nearest - 1 / focus, 1 / focus - 1 / farthest);
    const double aperture = blur * 2 * tanHalf / (view.width * defocus);  // m
    view.lens.focusDistance = camera.lensValue("focusDistance").value_or(focus);
    view.lens.fStop = camera.lensValue("fStop").value_or(view.lens.focalLength / (1000 * aperture));
}

}  // namespace truth_detail

// Returns the scene at full detail in an image of `width` × `height` px. The lens is that of the scene's camera, if it
// has one; otherwise the largest blur is 24 px per 512 px of image width.
inline std::unique_ptr<TruthScene> truthScene(Scene scene, int width, int height) {
    auto baked = std::make_unique<TruthScene>(std::make_shared<Scene>(bakedUnlit(std::move(scene))));
    baked->world.pose = poseAt(baked->scene, 0, -1);
    baked->world.environment = environmentOrDefault(baked->scene);
    for (const Mesh& mesh : baked->scene.meshes) baked->world.pyramids.push_back(fullDetail(mesh));

    const double aspect = static_cast<double>(width) / height;
    const PlacedCamera placed = chooseCamera(baked->scene, baked->world.pose, {}, aspect);
    baked->view.worldFromCamera = placed.worldFromCamera;
    baked->view.nearPlane = placed.camera.znear;
    baked->view.width = width;
    baked->view.height = height;
    truth_detail::setLens(*baked, placed.camera, 24.0 * width / 512);
    return baked;
}

inline RenderSettings fullDetailSettings(std::uint32_t samples, std::uint32_t seed = 0) {
    // the tests' limits were determined with the Halton sequence
    return {.sampleCount = samples, .sequence = Sequence::halton, .seed = seed, .lod = LodMode::off};
}

// Signed difference b − a of two images a and b, averaged over blocks of 32 × 32 px and three channels.
struct BlockDifference {
    double mean = 0;     // mean of the signed differences of all blocks
    double rms = 0;      // RMS of the signed differences of all blocks
    double largest = 0;  // largest absolute difference of a block
};

inline BlockDifference blockDifference(const Image& a, const Image& b) {
    constexpr int size = 32;
    BlockDifference result;
    int blocks = 0;
    for (int top = 0; top + size <= a.height; top += size) {
        for (int left = 0; left + size <= a.width; left += size, ++blocks) {
            double sum = 0;
            for (int y = top; y < top + size; ++y) {
                for (int x = left; x < left + size; ++x) {
                    for (int c = 0; c < 3; ++c) sum += static_cast<double>(b.at(x, y)[c]) - a.at(x, y)[c];
                }
            }
            const double mean = sum / (3.0 * size * size);
            result.mean += mean;
            result.rms += mean * mean;
            result.largest = std::max(result.largest, std::abs(mean));
        }
    }
    result.mean /= blocks;
    result.rms = std::sqrt(result.rms / blocks);
    return result;
}

// Displacement of an image `b` relative to `a`: a shift in px (right, down) and a relative growth about the centre.
// Both are the least-squares fit of the first-order change b − a ≈ −∇a·(shift + growth·(p − centre)) (Lucas and Kanade
// 1981).
struct Misplacement {
    double right = 0;
    double down = 0;
    double growth = 0;
};

inline Misplacement misplacement(const Image& a, const Image& b) {
    glm::dmat3 normal(0);
    glm::dvec3 right(0);
    for (int y = 1; y + 1 < a.height; ++y) {
        for (int x = 1; x + 1 < a.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const double dx = 0.5 * (static_cast<double>(a.at(x + 1, y)[c]) - a.at(x - 1, y)[c]);
                const double dy = 0.5 * (static_cast<double>(a.at(x, y + 1)[c]) - a.at(x, y - 1)[c]);
                const double out = dx * (x + 0.5 - a.width / 2.0) + dy * (y + 0.5 - a.height / 2.0);
                const glm::dvec3 row(-dx, -dy, -out);
                normal += glm::outerProduct(row, row);
                right += row * (static_cast<double>(b.at(x, y)[c]) - a.at(x, y)[c]);
            }
        }
    }
    const glm::dvec3 solved = glm::inverse(normal) * right;
    return {solved.x, solved.y, solved.z};
}

// Returns the least-squares factor k in b − a ≈ k·(to − from) for four images of equal size.
inline double shareOfChange(const Image& a, const Image& b, const Image& from, const Image& to) {
    double along = 0;
    double square = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double change = static_cast<double>(to.pixels[i]) - from.pixels[i];
        along += change * (static_cast<double>(b.pixels[i]) - a.pixels[i]);
        square += change * change;
    }
    return along / square;
}

// Returns an image for visual inspection: the signed difference b − a times `gain`, around middle grey.
inline Image differenceImage(const Image& a, const Image& b, float gain) {
    Image result(a.width, a.height, 3);
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            for (int c = 0; c < 3; ++c) result.at(x, y)[c] = 0.214f + gain * (b.at(x, y)[c] - a.at(x, y)[c]);
        }
    }
    return result;
}

}  // namespace defocus::engine
