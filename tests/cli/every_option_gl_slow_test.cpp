// Tests that every setting that a command offers has the effect listed in the table of settings: on the linear image,
// only on PNG and JPEG, or only on time and memory. For commands without an image, the printed text or the measurements
// must change. A setting without a test case (option_cases.h) fails the test. every_own_option_gl_slow_test.cpp covers
// the options that belong to single commands, and tests/view covers the viewer.

#include <functional>

#include "cli/option_test.h"

namespace defocus::engine {
namespace {

using nlohmann::json;
using Folder = std::filesystem::path;

// The observable results of one run of a command.
struct Results {
    std::string pixels;   // values of the linear image; empty for commands that render no image
    std::string display;  // content of the PNG file
    std::string other;    // other output (text, rows or statistics) without times, which differ between runs
    bool operator==(const Results&) const = default;
};

// A command whose results are compared, and the function that reads the results.
struct Watched {
    CommandLine line;
    std::function<Results(const Folder& folder, const Outcome& outcome)> results;
};

Results printed(const Folder&, const Outcome& outcome) {
    return {{}, {}, outcome.out};
}

// Returns the output of `defocus pyramid` without build times.
Results printedPyramids(const Folder&, const Outcome& outcome) {
    return {{}, {}, withoutTimes(json::parse(outcome.out)).dump()};
}

// Returns "limited " for the memory limit that option_cases.h sets, else "". Omits the number, because the default
// limit depends on the free memory and differs between runs.
std::string seenOfLimit(const json& limit) {
    return limit == std::uint64_t{3} << 30 ? "limited " : "";
}

// Returns the channel names that an image's metadata records; empty if none are recorded.
std::string exrNamesIn(const std::filesystem::path& path) {
    Metadata metadata;
    readImage(path, metadata);
    const auto names = metadata.find("defocus:exrNames");
    return names == metadata.end() ? "" : std::get<std::string>(names->second);
}

Results rendered(const Folder& folder, const Outcome&) {
    const json stats = jsonIn(folder / "stats.json");
    std::string text = seenOfLimit(stats.at("memoryLimit"));
    for (const char* key : {"wave", "layerFormat", "trianglesFacingAway", "trianglesOutside", "samples"})
        text += stats.at(key).dump() + " ";
    text += exrNamesIn(folder / "a.exr");
    return {pixelsIn(folder / "a.exr"), pixelsIn(folder / "a.png"), text};
}

Results captured(const Folder& folder, const Outcome&) {
    json times = jsonIn(folder / "timings.jsonl");
    const std::string limit = seenOfLimit(times.at("memoryLimit"));
    times.erase("memoryLimit");
    const std::string names = exrNamesIn(folder / "0.exr");
    return {pixelsIn(folder / "0.exr"), pixelsIn(folder / "0.png"), limit + names + withoutTimes(times).dump()};
}

Results rowsOf(const Folder& folder, const char* file, const Words& lists) {
    const json result = jsonIn(folder / "result" / file);
    std::string text;
    for (const std::string& list : lists) text += withoutTimes(result.at(list)).dump();
    return {{}, {}, text};
}

const std::vector<Watched>& watched() {
    static const std::vector<Watched> commands = {
        {{.name = "plan", .command = {"plan"}, .rest = {"--json"}}, printed},
        {{.name = "render",
          .command = {"render"},
          .rest = {"--samples", "4", "-o", "a.exr", "-o", "a.png", "--stats", "stats.json"}},
         rendered},
        {{.name = "capture",
          .command = {"capture"},
          .ball = {"ball.json"},
          .fish = {"fish.json"},
          .rest = {"--samples", "4", "-o", "#.exr", "-o", "#.png"}},
         captured},
        {{.name = "info", .command = {"info", "--camera=Near"}, .rest = {"--json"}}, printed},
        {{.name = "pyramid", .command = {"pyramid"}, .size = "", .rest = {"--no-measure", "--json"}}, printedPyramids},
        {{.name = "bench speedup",
          .command = {"bench", "speedup"},
          .rest = {"--counts", "16", "--runs", "1", "--reference-samples", "2", "-o", "result", "--allow-changed"}},
         [](const Folder& folder, const Outcome&) { return rowsOf(folder, "speedup.json", {"rows"}); }},
        {{.name = "bench popping",
          .command = {"bench", "popping"},
          .rest = {"--counts", "4", "--frames", "2", "--path-frames", "12", "-o", "result", "--allow-changed"}},
         [](const Folder& folder, const Outcome&) {
             return rowsOf(folder, "popping.json", {"rows", "sampleSteps"});
         }},
        {{.name = "bench convergence",
          .command = {"bench", "convergence"},
          .rest = {"--methods", "accumulation", "--counts", "4", "--threshold-factors", "1", "--runs", "1", "--shading",
                   "lit", "--reference-samples", "8", "-o", "result", "--overwrite", "--allow-changed"}},
         [](const Folder& folder, const Outcome&) { return rowsOf(folder, "results.json", {"rows"}); }},
    };
    return commands;
}

class EveryOption : public OptionTest {
protected:
    // Returns the results of a command line. Runs each command line once, even if several options are compared with it.
    const Results& resultsOf(const Watched& command, const Words& line) {
        const auto known = results_.find(line);
        return known != results_.end() ? known->second
                                       : results_.emplace(line, newResults(command, line)).first->second;
    }

