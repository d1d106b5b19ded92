#include "stability/text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "render/methods.h"

namespace defocus::engine {
namespace {

TEST(StabilityText, everyLineFitsIntoAHundredColumns) {
    const std::vector<StabilityCase> cases = stabilityCases();
    std::set<std::string> names;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const StabilityRow row{cases[i], -1.2345e-10};
        const StabilityRow before{cases[i == 0 ? 0 : i - 1]};
        std::istringstream lines(stabilityLine(row, i == 0 ? nullptr : &before));
        for (std::string line; std::getline(lines, line);) {
            // Counts code points of the UTF-8 text, not bytes.
            const auto columns = std::ranges::count_if(line, [](char c) { return (c & 0xc0) != 0x80; });
            EXPECT_LE(columns, 100) << line;
        }
        EXPECT_TRUE(names.insert(cases[i].name + cases[i].measured).second) << cases[i].name;
    }
}

TEST(StabilityText, aHeadingStandsWhereSomethingElseIsMeasured) {
    const StabilityRow first{{"lens", "a", "place, px", "closed form", 1, {}}, 0.5};
    StabilityRow second{{"lens", "b", "place, px", "closed form", 1, {}}, 2};
    EXPECT_NE(stabilityLine(first, nullptr).find("lens: place, px; against closed form"), std::string::npos);
    EXPECT_EQ(stabilityLine(second, &first).find("lens"), std::string::npos);
    EXPECT_NE(stabilityLine(second, &first).find("FAILED"), std::string::npos);
    second.subject.measured = "RMSE";
    EXPECT_NE(stabilityLine(second, &first).find("lens: RMSE; against closed form"), std::string::npos);
}

TEST(StabilityText, whatIsLeftOutNeitherPassesNorFails) {
    const StabilityRow row{{"traced", "a", "RMSE", "ray tracer", 1, {}, "embree-planned"}, std::nan(""), true};
    EXPECT_FALSE(row.failed());
    EXPECT_NE(stabilityLine(row, nullptr).find("left out"), std::string::npos);
    const std::string json = stabilityJson({&row, 1}, {}, {});
    EXPECT_NE(json.find("\"leftOut\": true"), std::string::npos) << json;
    EXPECT_NE(json.find("\"passed\": false"), std::string::npos) << json;
}

TEST(StabilityText, theSummaryHasTheWorstOfEachMethod) {
    const std::vector<HonestyRow> rows = {
        {"a", "one", 10, 10.25, 1}, {"a", "two", 10, 9.5, 0.75}, {"a:b=c", "one", 10, 12, 1}};
    const std::string text = honestySummary(rows);
    EXPECT_NE(text.find("-0.50"), std::string::npos) << text;
    EXPECT_NE(text.find("0.750 to 1.000"), std::string::npos) << text;
    EXPECT_NE(text.find("1 of 2"), std::string::npos) << text;
    EXPECT_NE(text.find("0 of 1"), std::string::npos) << text;
}

TEST(LensHonesty, everySettingOfEveryMethodIsTriedAtItsOtherChoices) {
    const std::vector<std::string> uses = honestyMethods();
    for (const char* use : {"accumulation", "scheuermann", "scheuermann:coc=thin-lens", "scheuermann:max-coc=unlimited",
                            "circular:resolution=half", "circular:resolution=quarter", "circular:kernel-taps=eight"})
        EXPECT_EQ(std::ranges::count(uses, use), 1) << use;
    for (const std::string& use : uses) EXPECT_EQ(parseMethodUse(use).text(), use);
}

}  // namespace
}  // namespace defocus::engine
