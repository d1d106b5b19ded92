#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "lod/numbered.h"
#include "lod/pyramid/clusters.h"

namespace defocus::engine {
namespace {

constexpr std::uint32_t max = 64;

struct Soup {
    std::vector<std::uint32_t> corners;
    Numbered<LocalNumber, glm::vec3> positions;
};

GrownClusters grow(const Soup& soup) {
    return growClusters(numbered<Numbered<TriangleCorner, LocalNumber>>(soup.corners), soup.positions, max);
}

// Returns a sheet of n × n unit squares. The half with x ≤ n/2 lies in the plane z = 0, and the rest is folded up by
// 90°.
Soup foldedSheet(std::uint32_t n) {
    Soup sheet;
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x) {
            const auto flat = static_cast<float>(std::min(x, n / 2));
            sheet.positions.emplace_back(flat, static_cast<float>(y), static_cast<float>(x) - flat);
        }
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x;
            const std::uint32_t b = a + n + 1;
            sheet.corners.insert(sheet.corners.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    return sheet;
}

// Expects each triangle to lie in exactly one cluster, and no cluster to exceed the size limit.
void expectPartition(const Soup& soup, const GrownClusters& grown) {
    std::vector<TriangleNumber> sorted = grown.triangles;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted.size(), soup.corners.size() / 3);
    for (std::uint32_t t = 0; t < sorted.size(); ++t) ASSERT_EQ(sorted[t].value, t);
    std::size_t sum = 0;
    for (const std::uint32_t size : grown.sizes) {
        EXPECT_GT(size, 0u);
        EXPECT_LE(size, max);
        sum += size;
    }
    EXPECT_EQ(sum, sorted.size());
}

std::vector<glm::vec3> clusterPoints(const Soup& soup, const GrownClusters& grown, std::size_t begin,
                                     std::uint32_t size) {
    std::vector<glm::vec3> points;
    for (std::size_t t = begin; t < begin + size; ++t)
        for (std::size_t k = 0; k < 3; ++k)
            points.push_back(soup.positions[{soup.corners[3 * indexOf(grown.triangles[t]) + k]}]);
    return points;
}

// 300,000 triangles around one vertex are clustered in reasonable time, since the search examines a bounded number of
// triangles per vertex. Without that bound, the test would take minutes.
TEST(ClusterGrowth, takesHundredsOfThousandsOfTrianglesAtOneVertex) {
    Soup fan;
    Soup point;
    fan.positions.emplace_back(0, 0, 1);
    point.positions.emplace_back(0, 0, 0);
    constexpr std::uint32_t count = 300'000;
    for (std::uint32_t t = 0; t < count; ++t) {
        const double angle = 2 * std::numbers::pi * t / count;
        fan.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
        fan.corners.insert(fan.corners.end(), {0, 1 + t, 1 + (t + 1) % count});
        point.corners.insert(point.corners.end(), {0, 0, 0});
    }
    for (const Soup* soup : {&fan, &point}) {
        const GrownClusters grown = grow(*soup);
        expectPartition(*soup, grown);
        EXPECT_LE(grown.sizes.size(), 1.2 * count / max);
    }
}

TEST(ClusterGrowth, takesEveryTriangleOnceWhateverTheSoup) {
    // The triangle soup has edges with any number of faces, coincident corners, a vertex with very many triangles, and
    // NaN and huge coordinates.
    std::mt19937 random(1);
    Soup soup;
    for (int v = 0; v < 300; ++v) soup.positions.emplace_back(random() % 100, random() % 100, random() % 100);
    soup.positions[{7}].x = std::numeric_limits<float>::quiet_NaN();
    soup.positions[{8}].y = std::numeric_limits<float>::max();
    for (int corner = 0; corner < 3 * 5000; ++corner)
        soup.corners.push_back(corner % 4 == 0 ? 0 : static_cast<std::uint32_t>(random() % 300));
    expectPartition(soup, grow(soup));
    expectPartition({}, grow({}));

    Soup nowhere{{}, Numbered<LocalNumber, glm::vec3>(3, glm::vec3(2))};
    for (int i = 0; i < 200; ++i) nowhere.corners.insert(nowhere.corners.end(), {0, 1, 2});
    expectPartition(nowhere, grow(nowhere));
}

TEST(ClusterGrowth, clustersAreCompactAndDontGoRoundACrease) {
    const Soup sheet = foldedSheet(80);
    const GrownClusters grown = grow(sheet);
    expectPartition(sheet, grown);
    const double fewest = static_cast<double>(grown.triangles.size()) / max;
    EXPECT_LT(static_cast<double>(grown.sizes.size()), 1.1 * fewest);
    std::size_t begin = 0;
    double radii = 0;
    int creased = 0;
    for (const std::uint32_t size : grown.sizes) {
        const std::vector<glm::vec3> points = clusterPoints(sheet, grown, begin, size);
        begin += size;
        glm::vec3 min = points[0];
        glm::vec3 largest = points[0];
        for (const glm::vec3& p : points) {
            min = glm::min(min, p);
            largest = glm::max(largest, p);
        }
        radii += 0.5 * glm::distance(min, largest);
        creased += min.x < 39.5f && largest.z > 0.5f ? 1 : 0;
    }
    // A disk with the area of 64 triangles, the max of a cluster, has a radius of 3.2.
    EXPECT_LT(radii / static_cast<double>(grown.sizes.size()), 2 * 3.2);
    EXPECT_LT(creased, 0.1 * fewest);
}

TEST(ClusterGrowth, theBackOfASheetIsAnotherCluster) {
    Soup sheet = foldedSheet(40);
    const std::size_t front = sheet.corners.size();
    for (std::size_t i = 0; i < front; i += 3)
        sheet.corners.insert(sheet.corners.end(), {sheet.corners[i], sheet.corners[i + 2], sheet.corners[i + 1]});
    const GrownClusters grown = grow(sheet);
    expectPartition(sheet, grown);
    std::size_t begin = 0;
    std::size_t mixed = 0;
    for (const std::uint32_t size : grown.sizes) {
        const auto first = grown.triangles.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto backs =
            std::count_if(first, first + size, [&](TriangleNumber t) { return 3 * indexOf(t) >= front; });
        mixed += backs > 0 && backs < size ? 1 : 0;
        begin += size;
    }
    EXPECT_LT(static_cast<double>(mixed), 0.1 * static_cast<double>(grown.sizes.size()));
}

TEST(ClusterGrowth, looseTrianglesShareClustersWithThoseNearBy) {
    Soup row;
    for (std::uint32_t t = 0; t < 640; ++t) {
        const auto x = static_cast<float>(3 * t);
        for (const glm::vec3& p : {glm::vec3(x, 0, 0), glm::vec3(x + 1, 0, 0), glm::vec3(x, 1, 0)}) {
            row.corners.push_back(static_cast<std::uint32_t>(row.positions.size()));
            row.positions.push_back(p);
        }
    }
    const GrownClusters grown = grow(row);
    expectPartition(row, grown);
    EXPECT_LE(grown.sizes.size(), 20u);
    std::size_t begin = 0;
    for (const std::uint32_t size : grown.sizes) {
        const std::vector<glm::vec3> points = clusterPoints(row, grown, begin, size);
        const auto [min, largest] =
            std::minmax_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
        EXPECT_LE(largest->x - min->x, 3.0f * static_cast<float>(size));
        begin += size;
    }
}

}  // namespace
}  // namespace defocus::engine
