#include "lod/pyramid/build_all.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <thread>

#include "core/parallel.h"
#include "lod/pyramid/build_memory.h"

namespace defocus::engine {

namespace {

// Combines the progress of several pyramids, weighted by triangle count, and reports it. Thread-safe.
class PyramidProgress {
public:
    // Keeps references to both arguments, which must outlive this object.
    PyramidProgress(const std::vector<Mesh>& meshes, const Progress& progress)
        : meshes_(meshes),
          progress_(progress),
          shares_(meshes.size(), 0),
          total_(static_cast<double>(trianglesOf(meshes) + meshes.size())) {}

    // Records that the fraction `share`, in [0, 1], of mesh `mesh`'s pyramid is built.
    void reached(std::size_t mesh, double share) {
        if (!progress_) return;
        const std::scoped_lock lock(mutex_);
        reached_ += (share - shares_[mesh]) * static_cast<double>(meshes_[mesh].triangleCount() + 1);
        finished_ += share >= 1 && shares_[mesh] < 1 ? 1 : 0;
        shares_[mesh] = share;
        constexpr std::uint64_t steps = 1000;
        const auto done = static_cast<std::uint64_t>(steps * reached_ / total_);
        report(progress_, "pyramids", finished_ == shares_.size() ? steps : std::min(done, steps - 1), steps);
    }

private:
    const std::vector<Mesh>& meshes_;
    const Progress& progress_;
    std::mutex mutex_;
    std::vector<double> shares_;
    std::size_t finished_ = 0;
    double total_ = 0;    // number of triangles of all meshes, plus one per mesh, so that empty meshes count
    double reached_ = 0;  // work done so far, in the unit of `total_`
};

// Returns the number of helper threads for the pyramid of `mesh`, if several pyramids are built in parallel. The number
// is proportional to the mesh's triangle count. `all` is the total triangle count of all meshes.
std::size_t pyramidHelpers(const Mesh& mesh, std::uint64_t all) {
    const double share =
        static_cast<double>(mesh.triangleCount()) / static_cast<double>(std::max<std::uint64_t>(1, all));
    // Cache the number of hardware threads, because hardware_concurrency() makes a system call.
    static const unsigned available = std::max(1u, std::thread::hardware_concurrency());
    const auto cores = std::llround(share * available);
    return static_cast<std::size_t>(std::max(1ll, cores) - 1);
}

}  // namespace

std::vector<Pyramid> obtainPyramids(const std::vector<Mesh>& meshes, const PyramidOptions& options,
                                    const Progress& progress, const ObtainPyramid& obtain) {
    std::vector<std::size_t> order(meshes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<std::size_t> triangles(meshes.size());
    std::ranges::transform(meshes, triangles.begin(), &Mesh::triangleCount);
    std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return triangles[i]; });
    const bool inParallel = fitsInParallel(meshes, order, options);
    PyramidOptions within = options;
    if (inParallel) within.memoryLimit = 0;

    std::vector<Pyramid> pyramids(meshes.size());
    PyramidProgress steps(meshes, progress);
    const std::uint64_t all = trianglesOf(meshes);
    const auto obtainOne = [&](std::size_t place) {
        const std::size_t mesh = order[place];
        pyramids[mesh] = obtain(mesh, [&] {
            return buildPyramid(meshes[mesh], within, pyramidHelpers(meshes[mesh], all),
                                [&](double share) { steps.reached(mesh, share); });
        });
        steps.reached(mesh, 1);
    };
    if (inParallel)
        parallelFor(order.size(), obtainOne);
    else
        for (std::size_t place = 0; place < order.size(); ++place) obtainOne(place);
    return pyramids;
}

std::vector<Pyramid> buildPyramids(const std::vector<Mesh>& meshes, const PyramidOptions& options,
                                   const Progress& progress) {
    return obtainPyramids(meshes, options, progress,
                          [](std::size_t, const std::function<Pyramid()>& build) { return build(); });
}

}  // namespace defocus::engine