    Results newResults(const Watched& command, const Words& line) const {
        for (const char* made : {"kept", "result"}) std::filesystem::remove_all(folder() / made);
        std::filesystem::remove_all(cacheFolder());
        const Outcome outcome = run(line);
        EXPECT_EQ(outcome.exitCode, 0) << shownLine(line) << "\n" << outcome.err;
        if (outcome.exitCode != 0) return {{}, {}, outcome.err};
        Results results = command.results(folder(), outcome);
        if (std::filesystem::exists(cacheFolder())) results.other += "cache ";
        if (std::filesystem::exists(folder() / "kept")) results.other += "kept ";
        return results;
    }

    void expectEffect(const Watched& command, const std::string& name, const OptionCase& tried, SettingEffect effect) {
        const Words line = lineOfCase(command.line, name, tried, true);
        const Results& without = resultsOf(command, lineOfCase(command.line, name, tried, false));
        const Results& with = resultsOf(command, line);
        const std::string where = name + " in " + shownLine(line);
        if (without.pixels.empty()) {
            EXPECT_TRUE(with != without) << where;
            return;
        }
        EXPECT_EQ(with.pixels != without.pixels, effect == SettingEffect::pixels) << where;
        if (effect == SettingEffect::pixels) return;
        EXPECT_EQ(with.display != without.display, effect == SettingEffect::display) << where;
        EXPECT_TRUE(tried.needsDriver || with != without) << where;
    }

private:
    std::map<Words, Results> results_;
};

// Returns what the setting must change in its test case. The table of settings declares that `preset` and `timeLimit`
// do not change pixels themselves. In their test cases they do: a preset sets other settings, and a time limit reduces
// the number of samples.
SettingEffect effectOf(const Setting& setting) {
    const bool drawsOtherwise = setting.name == "preset" || setting.name == "timeLimit";
    return drawsOtherwise ? SettingEffect::pixels : setting.effect;
}

struct Asked {
    const Watched* command;
    SettingGroup group;
};

std::ostream& operator<<(std::ostream& out, const Asked& asked) {
    return out << asked.command->line.name << ": " << groupTitle(asked.group);
}

std::vector<Asked> settingsAsked() {
    std::vector<Asked> asked;
    for (const Watched& command : watched())
        for (int group = 0; group <= static_cast<int>(SettingGroup::developer); ++group)
            if (!settingsOffered(command.line.name, static_cast<SettingGroup>(group)).empty())
                asked.push_back({&command, static_cast<SettingGroup>(group)});
    return asked;
}

class EverySetting : public EveryOption, public testing::WithParamInterface<Asked> {};

TEST_P(EverySetting, hasItsEffect) {
    const auto& [command, group] = GetParam();
    for (const Setting* setting : settingsOffered(command->line.name, group)) {
        // A time limit ends a capture between two frames (capture_gl_test.cpp), so it has no effect on this shot of one
        // frame.
        if (setting->name == "timeLimit" && command->line.name == "capture") continue;
        // These scenes have no damaged parts, so --strict rejects nothing (load_scene_test.cpp tests it).
        if (setting->name == "strict") continue;
        expectEffect(*command, setting->name, settingCases().at(setting->name), effectOf(*setting));
    }
}

INSTANTIATE_TEST_SUITE_P(Of, EverySetting, testing::ValuesIn(settingsAsked()), [](const auto& each) {
    return lettersOf(each.param.command->line.name) + "_" + lettersOf(groupTitle(each.param.group));
});

std::vector<const Watched*> watchedThat(const std::function<bool(const Watched&)>& matches) {
    std::vector<const Watched*> commands;
    for (const Watched& command : watched())
        if (matches(command)) commands.push_back(&command);
    return commands;
}

class EveryMethodSetting : public EveryOption, public testing::WithParamInterface<const Watched*> {};

TEST_P(EveryMethodSetting, changesThePixels) {
    for (const std::string& name : methodSettingsOffered(GetParam()->line.name))
        expectEffect(*GetParam(), name, methodSettingCases().at(name), SettingEffect::pixels);
}

INSTANTIATE_TEST_SUITE_P(Of, EveryMethodSetting, testing::ValuesIn(watchedThat([](const Watched& command) {
                             return !methodSettingsOffered(command.line.name).empty();
                         })),
                         [](const auto& each) { return lettersOf(each.param->line.name); });

class EveryCommand : public EveryOption, public testing::WithParamInterface<const Watched*> {};

// Each command gives the same results in a second run. Otherwise, a difference between two runs would prove nothing.
TEST_P(EveryCommand, repeatsItsResults) {
    const Words line = lineOfCase(GetParam()->line, "", {}, false);
    EXPECT_TRUE(newResults(*GetParam(), line) == newResults(*GetParam(), line)) << GetParam()->line.name;
}

INSTANTIATE_TEST_SUITE_P(Of, EveryCommand, testing::ValuesIn(watchedThat([](const Watched&) { return true; })),
                         [](const auto& each) { return lettersOf(each.param->line.name); });

// The cache commands print the path of the cache folder, so --cache-dir has a visible effect.
TEST_F(EveryOption, cacheFolderIsNamed) {
    for (const Words& line : std::vector<Words>{{"cache", "list", "--cache-dir", "kept"},
                                                {"cache", "clear", "--cache-dir", "kept"},
                                                {"cache", "--cache-dir", "kept", "list"}})
        EXPECT_NE(run(line).out.find("kept"), std::string::npos) << shownLine(line);
}

}  // namespace
}  // namespace defocus::engine
