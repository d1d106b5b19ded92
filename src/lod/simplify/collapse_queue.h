#pragma once
// Implements the priority queue of the vertices to collapse, ordered by cost. Vertices whose collapse is bad (it
// rotates a face's normal by more than 75° or mixes primitives, see simplify.h) come last; equal costs are ordered by
// vertex number. The queue is a 4-ary heap with updates, in which every vertex occurs at most once (Johnson 1975,
// Priority Queues with Update and Finding Minimum Spanning Trees).

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "lod/simplify/surface_mesh.h"

namespace defocus::engine {

class CollapseQueue {
public:
    // Empties the queue and prepares it for vertex numbers below `vertexCount`.
    void reset(std::size_t vertexCount) {
        heap_.clear();
        places_.assign(vertexCount, absent);
    }

    [[nodiscard]] bool empty() const { return heap_.empty(); }

    // Inserts the vertex, or updates its cost (≥ 0) and `bad` if it is present. Vertices with `bad` set come
    // after all others.
    void put(VertexHandle vertex, float cost, bool bad) {
        const std::uint64_t bits = std::bit_cast<std::uint32_t>(std::max(0.0f, cost));
        const std::uint64_t key = std::uint64_t{bad} << 63 | bits << 32 | numberOf(vertex);
        std::uint32_t place = places_[numberOf(vertex)];
        if (place == absent) {
            place = static_cast<std::uint32_t>(heap_.size());
            heap_.push_back(key);
            rise(place, key);
        } else if (key < heap_[place]) {
            rise(place, key);
        } else {
            sink(place, key);
        }
    }

    // Removes the vertex, if present.
    void take(VertexHandle vertex) {
        const std::uint32_t place = places_[numberOf(vertex)];
        if (place == absent) return;
        places_[numberOf(vertex)] = absent;
        const std::uint64_t last = heap_.back();
        heap_.pop_back();
        if (place == heap_.size()) return;
        if (place > 0 && last < heap_[(place - 1) / arity])
            rise(place, last);
        else
            sink(place, last);
    }

    // Returns the vertex to collapse next. The queue must not be empty.
    [[nodiscard]] VertexHandle best() const { return VertexHandle(static_cast<int>(heap_.front() & 0xffffffffu)); }
    VertexHandle takeBest() {
        const VertexHandle vertex = best();
        take(vertex);
        return vertex;
    }

private:
    static constexpr std::uint32_t arity = 4;
    static constexpr std::uint32_t absent = 0xffffffffu;

    static std::uint32_t numberOf(VertexHandle vertex) { return static_cast<std::uint32_t>(vertex.idx()); }

    void set(std::uint32_t place, std::uint64_t key) {
        heap_[place] = key;
        places_[static_cast<std::uint32_t>(key)] = place;
    }

    void rise(std::uint32_t place, std::uint64_t key) {
        while (place > 0) {
            const std::uint32_t parent = (place - 1) / arity;
            if (heap_[parent] < key) break;
            set(place, heap_[parent]);
            place = parent;
        }
        set(place, key);
    }

    void sink(std::uint32_t place, std::uint64_t key) {
        const auto size = static_cast<std::uint32_t>(heap_.size());
        for (;;) {
            const std::uint32_t first = arity * place + 1;
            if (first >= size) break;
            std::uint32_t min = first;
            for (std::uint32_t child = first + 1; child < std::min(first + arity, size); ++child)
                if (heap_[child] < heap_[min]) min = child;
            if (key < heap_[min]) break;
            set(place, heap_[min]);
            place = min;
        }
        set(place, key);
    }

    // Each entry is a 64-bit sort key: 1 bit for a bad collapse, 31 bits of the cost, 32 bits of the vertex number.
    // Float bits of costs ≥ 0 sort like the costs.
    std::vector<std::uint64_t> heap_;
    std::vector<std::uint32_t> places_;  // position of each vertex in the heap
};

}  // namespace defocus::engine
