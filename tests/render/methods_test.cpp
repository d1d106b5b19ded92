#include "render/methods.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace defocus::engine {
namespace {

const std::vector<MethodSetting> known = {
    {.name = "taps", .defaultValue = "8", .description = "", .choices = {}, .min = 8, .max = 64},
    {.name = "coc", .defaultValue = "published", .description = "", .choices = {"published", "thin-lens"}},
    {.name = "bias", .defaultValue = "1", .description = "", .choices = {}, .min = 0, .max = 4, .integer = false},
};

std::string faultOf(const MethodSettings& given) {
    try {
        completeSettings("m", known, given);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(MethodSettings, whatIsNotSaidIsStandard) {
    const MethodSettings settings = completeSettings("m", known, {{"coc", "thin-lens"}});
    EXPECT_EQ(settings.at("coc"), "thin-lens");
    EXPECT_EQ(numberOf(settings, "taps"), 8);
    EXPECT_EQ(settingsText(known, settings), "coc=thin-lens");
}

TEST(MethodSettings, faultsNameTheMethodAndWhatItTakes) {
    EXPECT_EQ(faultOf({{"tap", "9"}}), "method m has no setting 'tap'; it has: taps, coc, bias");
    EXPECT_EQ(faultOf({{"coc", "x"}}), "method m: coc must be one of published, thin-lens, not 'x'");
    EXPECT_EQ(faultOf({{"taps", "7"}}), "method m: taps must be an integer from 8 to 64, not '7'");
    for (const char* bad : {"8.5", "", "nan", "inf", "8x", "1e9"}) EXPECT_NE(faultOf({{"taps", bad}}), "") << bad;
    EXPECT_EQ(faultOf({{"bias", "0.5"}}), "");
}

TEST(MethodSettings, methodsAreReadAsTheyAreWritten) {
    registerMethod({.name = "settings-test", .description = "", .settings = known, .make = {}});
    for (const char* text : {"settings-test", "settings-test:taps=16", "settings-test:taps=16,coc=thin-lens"})
        EXPECT_EQ(parseMethodUse(text).text(), text);
    EXPECT_EQ(parseMethodUse("accumulation").text(), "accumulation");
    for (const char* bad : {"settings-test:", "settings-test:taps", "settings-test:taps=16,", "accumulation:x=1", ""})
        EXPECT_THROW(parseMethodUse(bad), Error) << bad;
}

}  // namespace
}  // namespace defocus::engine
