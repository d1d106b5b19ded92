// Every setting that a command offers has an effect: the command prints, draws or measures something else with it. A
// setting without a case fails the test, and so does one without an effect. every_own_option_gl_slow_test.cpp covers
// the options that belong to single commands; tests/view covers the window.

#include <functional>

#include "cli/option_test.h"

namespace defocus::engine {
namespace {

using nlohmann::json;
using Folder = std::filesystem::path;

// A command, and the function that extracts its observable output.
struct Watched {
    CommandLine line;
    std::function<std::string(const Folder& folder, const Outcome& outcome)> seen;
};

std::string said(const Folder&, const Outcome& outcome) {
    return outcome.out;
}

// Output of pyramid without the times of the levels.
std::string saidOfPyramids(const Folder&, const Outcome& outcome) {
    return withoutTimes(json::parse(outcome.out)).dump();
}

// Returns "limited " for the memory limit of option_cases.h. Any other limit depends on the machine's free memory.
std::string seenOfLimit(const json& limit) {
    return limit == std::uint64_t{3} << 30 ? "limited " : "";
}

std::string seenOfRender(const Folder& folder, const Outcome&) {
    const json stats = jsonIn(folder / "stats.json");
    std::string text = pixelsIn(folder / "a.exr") + pixelsIn(folder / "a.png") + seenOfLimit(stats.at("memoryLimit"));
    for (const char* key : {"wave", "layerFormat", "trianglesFacingAway", "trianglesOutside", "samples"})
        text += stats.at(key).dump() + " ";
    return text;
}

std::string seenOfCapture(const Folder& folder, const Outcome&) {
    json times = jsonIn(folder / "timings.jsonl");
    const std::string limit = seenOfLimit(times.at("memoryLimit"));
    times.erase("memoryLimit");
    return pixelsIn(folder / "0.exr") + pixelsIn(folder / "0.png") + limit + withoutTimes(times).dump();
}

std::string rowsOf(const Folder& folder, const char* file, const Words& lists) {
    const json result = jsonIn(folder / "result" / file);
    std::string text;
    for (const std::string& list : lists) text += withoutTimes(result.at(list)).dump();
    return text;
}

const std::vector<Watched>& watched() {
    static const std::vector<Watched> commands = {
        {{.name = "plan", .command = {"plan"}, .rest = {"--json"}}, said},
        {{.name = "render",
          .command = {"render"},
          .rest = {"--samples", "4", "-o", "a.exr", "-o", "a.png", "--stats", "stats.json"}},
         seenOfRender},
        {{.name = "capture",
          .command = {"capture"},
          .ball = {"ball.json"},
          .fish = {"fish.json"},
          .rest = {"--samples", "4", "-o", "#.exr", "-o", "#.png"}},
         seenOfCapture},
        {{.name = "info", .command = {"info", "--camera=Near"}, .rest = {"--json"}}, said},
        {{.name = "pyramid", .command = {"pyramid"}, .size = "", .rest = {"--no-measure", "--json"}}, saidOfPyramids},
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
    // Each line runs once, however many options are compared with it.
    const std::string& seenOf(const Watched& command, const Words& line) {
        const auto known = seen_.find(line);
        return known != seen_.end() ? known->second : seen_.emplace(line, seenAnew(command, line)).first->second;
    }

    std::string seenAnew(const Watched& command, const Words& line) const {
        for (const char* made : {"kept", "result"}) std::filesystem::remove_all(folder() / made);
        std::filesystem::remove_all(cacheFolder());
        const Outcome outcome = run(line);
        EXPECT_EQ(outcome.exitCode, 0) << shownLine(line) << "\n" << outcome.err;
        if (outcome.exitCode != 0) return outcome.err;
        return command.seen(folder(), outcome) + (std::filesystem::exists(cacheFolder()) ? "cache " : "") +
               (std::filesystem::exists(folder() / "kept") ? "kept " : "");
    }

    void expectActs(const Watched& command, const std::string& name, const OptionCase& tried) {
        const Words line = lineOfCase(command.line, name, tried, true);
        const std::string& without = seenOf(command, lineOfCase(command.line, name, tried, false));
        EXPECT_TRUE(without != seenOf(command, line)) << name << " changes nothing in " << shownLine(line);
    }

private:
    std::map<Words, std::string> seen_;
};

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

TEST_P(EverySetting, acts) {
    const auto& [command, group] = GetParam();
    for (const Setting* setting : settingsOffered(command->line.name, group)) {
        // The time limit ends a film between two frames (capture_gl_test.cpp); this shot has one frame.
        if (setting->name == "timeLimit" && command->line.name == "capture") continue;
        expectActs(*command, setting->name, settingCases().at(setting->name));
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

TEST_P(EveryMethodSetting, acts) {
    for (const std::string& name : methodSettingsOffered(GetParam()->line.name))
        expectActs(*GetParam(), name, methodSettingCases().at(name));
}

INSTANTIATE_TEST_SUITE_P(Of, EveryMethodSetting, testing::ValuesIn(watchedThat([](const Watched& command) {
                             return !methodSettingsOffered(command.line.name).empty();
                         })),
                         [](const auto& each) { return lettersOf(each.param->line.name); });

class EveryCommand : public EveryOption, public testing::WithParamInterface<const Watched*> {};

// Without repeatable output, a difference would prove nothing.
TEST_P(EveryCommand, saysTheSameAgain) {
    const Words line = lineOfCase(GetParam()->line, "", {}, false);
    EXPECT_TRUE(seenAnew(*GetParam(), line) == seenAnew(*GetParam(), line)) << GetParam()->line.name;
}

INSTANTIATE_TEST_SUITE_P(Of, EveryCommand, testing::ValuesIn(watchedThat([](const Watched&) { return true; })),
                         [](const auto& each) { return lettersOf(each.param->line.name); });

// The cache commands have no picture to compare, so their output must name the cache folder.
TEST_F(EveryOption, cacheFolderIsNamed) {
    for (const Words& line : std::vector<Words>{{"cache", "list", "--cache-dir", "kept"},
                                                {"cache", "clear", "--cache-dir", "kept"},
                                                {"cache", "--cache-dir", "kept", "list"}})
        EXPECT_NE(run(line).out.find("kept"), std::string::npos) << shownLine(line);
}

}  // namespace
}  // namespace defocus::engine
