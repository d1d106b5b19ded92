// Tests the table of settings: each setting reads the value that it has written and accepts the values in its
// description. Each member of Request has a setting.

#include "frame/settings/settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <regex>
#include <set>
#include <string>

#include "core/error.h"
#include "lens/lens_fields.h"

namespace defocus::engine {
namespace {

// Returns a value that the setting accepts and that differs from the default.
std::string otherValue(const Setting& setting) {
    static const std::map<std::string, std::string> own = {
        {"background", "0.25,0.5,1"},
        {"cameraPosition", "1,2,3"},
        {"cameraTarget", "0,1,-2"},
        {"cameraUp", "1,0,0"},
        {"size", "320x200"},
        {"focusPixel", "3,4"},
        {"focusPoints", "1,2,3,4,5,6"},
        {"nodeBlur", "Fish = 3=0.5"},
        {"motionSegments", "exact"},
        {"exrLayers", "normal,objects"},
        {"method", "circular:far-components=5"},
        {"bladeCount", "7"},
        {"wave", "3"},
        {"memory", "3000000000B"},
        {"threads", "3"},
    };
    if (const auto found = own.find(setting.name); found != own.end()) return found->second;
    switch (setting.kind) {
        case SettingKind::number:
            return std::to_string(setting.min + 0.25 * (std::min(setting.max, setting.min + 4) - setting.min));
        case SettingKind::integer:
            return std::to_string(static_cast<std::uint64_t>(setting.min) + 3);
        case SettingKind::boolean:
            return setting.text(Request{}) == "true" ? "false" : "true";
        case SettingKind::choice:
            return setting.choices[setting.text(Request{}) == setting.choices[0] ? 1 : 0];
        case SettingKind::text:
        case SettingKind::path:
        case SettingKind::other:
            break;
    }
    return "a name";
}

TEST(Settings, namesAndOptionsAreOnesOwn) {
    std::set<std::string> names;
    std::set<std::string> options;
    std::set<std::string> places;
    for (const Setting& setting : settings()) {
        EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
        EXPECT_TRUE(options.insert(setting.option).second) << setting.option;
        EXPECT_TRUE(setting.shotPlace.empty() || places.insert(setting.shotPlace).second) << setting.shotPlace;
        EXPECT_FALSE(setting.help.empty()) << setting.name;
    }
}

TEST(Settings, whatARowWritesItReads) {
    for (const Setting& setting : settings()) {
        SCOPED_TRACE(setting.name);
        Request request;
        setting.set(request, otherValue(setting));
        const std::optional<std::string> text = changedText(setting, request);
        ASSERT_TRUE(text) << "a changed value must be reported";
        Request again;
        if (setting.repeated)
            for (const std::string& each : setting.texts(request)) setting.set(again, each);
        else
            setting.set(again, *text);
        EXPECT_EQ(setting.text(again), text);
        if (setting.name == "preset") continue;  // a preset sets other settings; presets_test.cpp tests it
        for (const Setting& other : settings()) {
            if (other.name == setting.name) continue;
            EXPECT_FALSE(changedText(other, request)) << other.name;
        }
    }
}

TEST(Settings, clearingGoesBackToTheDefault) {
    for (const Setting& setting : settings()) {
        if (setting.repeated || setting.name.starts_with("camera") || setting.name.starts_with("focusP")) continue;
        Request request;
        setting.set(request, otherValue(setting));
        setting.clear(request);
        EXPECT_FALSE(changedText(setting, request)) << setting.name;
    }
}

TEST(Settings, valuesOutOfRangeAreRefusedAndChangeNothing) {
    for (const Setting& setting : settings()) {
        SCOPED_TRACE(setting.name);
        std::vector<std::string> wrong;
        const bool ranged = setting.kind == SettingKind::number || setting.kind == SettingKind::integer;
        if (ranged) {
            wrong = {"nan", "", "1e999", "three", std::to_string(setting.max * 2 + 1)};
            if (setting.min > 0) wrong.emplace_back("0");
        }
        if (setting.kind == SettingKind::boolean) wrong = {"yes", "", "TRUE"};
        if (setting.kind == SettingKind::choice) wrong = {"", "best"};
        for (const std::string& text : wrong) {
            Request request;
            EXPECT_THROW(setting.set(request, text), Error) << "'" << text << "'";
            EXPECT_FALSE(changedText(setting, request)) << text;
        }
    }
}

TEST(Settings, unknownNamesSuggestTheNearest) {
    Request request;
    try {
        setByName(request, "fstop", "2");
        FAIL() << "fstop is not a setting";
    } catch (const UsageError& error) {
        EXPECT_STREQ(error.what(), "there is no setting 'fstop'; did you mean 'fStop'?");
    }
    setByName(request, "farComponents", "5");
    EXPECT_EQ(request.methodSettings.at("far-components"), "5");
    try {
        setByName(request, "samples", "0");
        FAIL() << "zero samples must be refused";
    } catch (const UsageError& error) {
        EXPECT_STREQ(error.what(), "samples: '0' is not an integer from 1 to 65536, or auto");
    }
}

std::string textOf(const std::string& file) {
    std::ifstream stream(std::string(DEFOCUS_SOURCE_DIR) + "/" + file);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// Each member of LensSettings has a row in lens_fields.cpp, and each row has a member.
TEST(Settings, everyLensValueHasItsRow) {
    const std::string header = textOf("include/defocus/lens.h");
    const std::regex member(R"(std::optional<\w+>\s+(\w+);)");
    std::set<std::string> members;
    for (auto match = std::sregex_iterator(header.begin(), header.end(), member); match != std::sregex_iterator();
         ++match)
        members.insert((*match)[1]);
    std::set<std::string> rows;
    for (const LensField& field : lensFields())
        // focusDistance is not a lens setting, since it belongs to Request::focus
        if (field.name != std::string_view("focusDistance")) rows.insert(field.name);
    EXPECT_EQ(members, rows);
}

TEST(Settings, pythonNames) {
    EXPECT_EQ(snakeCase("blurThreshold"), "blur_threshold");
    EXPECT_EQ(snakeCase("fStop"), "f_stop");
    EXPECT_EQ(snakeCase("far-components"), "far_components");
}

}  // namespace
}  // namespace defocus::engine
