// Tests that every case of the stability benchmark stays within its limit.

#include <gtest/gtest.h>

#include <cmath>

#include "gl/context.h"
#include "render/methods.h"
#include "stability/lens_honesty.h"
#include "stability/stability.h"
#include "stability/text.h"

namespace defocus::engine {
namespace {

TEST(Stability, everyCaseStaysWithinItsLimit) {
    const auto context = createHeadlessContext();
    int count = 0;
    measureStability([&](const StabilityRow& row) {
        EXPECT_TRUE(!row.failed()) << row.subject.area << ": " << row.subject.name << ": " << row.subject.measured
                                   << " is " << row.error << ", at most " << row.subject.limit;
        ++count;
    });
    EXPECT_GT(count, 75);
}

TEST(Stability, notANumberFails) {
    EXPECT_TRUE((StabilityRow{{}, std::nan("")}).failed());
}

TEST(LensHonesty, theAccumulationFollowsTheLens) {
    const auto context = createHeadlessContext();
    int count = 0;
    measureHonesty({"accumulation"}, [&](const HonestyRow& row) {
        if (row.varied == "16 samples") return;
        EXPECT_NEAR(row.measured, row.expected, 0.5) << row.varied;
        EXPECT_NEAR(row.energy, 1, 0.005) << row.varied;
        ++count;
    });
    EXPECT_GT(count, 10);
}

// All methods that honestyMethods() lists can be created. An entry of the list changes one setting of a method,
// together with any other setting that it requires.
TEST(LensHonesty, everyMethodThatItNamesCanBeMade) {
    const auto context = createHeadlessContext();
    World world;
    world.scene = std::make_shared<const Scene>();
    for (const std::string& name : honestyMethods()) {
        const MethodUse use = parseMethodUse(name);
        const RendererOptions options{.settings = use.settings};
        EXPECT_NO_THROW(use.method->make(world, options)) << name;
    }
}

// Method "line" may need more segments of lens lines than the driver's shared memory can hold, as on llvmpipe. The
// benchmark then reports the method as left out and continues with the next method.
TEST(LensHonesty, whatADriverCannotDrawIsLeftOut) {
    const auto context = createHeadlessContext();
    std::vector<HonestyRow> rows;
    measureHonesty({"line:resolve=published,segments=64", "circular"},
                   [&](const HonestyRow& row) { rows.push_back(row); });
    ASSERT_FALSE(rows.empty());
    EXPECT_TRUE(rows.front().leftOut.empty() || rows[1].method == "circular");
    EXPECT_TRUE(rows.back().leftOut.empty());
    EXPECT_EQ(rows.back().method, "circular");
    if (!rows.front().leftOut.empty()) {
        EXPECT_NE(honestySummary(rows).find("left out: " + rows.front().leftOut), std::string::npos);
    }
}

}  // namespace
}  // namespace defocus::engine
