#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "core/error.h"
#include "view/document/kept_files.h"

namespace defocus::engine {
namespace {

class ViewSettingsFile : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "defocus-settings-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    void store(const char* text) const { std::ofstream(path()) << text; }
    [[nodiscard]] std::filesystem::path path() const { return folder_ / "view.json"; }

    std::filesystem::path folder_;
};

TEST_F(ViewSettingsFile, comeBackAsTheyWere) {
    const std::filesystem::path deeper = folder_ / "not" / "there yet" / "view.json";
    writeViewSettings(deeper, {false, false, 1.5, 33.0, 1400, 900});
    const ViewSettings settings = readViewSettings(deeper);
    EXPECT_FALSE(settings.dark);
    EXPECT_FALSE(settings.panel);
    EXPECT_EQ(settings.interfaceScale, 1.5);
    EXPECT_EQ(settings.budgetMilliseconds, 33);
    EXPECT_EQ(settings.width, 1400);
    EXPECT_EQ(settings.height, 900);
}

TEST_F(ViewSettingsFile, valuesWithoutSenseAreTheStandardOnes) {
    store(
        R"({"dark": 3, "interfaceScale": 900, "budgetMilliseconds": "fast", "width": -4, "height": 1e99, "more": []})");
    const ViewSettings settings = readViewSettings(path());
    EXPECT_TRUE(settings.dark);
    EXPECT_EQ(settings.interfaceScale, 1);
    EXPECT_FALSE(settings.budgetMilliseconds);
    EXPECT_EQ(settings.width, 0);
    EXPECT_EQ(settings.height, 0);
}

TEST_F(ViewSettingsFile, noFileIsFineAndNoJsonIsAFault) {
    EXPECT_TRUE(readViewSettings(path()).dark);
    EXPECT_TRUE(readViewSettings({}).dark);
    for (const char* text : {"", "{", "[]", "3"}) {
        store(text);
        EXPECT_THROW(readViewSettings(path()), Error) << text;
    }
}

}  // namespace
}  // namespace defocus::engine
