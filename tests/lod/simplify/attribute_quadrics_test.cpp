#include "lod/simplify/attribute_quadrics.h"

#include <gtest/gtest.h>

#include <random>

namespace defocus::engine {
namespace {

using SparseRow = AttributeRow<3>;

class BothForms : public testing::Test {
protected:
    static constexpr std::size_t count = 60;

    BothForms() : sparse_(changing()), dense_(count) {
        for (std::uint32_t w = 0; w + 2 < count; ++w) {
            AttributeQuadric<3> face;
            AttributeGradients<3> gradients{};
            if (w % 5 == 0)
                for (std::size_t j = 0; j < 3; ++j) gradients.x[j] = value(), gradients.y[j] = value();
            face.addFace(gradients, 1 + value());
            for (std::uint32_t k = 0; k < 3; ++k) {
                dense_.addFace({w + k}, face);
                sparse_.addFace({w + k}, face);
            }
        }
    }

    // Returns a mask that is true for the wedges (vertices with attributes) at the corners of every fifth face.
    static std::vector<bool> changing() {
        std::vector<bool> result(count, false);
        for (std::size_t w = 0; w + 2 < count; w += 5)
            for (std::size_t k = 0; k < 3; ++k) result[w + k] = true;
        return result;
    }

    float value() { return std::uniform_real_distribution<float>(-0.5f, 0.5f)(random_); }
    SparseRow row() { return {value(), value(), value()}; }
    glm::vec3 step() { return {value(), value(), value()}; }

    void expectTheSame(std::size_t wedges) {
        for (std::uint32_t w = 0; w < wedges; ++w) {
            const glm::vec3 away = step();
            const SparseRow change = row();
            EXPECT_EQ(sparse_[{w}].at(away, change), dense_[{w}].at(away, change)) << w;
            EXPECT_EQ(sparse_.costInPlace({w}), dense_.costInPlace({w})) << w;
            EXPECT_EQ(sparse_[{w}].squares.weight, dense_[{w}].squares.weight) << w;
        }
    }

    std::mt19937 random_{7};
    SparseQuadrics<3> sparse_;
    DenseQuadrics<3> dense_;
};

TEST_F(BothForms, holdTheSameFaces) {
    expectTheSame(count);
    EXPECT_GT((sparse_[{0}].at({0.3f, 0.2f, 0}, {0, 0, 0})), 0) << "no face changes";
}

TEST_F(BothForms, stayTheSameWhileQuadricsMoveAndWedgesGo) {
    std::vector<WedgeNumber> left;
    for (std::uint32_t w = 0; w < count; ++w) left.push_back({w});
    while (left.size() > 4) {
        const std::size_t went = left.size();
        for (std::size_t i = 0; i + 1 < left.size(); i += 3) {
            const WedgeNumber from = left[i + 1];
            const WedgeNumber to = left[i];
            const glm::vec3 away = step();
            const SparseRow change = row();
            sparse_.move(from, to, away, change);
            dense_.move(from, to, away, change);
            EXPECT_EQ(sparse_[from].squares.weight, 0);
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        }
        ASSERT_LT(left.size(), went);
        sparse_.keep(left);
        dense_.keep(left);
        for (std::uint32_t w = 0; w < left.size(); ++w) left[w] = {w};
        expectTheSame(left.size());
    }
}

}  // namespace
}  // namespace defocus::engine
