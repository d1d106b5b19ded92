#include "eval/csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace defocus::engine {
namespace {

using nlohmann::ordered_json;

TEST(Csv, eachValueHasAColumn) {
    const ordered_json rows = {{{"name", "first"}, {"time", {{"median", 1.5}, {"high", 2}}}, {"error", nullptr}},
                               {{"name", "second"}, {"error", {{"flip", 0.25}}}, {"passed", true}}};
    EXPECT_EQ(csvText(rows),
              "name,time.median,time.high,error.flip,passed\n"
              "first,1.5,2,,\n"
              "second,,,0.25,1\n");
}

TEST(Csv, nanAndInfinityAreEmptyFields) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const ordered_json rows = {{{"psnr", infinity}, {"flip", 0.5}, {"ssim", std::nan("")}},
                               {{"psnr", 40.5}, {"flip", -infinity}, {"ssim", 1}}};
    EXPECT_EQ(csvText(rows), "psnr,flip,ssim\n,0.5,\n40.5,,1\n");
}

// RFC 4180, section 2, rules 6 and 7.
TEST(Csv, textWithSeparatorsIsQuoted) {
    const ordered_json rows = {{{"fault", "no \"ring\", no blades\nat all"}, {"samples", 8}}};
    EXPECT_EQ(csvText(rows), "fault,samples\n\"no \"\"ring\"\", no blades\nat all\",8\n");
}

TEST(Csv, nothingGivesAnEmptyHeader) {
    EXPECT_EQ(csvText(ordered_json::array()), "\n");
}

}  // namespace
}  // namespace defocus::engine
