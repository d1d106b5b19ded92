#include "view/widgets/rows.h"

#include <gtest/gtest.h>

namespace defocus::engine {
namespace {

TEST(ViewLensRows, labelsReadAsPhotographersSayThem) {
    EXPECT_EQ(fieldLabel("bladeRotation"), "Blade rotation");
    EXPECT_EQ(fieldLabel("fStop"), "f-stop");
    EXPECT_EQ(fieldLabel("iso"), "ISO");
}

TEST(ViewLensRows, shortTimesAreFractionsOfASecond) {
    EXPECT_EQ(secondsFormat(0.008), "1/125   %.3g s");
    EXPECT_EQ(secondsFormat(1.0 / 48), "1/48   %.3g s");
    EXPECT_EQ(secondsFormat(2), "%.3g s");
    EXPECT_EQ(secondsFormat(0), "%.3g s");
}

}  // namespace
}  // namespace defocus::engine
