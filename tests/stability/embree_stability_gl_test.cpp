// Tests those cases of the stability benchmark whose reference is the ray tracer, in builds with Embree.

#include <gtest/gtest.h>

#include <algorithm>

#include "embree/embree_renderer.h"
#include "gl/context.h"
#include "stability/lens_honesty.h"
#include "stability/stability.h"

namespace defocus::engine {
namespace {

TEST(EmbreeStability, extremesAreWhatTheRayTracerSees) {
    registerEmbree();
    const auto context = createHeadlessContext();
    int count = 0;
    for (const StabilityCase& subject : stabilityCases()) {
        if (subject.method.empty()) continue;
        EXPECT_LE(subject.error(), subject.limit) << subject.name;
        ++count;
    }
    EXPECT_GE(count, 7);
}

TEST(EmbreeStability, lensHonestyHasTheRayTracers) {
    registerEmbree();
    const std::vector<std::string> uses = honestyMethods();
    for (const char* use : {"embree", "embree-shared", "embree-planned"})
        EXPECT_EQ(std::ranges::count(uses, use), 1) << use;
}

}  // namespace
}  // namespace defocus::engine
