// Tests that completions and the manual page contain every command and option of --help, and that the shells and groff
// accept them.

#include <fmt/ranges.h>

#include "cli/option_cases.h"
#include "cli/options/option_text.h"
#include "cli/program.h"

namespace defocus::engine {
namespace {

namespace fs = std::filesystem;

bool isInstalled(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

class Pages : public ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        for (const char* shell : {"bash", "zsh", "fish"}) {
            const Outcome outcome = run({"completions", shell});
            ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
            std::ofstream(folder() / shell) << outcome.out;
        }
        std::ofstream(folder() / "defocus.1") << run({"man"}).out;
    }

    // Runs a shell command and returns its standard output and standard error.
    [[nodiscard]] std::string said(const std::string& command) const {
        const fs::path out = folder() / "said";
        const std::string line = "cd '" + folder().string() + "' && { " + command + "; } >said 2>&1 </dev/null";
        EXPECT_EQ(std::system(line.c_str()), 0) << command << "\n" << textOf(out);
        return textOf(out);
    }

    // Returns the completions that bash offers for the last word.
    [[nodiscard]] Words offered(const std::string& words) const {
        std::ofstream(folder() / "try") << "source ./bash\nCOMP_WORDS=(" << words
                                        << ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_defocus\n"
                                           "((${#COMPREPLY[@]})) && printf '%s\\n' \"${COMPREPLY[@]}\"\ntrue\n";
        std::istringstream lines(said("bash ./try"));
        Words result;
        for (std::string line; std::getline(lines, line);) result.push_back(line);
        return result;
    }
};

TEST_F(Pages, bashCompletesCommandsOptionsAndValues) {
    EXPECT_EQ(said("bash -n bash"), "");
    EXPECT_EQ(offered("defocus ren"), Words({"render"}));
    EXPECT_EQ(offered("defocus bench spe"), Words({"speedup"}));
    EXPECT_EQ(offered("defocus render --fst"), Words({"--fstop"}));
    EXPECT_EQ(offered("defocus render --qui"), Words({"--quiet"})) << "includes the program's own options";
    EXPECT_EQ(offered("defocus --quiet render --fst"), Words({"--fstop"}));
    EXPECT_EQ(offered("defocus render --lod ''"), Words({"auto", "fractional", "continuous", "nearest", "off"}));
    EXPECT_EQ(offered("defocus render --lod = o"), Words({"off"})) << "bash splits words at =";
    EXPECT_EQ(offered("defocus render --aov depth,c"), Words({"depth,coc"}));
    EXPECT_EQ(offered("defocus render --method circ"), Words({"circular"}));
    EXPECT_EQ(offered("defocus render --fstop ''"), Words()) << "a number";
    EXPECT_EQ(offered("defocus render --shader-dir folder --fst"), Words({"--fstop"}));
    EXPECT_EQ(offered("defocus completions z"), Words({"zsh"}));
    std::ofstream(folder() / "scene.glb") << "";
    EXPECT_EQ(offered("defocus render sce"), Words({"scene.glb"}));
    EXPECT_EQ(offered("defocus render --stats sce"), Words({"scene.glb"}));
    EXPECT_EQ(offered("defocus render --cache-dir sce"), Words()) << "a folder";
    EXPECT_EQ(offered("defocus cache list sce"), Words()) << "takes no file";
    EXPECT_EQ(offered("defocus info --fst"), Words({"--fstop"}));
    EXPECT_EQ(offered("defocus merge --fst"), Words()) << "not an option of this command";
}

TEST_F(Pages, zshCompletesCommandsOptionsAndValues) {
    if (!isInstalled("zsh")) GTEST_SKIP() << "zsh isn't installed";
    EXPECT_EQ(said("zsh -n zsh"), "");
    std::ofstream(folder() / "scene.glb") << "";
    // Types each argument and the tab key into an interactive shell. The key ^T then prints the completed line.
    std::ofstream(folder() / "type") << R"(zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell 'autoload -U compinit; compinit -D -u; source ./zsh
    print-line() { print -r -- $BUFFER >>lines; BUFFER= }
    zle -N print-line; bindkey "^T" print-line; print -n >lines'
until [[ -e lines ]]; do sleep 0.05; done
for line in "$@"; do zpty -w -n shell "$line"$'\t\C-t'; done
until (($(wc -l <lines) == $#)); do sleep 0.05; done
cat lines
)";
    const auto completed = [&](const std::vector<std::string>& lines) {
        return said(fmt::format("timeout 60 zsh -f ./type '{}'", fmt::join(lines, "' '")));
    };
    EXPECT_EQ(completed({"defocus ren", "defocus bench spe", "defocus render --fst", "defocus --quiet render --fst",
                         "defocus render --lod o", "defocus render --lod=o", "defocus render --aov depth,c",
                         "defocus render --stats=sce", "defocus render sce", "defocus merge --fst"}),
              "defocus render \n"
              "defocus bench speedup \n"
              "defocus render --fstop \n"
              "defocus --quiet render --fstop \n"
              "defocus render --lod off \n"
              "defocus render --lod=off \n"
              "defocus render --aov depth,coc \n"
              "defocus render --stats=scene.glb \n"
              "defocus render scene.glb \n"
              "defocus merge --fst\n");
}

TEST_F(Pages, fishCompletesCommandsOptionsAndValues) {
    if (!isInstalled("fish")) GTEST_SKIP() << "fish isn't installed";
    const auto complete = [&](const std::string& line) {
        return said("HOME=$PWD fish --no-config -c \"source ./fish; complete -C '" + line + "'\" | cut -f 1");
    };
    EXPECT_EQ(said("fish --no-execute fish"), "");
    EXPECT_EQ(complete("defocus ren"), "render\n");
    EXPECT_EQ(complete("defocus bench spe"), "speedup\n");
    EXPECT_EQ(complete("defocus render --fst"), "--fstop\n");
    EXPECT_EQ(complete("defocus render --lod o"), "off\n");
    EXPECT_EQ(complete("defocus render --lod=o"), "--lod=off\n");
    EXPECT_EQ(complete("defocus render --aov depth,c"), "depth,coc\n");
    EXPECT_EQ(complete("defocus render --fstop "), "") << "a number";
    std::ofstream(folder() / "scene.glb") << "";
    EXPECT_EQ(complete("defocus render sce"), "scene.glb\n");
    EXPECT_EQ(complete("defocus render --stats=sce"), "--stats=scene.glb\n");
    EXPECT_EQ(complete("defocus merge --fst"), "");
}

TEST_F(Pages, groffTakesTheManualPage) {
    if (!isInstalled("groff")) GTEST_SKIP() << "groff isn't installed";
    EXPECT_EQ(said("groff -k -man -Tutf8 -P -cbou -ww defocus.1 >shown"), "");
    EXPECT_NE(textOf(folder() / "shown").find("EXIT STATUS"), std::string::npos);
}

TEST_F(Pages, allKnowEveryOption) {
    const auto candidates = [&](const char* shell) {
        const std::string script = textOf(folder() / shell);
        const std::size_t begin = script.find("    printf");
        return script.substr(begin, script.find("    }' ") - begin);
    };
    EXPECT_TRUE(candidates("zsh") == candidates("bash"));
    EXPECT_TRUE(candidates("fish") == candidates("bash"));
    std::string manual = textOf(folder() / "defocus.1");
    std::erase(manual, '\\');
    std::size_t options = 0;
    for (const CLI::App* command : allCommands(commandNamed(""))) {
        const Words names = offered("defocus" + pathOf(*command) + " -");
        for (const CLI::Option* option : command->get_options())
            for (const std::string& name : namesOf(*option)) {
                if (option->get_positional()) continue;
                EXPECT_NE(std::ranges::find(names, name), names.end()) << pathOf(*command) << ' ' << name;
                EXPECT_TRUE(std::regex_search(manual, std::regex(name + "(fR|, )"))) << name;
                ++options;
            }
    }
    EXPECT_GT(options, 500u);
}

// --help lists only the common options; --help-all lists all options.
TEST_F(Pages, helpIsShortAndHelpAllIsWhole) {
    const auto optionLines = [](const std::string& help) {
        static const std::regex line("\\n  (-[a-z],)?--[a-z]");
        return std::distance(std::sregex_iterator(help.begin(), help.end(), line), std::sregex_iterator());
    };
    const std::string brief = run({"render", "--help"}).out;
    const std::string full = run({"render", "--help-all"}).out;
    EXPECT_LE(optionLines(brief), 16);
    EXPECT_EQ(static_cast<std::size_t>(optionLines(full)), optionsOffered("render").size() - 1 + 2)
        << "the scene has no dash; --help and --help-all have a line each";
    EXPECT_NE(brief.find("--fstop"), std::string::npos);
    EXPECT_EQ(brief.find("--coc-tolerance"), std::string::npos);
    EXPECT_NE(brief.find("--help-all"), std::string::npos);
    EXPECT_NE(full.find("--coc-tolerance"), std::string::npos);
    for (const char* line : {"--range FIRST:LAST", "--sample-range FIRST:END", "--set /PLACE=VALUE"})
        EXPECT_NE(run({"capture", "--help-all"}).out.find(line), std::string::npos) << line;
}

}  // namespace
}  // namespace defocus::engine
