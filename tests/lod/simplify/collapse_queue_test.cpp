#include "lod/simplify/collapse_queue.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace defocus::engine {
namespace {

VertexHandle vertex(int number) {
    return VertexHandle(number);
}

// Empties the queue and returns the vertex indices in the order in which they leave the queue.
std::vector<int> emptied(CollapseQueue& queue) {
    std::vector<int> order;
    while (!queue.empty()) order.push_back(queue.takeBest().idx());
    return order;
}

TEST(CollapseQueue, cheapestComesFirst) {
    CollapseQueue queue;
    queue.reset(4);
    queue.put(vertex(0), 3, false);
    queue.put(vertex(1), 0.5f, false);
    queue.put(vertex(2), 0, false);
    queue.put(vertex(3), 1e-30f, false);
    EXPECT_EQ(queue.best(), vertex(2));
    EXPECT_EQ(emptied(queue), (std::vector<int>{2, 3, 1, 0}));
}

TEST(CollapseQueue, tiesGoByNumber) {
    CollapseQueue queue;
    queue.reset(12);
    for (const int v : {7, 3, 11, 0, 5, 9}) queue.put(vertex(v), 1, false);
    EXPECT_EQ(emptied(queue), (std::vector<int>{0, 3, 5, 7, 9, 11}));
}

TEST(CollapseQueue, badOnesComeAfterAllOthers) {
    CollapseQueue queue;
    queue.reset(3);
    queue.put(vertex(0), 0, true);
    queue.put(vertex(1), 1e30f, false);
    queue.put(vertex(2), 1, true);
    EXPECT_EQ(emptied(queue), (std::vector<int>{1, 0, 2}));
}

TEST(CollapseQueue, negativeCostCountsAsNone) {
    CollapseQueue queue;
    queue.reset(2);
    queue.put(vertex(1), -1, false);
    queue.put(vertex(0), 0, false);
    EXPECT_EQ(emptied(queue), (std::vector<int>{0, 1}));
}

TEST(CollapseQueue, aVertexWaitsOnceWithItsLastCost) {
    CollapseQueue queue;
    queue.reset(3);
    queue.put(vertex(0), 1, false);
    queue.put(vertex(1), 2, false);
    queue.put(vertex(2), 3, false);
    queue.put(vertex(2), 0.5f, false);  // vertex 2 is now the cheapest instead of the most expensive
    EXPECT_EQ(queue.best(), vertex(2));
    queue.put(vertex(2), 1.5f, false);  // vertex 2 is now more expensive than vertex 0 and cheaper than vertex 1
    queue.put(vertex(0), 1, true);      // vertex 0 is the cheapest, but its collapse is marked as bad
    EXPECT_EQ(emptied(queue), (std::vector<int>{2, 1, 0}));
}

TEST(CollapseQueue, whatIsTakenWaitsNoMore) {
    CollapseQueue queue;
    queue.reset(5);
    for (int v = 0; v < 5; ++v) queue.put(vertex(v), static_cast<float>(v), false);
    queue.take(vertex(0));
    queue.take(vertex(3));
    queue.take(vertex(3));  // no effect: the vertex has already left the queue
    EXPECT_EQ(emptied(queue), (std::vector<int>{1, 2, 4}));
    queue.take(vertex(1));
    EXPECT_TRUE(queue.empty());
    queue.put(vertex(4), 1, false);
    queue.reset(5);
    EXPECT_TRUE(queue.empty());
}

// After thousands of random steps, the queue equals a sorted set of the vertices that are in the queue.
TEST(CollapseQueue, agreesWithASortedSet) {
    constexpr std::uint32_t count = 300;
    using Entry = std::tuple<bool, float, int>;
    CollapseQueue queue;
    queue.reset(count);
    std::set<Entry> sorted;
    std::vector<std::set<Entry>::iterator> places(count, sorted.end());
    std::uint32_t state = 1;
    const auto random = [&](std::uint32_t below) {
        state = state * 1664525 + 1013904223;
        return (state >> 8) % below;
    };
    for (int step = 0; step < 20'000; ++step) {
        const std::uint32_t v = random(count);
        const std::uint32_t action = random(8);
        if (action < 5) {
            const auto cost = static_cast<float>(random(40));
            const bool bad = random(4) == 0;
            queue.put(vertex(static_cast<int>(v)), cost, bad);
            if (places[v] != sorted.end()) sorted.erase(places[v]);
            places[v] = sorted.insert({bad, cost, static_cast<int>(v)}).first;
        } else if (action == 5) {
            queue.take(vertex(static_cast<int>(v)));
            if (places[v] != sorted.end()) sorted.erase(places[v]);
            places[v] = sorted.end();
        } else if (!sorted.empty()) {
            const int best = std::get<int>(*sorted.begin());
            ASSERT_EQ(queue.takeBest(), vertex(best)) << "step " << step;
            places[static_cast<std::size_t>(best)] = sorted.end();
            sorted.erase(sorted.begin());
        }
        ASSERT_EQ(queue.empty(), sorted.empty());
    }
}

}  // namespace
}  // namespace defocus::engine
