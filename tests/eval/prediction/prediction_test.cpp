#include "eval/prediction/prediction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "eval/prediction/text.h"

namespace defocus::engine {
namespace {

TEST(Prediction, tableAndJsonTellTheSame) {
    const PredictionRow samples{"Ball", 4, 0, 100, 0.3, 0.2, true};
    const PredictionRow near{"Ball", 4, 1, 50, 0.1, 0.2, true};
    const PredictionRow far{"Ball", 4, 2, 25, 0.1, 0.3, true};
    const PredictionRow unused{"Ball", 4, 3, 12, 0.1, 0.9, false};
    EXPECT_TRUE(near.withinTwo());
    EXPECT_FALSE(far.withinTwo());
    const std::vector rows{samples, near, far, unused};
    const std::string summary = predictionSummary(rows);
    EXPECT_NE(summary.find("1 of the 2 levels"), std::string::npos) << summary;
    EXPECT_NE(summary.find("largest factor is 3.00"), std::string::npos) << summary;
    EXPECT_NE(predictionLine(far).find("beyond 2"), std::string::npos);
    EXPECT_NE(predictionLine(unused).find("not used"), std::string::npos);
    const auto json = nlohmann::json::parse(predictionJson(rows, {}));
    ASSERT_EQ(json["rows"].size(), rows.size());
    EXPECT_EQ(json["rows"][2]["rendered"], 0.3);
    const std::string csv = predictionCsv(rows);
    EXPECT_EQ(std::ranges::count(csv, '\n'), 5);
}

}  // namespace
}  // namespace defocus::engine
