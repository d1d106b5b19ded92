#pragma once
// Holds the pyramids of a scene's meshes. Copies share the pyramids, so that copying a World (plan/view.h) is cheap.

#include <initializer_list>
#include <memory>
#include <ranges>
#include <utility>
#include <vector>

#include "lod/pyramid/pyramid.h"

namespace defocus::engine {

class SharedPyramids {
public:
    SharedPyramids() = default;
    // These constructors convert implicitly, so that a list of pyramids can be assigned.
    SharedPyramids(std::vector<Pyramid>&& pyramids) {
        for (Pyramid& pyramid : pyramids) push_back(std::move(pyramid));
    }
    SharedPyramids(std::initializer_list<Pyramid> pyramids) {
        for (const Pyramid& pyramid : pyramids) push_back(pyramid);
    }

    [[nodiscard]] std::size_t size() const { return pyramids_.size(); }
    [[nodiscard]] bool empty() const { return pyramids_.empty(); }
    // Returns the pyramid of a mesh.
    const Pyramid& operator[](std::size_t mesh) const { return *pyramids_[mesh]; }
    [[nodiscard]] const Pyramid& front() const { return *pyramids_.front(); }
    [[nodiscard]] const Pyramid& back() const { return *pyramids_.back(); }
    // Returns all pyramids, for a loop.
    [[nodiscard]] auto all() const {
        return pyramids_ | std::views::transform([](const auto& pyramid) -> const Pyramid& { return *pyramid; });
    }

    void push_back(Pyramid pyramid) { pyramids_.push_back(std::make_shared<const Pyramid>(std::move(pyramid))); }
    // Replaces the pyramid of a mesh; other copies of this object keep the previous one. `mesh` must be less than
    // size(). Threads may replace the pyramids of different meshes at the same time.
    void replace(std::size_t mesh, Pyramid pyramid) {
        pyramids_[mesh] = std::make_shared<const Pyramid>(std::move(pyramid));
    }
    // Removes pyramids from the end, or adds meshes whose pyramids must then be set with replace().
    void resize(std::size_t size) { pyramids_.resize(size); }

    // Returns whether both objects share the same pyramids.
    bool operator==(const SharedPyramids&) const = default;

private:
    std::vector<std::shared_ptr<const Pyramid>> pyramids_;
};

}  // namespace defocus::engine
