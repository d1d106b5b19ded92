#include "plan/lens_cells/swept_work.h"

#include <algorithm>
#include <cmath>

#include "image/colour_map.h"
#include "lens/aberrations.h"
#include "plan/motion/clip_vertices.h"
#include "plan/visible/lens_facing.h"

namespace defocus::engine {

namespace {

// Rectangle in normalised device coordinates that bounds a triangle over the lens and the exposure.
struct SweptBounds {
    glm::dvec2 min{1e30};
    glm::dvec2 max{-1e30};
};

// Accumulates an image from rectangles of constant value. add() stores a rectangle as changes at its four corners;
// image() sums these changes over rows and columns (prefix sums).
class RectangleSums {
public:
    RectangleSums(int width, int height)
        : width_(width), height_(height), corners_(static_cast<std::size_t>(width + 1) * (height + 1)) {}

    // Adds `value` to all pixels that `bounds` overlaps.
    void add(const SweptBounds& bounds, double value) {
        const auto place = [](double ndc, int size) {
            return std::clamp((ndc + 1) / 2 * size, 0.0, static_cast<double>(size));
        };
        const int left = static_cast<int>(std::floor(place(bounds.min.x, width_)));
        const int right = static_cast<int>(std::ceil(place(bounds.max.x, width_)));
        const int top = static_cast<int>(std::floor(place(-bounds.max.y, height_)));
        const int bottom = static_cast<int>(std::ceil(place(-bounds.min.y, height_)));
        if (left >= right || top >= bottom) return;
        at(left, top) += value;
        at(right, top) -= value;
        at(left, bottom) -= value;
        at(right, bottom) += value;
    }

    [[nodiscard]] Image image() {
        for (int y = 0; y <= height_; ++y)
            for (int x = 1; x <= width_; ++x) at(x, y) += at(x - 1, y);
        Image result(width_, height_, 1);
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                if (y > 0) at(x, y) += at(x, y - 1);
                *result.at(x, y) = static_cast<float>(at(x, y));
            }
        return result;
    }

private:
    double& at(int x, int y) { return corners_[static_cast<std::size_t>(y) * (width_ + 1) + x]; }

    int width_;
    int height_;
    std::vector<double> corners_;
};

// Returns the object's clip-space vertices at the shutter times. Between two shutter times, x/w, y/w and C/w stay
// between the values at these times, where C is the circle of confusion.
std::vector<ClipVertices> momentsOf(const FramePlan& plan, const World& world, const ObjectPlan& object,
                                    std::uint32_t level) {
    std::vector<ClipVertices> moments;
    const std::size_t count = object.motion.size();
    for (std::size_t i = 0; i < count; ++i) {
        const double time = world.shutter.perSample ? static_cast<double>(plan.samples[i].time)
                                                    : static_cast<double>(i) / static_cast<double>(count - 1);
        moments.push_back(clipVertices(plan, world, object, level, object.motion[i], time));
    }
    if (count == 0 && !object.blurMoves) moments.push_back(clipVertices(plan, world, object, level, object.pose, 0.5));
    if (count == 0 && object.blurMoves)
        for (const double time : {0.0, 1.0})
            moments.push_back(clipVertices(plan, world, object, level, object.pose, time));
    return moments;
}

class LevelSweep {
public:
    LevelSweep(const FramePlan& plan, const World& world, const ObjectPlan& object, const LevelDraw& draw)
        : plan_(&plan),
          object_(&object),
          moments_(momentsOf(plan, world, object, draw.level)),
          share_(static_cast<double>(draw.sampleCount) / static_cast<double>(plan.samples.size())) {}

    void addTo(RectangleSums& sums, const std::uint32_t* indices, bool oneSided) const {
        if (oneSided && facesAway(indices)) return;
        SweptBounds bounds;
        for (const ClipVertices& moment : moments_)
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec3& p = moment.places[indices[k]];
                if (!(p.z > plan_->view.nearPlane)) {
                    sums.add({glm::dvec2(-1), glm::dvec2(1)}, share_);
                    return;
                }
                const glm::dvec2 field = glm::dvec2(p) / p.z / glm::dvec2(1, plan_->coc.aspect);
                const double blur =
                    std::abs(moment.coc[indices[k]] / p.z) + aberrationReach(plan_->coc, glm::length(field));
                const glm::dvec2 reach = blur * glm::dvec2(1, plan_->coc.aspect);
                bounds.min = glm::min(bounds.min, glm::dvec2(p) / p.z - reach);
                bounds.max = glm::max(bounds.max, glm::dvec2(p) / p.z + reach);
            }
        sums.add(bounds, share_);
    }

private:
    // Returns true if the triangle faces away from the entire lens; always false for moving objects and lenses with
    // aberrations.
    [[nodiscard]] bool facesAway(const std::uint32_t* indices) const {
        if (moments_.size() > 1 || plan_->coc.aberrates()) return false;
        LensTriangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t from = object_->mirrored ? 2 - k : k;
            triangle.places[k] = moments_[0].places[indices[from]];
            triangle.coc[k] = moments_[0].coc[indices[from]];
        }
        return largestDeterminant(triangle, plan_->coc.aspect) <= 0;
    }

    const FramePlan* plan_;
    const ObjectPlan* object_;
    std::vector<ClipVertices> moments_;
    double share_;
};

}  // namespace

Image sweptWork(const FramePlan& plan, const World& world) {
    RectangleSums sums(plan.view.width, plan.view.height);
    const Scene& scene = *world.scene;
    for (const ObjectPlan& object : plan.objects)
        for (const LevelDraw& draw : {object.coarse, object.fine}) {
            if (draw.sampleCount == 0) continue;
            const LevelSweep sweep(plan, world, object, draw);
            const Pyramid& pyramid = world.pyramids[static_cast<std::size_t>(object.mesh)];
            const PyramidLevel& level = pyramid.levels[draw.level];
            for (std::size_t p = 0; p < level.primitives.size(); ++p) {
                const int material = scene.meshes[static_cast<std::size_t>(object.mesh)].primitives[p].material;
                const bool oneSided = material < 0 || !scene.materials[static_cast<std::size_t>(material)].doubleSided;
                const IndexRange& range = level.primitives[p];
                for (std::uint32_t i = range.first; i < range.first + range.count; i += 3)
                    sweep.addTo(sums, &pyramid.indices[i], oneSided);
            }
        }
    return sums.image();
}

Image sweptWorkColourMap(const Image& work) {
    Image shares = work;
    for (float& value : shares.pixels) value = std::log2(1 + value) / std::log2(1 + maxShownSweptWork);
    return colourMapped(shares);
}

}  // namespace defocus::engine
