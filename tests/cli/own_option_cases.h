#pragma once
// Lists a test case for each option that belongs to only one command. Each case compares two command lines: one with
// the option and one without it. option_cases.h lists the settings of the program and of its methods.

#include "cli/option_cases.h"

namespace defocus::engine {

struct OwnOptionCase {
    Words words;                     // the option with its value
    Words more = {};                 // further options of both command lines
    Words without = {};              // options of usualLines() that both command lines omit
    std::vector<Words> before = {};  // command lines to run before the case
};

// Returns, for each command, arguments with which it runs quickly. If the `words` or `more` of a test case begin with
// an option that is also listed here, the value from the test case replaces the listed one.
inline const std::map<std::string, Words>& usualLines() {
    static const Words ball = {"ball.glb", "--size", "16x12", "--fstop", "0.5"};
    static const Words written = {"-o", "result", "--allow-changed"};
    static const std::map<std::string, Words> table = {
        {"render", joined(ball, {"--samples", "4"})},
        {"capture", {"shot.json"}},
        {"merge", {"a.exr", "b.exr"}},
        {"refocus", {"a.exr"}},
        {"plan", ball},
        {"info", {"ball.glb"}},
        {"pyramid", {"ball.glb"}},
        {"compare", {"one.exr", "two.exr"}},
        {"bench prediction", joined({"ball.glb", "--size", "16x12", "--cocs", "2"}, written)},
        {"bench speedup", joined(joined(ball, {"--counts", "2", "--runs", "1", "--reference-samples", "0"}), written)},
        {"bench popping", joined(joined(ball, {"--counts", "2", "--frames", "2", "--path-frames", "6"}), written)},
        {"bench convergence", joined(joined(ball, {"--methods", "accumulation", "--counts", "2", "--threshold-factors",
                                                   "1", "--runs", "1", "--shading", "lit", "--reference-samples", "4"}),
                                     written)},
        {"new-shot", {"ball.glb", "-o", "made.json"}},
        {"export-camera", {"ball.glb", "-o", "made.usda"}},
        {"completions", {"bash"}},
        {"settings", {}},
    };
    return table;
}

inline Words usualLine(const std::string& command) {
    Words line;
    for (std::size_t begin = 0; begin < command.size();) {
        const std::size_t end = std::min(command.find(' ', begin), command.size());
        line.push_back(command.substr(begin, end - begin));
        begin = end + 1;
    }
    const auto found = usualLines().find(command);
    return found == usualLines().end() ? line : joined(line, found->second);
}

// Removes an option and its values, which are all words up to the next option.
inline Words withoutOption(Words line, const std::string& option) {
    const auto begin = std::ranges::find(line, option);
    if (begin == line.end()) return line;
    line.erase(begin, std::find_if(begin + 1, line.end(), [](const std::string& word) { return word[0] == '-'; }));
    return line;
}

// Returns the command line of a case, with or without its option. If `tried.words` does not begin with an option, it
// contains all arguments of the command, to test a positional argument such as "SHOT".
inline Words lineOfOwnCase(const std::string& command, const OwnOptionCase& tried, bool with) {
    Words line = usualLine(command);
    for (const std::string& option : tried.without) line = withoutOption(line, option);
    line = joined(withoutOption(line, tried.more.empty() ? "" : tried.more.front()), tried.more);
    if (!with) return line;
    if (tried.words.front()[0] == '-') return joined(withoutOption(line, tried.words.front()), tried.words);
    const std::size_t ofCommand = command.empty() ? 0 : 1 + static_cast<std::size_t>(std::ranges::count(command, ' '));
    line.resize(ofCommand);
    return joined(line, tried.words);
}

// Returns the test cases, keyed by command and option, such as "render -o". The keys of options of `defocus` itself,
// without a command, begin with a space.
inline const std::map<std::string, OwnOptionCase>& ownOptionCases() {
    static const Words part = {"render", "ball.glb", "--size", "16x12", "--fstop", "0.5", "--samples", "128"};
    static const std::vector<Words> parts = {joined(part, {"--sample-range", "0:64", "-o", "a.exr"}),
                                             joined(part, {"--sample-range", "64:128", "-o", "b.exr"}),
                                             joined(part, {"--sample-range", "0:128", "-o", "c.exr", "--seed", "4"})};
    static const Words images = {"render", "ball.glb", "--size", "16x12", "--fstop", "0.5", "--focus-distance", "3"};
    static const std::vector<Words> lensImages = {joined(images, {"--focus-range", "0.5:8", "--lens-images", "a.exr"}),
                                                  joined(images, {"--samples", "32", "--lens-images", "b.exr"})};
    static const std::vector<Words> fewImages = {joined(lensImages.front(), {"--samples", "4"})};
    static const std::vector<Words> converged = {usualLine("bench convergence")};
    static const std::map<std::string, OwnOptionCase> table = {
        {"render --output", {.words = {"-o", "other.png"}}},
        {"render --aov", {.words = {"--aov", "depth"}}},
        {"render --sample-range", {.words = {"--sample-range", "0:64"}, .more = {"--samples", "128"}}},
        {"render --tile", {.words = {"--tile", "1/3"}}},
        {"render --resume",
         {.words = {"--resume"},
          .more = {"--tile", "0/2"},
          .before = {{"render", "ball.glb", "--size", "16x12", "--fstop", "0.5", "--samples", "4", "--tile", "0/2"}}}},
        {"render --lens-images", {.words = {"--lens-images", "a.exr"}}},
        {"render --focus-range", {.words = {"--focus-range", "0.1:3"}, .more = {"--lens-images", "a.exr"}}},
        {"render --stats", {.words = {"--stats", "stats.json"}}},

        {"capture SHOT", {.words = {"other.json"}}},
        {"capture --set", {.words = {"--set", "/lens/fStop=0.7"}}},
        {"capture --scene", {.words = {"--scene", "other.glb"}}},
        {"capture --range", {.words = {"--range", "1:2"}}},
        {"capture --frame-rate", {.words = {"--frame-rate", "1"}}},
        {"capture --speed", {.words = {"--speed", "3"}}},
        {"capture --animate-seed", {.words = {"--animate-seed"}}},
        {"capture --output", {.words = {"-o", "film/#.exr"}}},
        {"capture --video", {.words = {"--video", "film.gif"}}},
        {"capture --resume", {.words = {"--resume"}, .before = {{"capture", "shot.json"}}}},
        {"capture --overwrite",
         {.words = {"--overwrite"},
          .more = {"--resume", "--set", "/lens/fStop=0.7"},
          .before = {{"capture", "shot.json"}}}},
        {"capture --shard", {.words = {"--shard", "1/2"}}},
        {"capture --sample-range", {.words = {"--sample-range", "0:64"}, .more = {"--samples", "128"}}},
        {"capture --dry-run", {.words = {"--dry-run"}}},

        {"merge PART", {.words = {"c.exr"}, .before = parts}},
        {"merge --output", {.words = {"-o", "other.exr"}, .before = parts}},
        {"merge --exposure", {.words = {"--exposure", "1"}, .more = {"-o", "m.png"}, .before = parts}},
        {"merge --tonemap", {.words = {"--tonemap", "agx"}, .more = {"-o", "m.png"}, .before = parts}},

        {"refocus FILE", {.words = {"b.exr"}, .before = lensImages}},
        {"refocus --output", {.words = {"-o", "other.exr"}, .before = lensImages}},
        {"refocus --exposure", {.words = {"--exposure", "1"}, .more = {"-o", "m.png"}, .before = lensImages}},
        {"refocus --html", {.words = {"--html", "page.html"}, .before = lensImages}},
        {"refocus --fill-gaps",
         {.words = {"--no-fill-gaps"}, .more = {"--focus-distance", "0.5"}, .before = fewImages}},
        {"refocus --stack", {.words = {"--stack", "2"}, .before = lensImages}},
        {"refocus --focus-pull",
         {.words = {"--focus-pull", "0.6:2", "--video", "film.gif", "--frames", "2"}, .before = lensImages}},
        {"refocus --video",
         {.words = {"--video", "film.gif", "--focus-pull", "0.6:2", "--frames", "2"}, .before = lensImages}},
        {"refocus --tonemap", {.words = {"--tonemap", "agx"}, .more = {"-o", "m.png"}, .before = lensImages}},
        {"refocus --focus-distance", {.words = {"--focus-distance", "0.6"}, .before = lensImages}},
        {"refocus --focus-pixel", {.words = {"--focus-pixel", "8,6"}, .more = {"--fstop", "1"}, .before = lensImages}},
        {"refocus --fstop", {.words = {"--fstop", "1"}, .before = lensImages}},
        {"refocus --blades", {.words = {"--blades", "3"}, .more = {"--focus-distance", "0.6"}, .before = lensImages}},
        {"refocus --blade-rotation",
         {.words = {"--blade-rotation", "60"},
          .more = {"--focus-distance", "0.6", "--blades", "3"},
          .before = lensImages}},
        {"refocus --blade-curvature",
         {.words = {"--blade-curvature", "0.9"},
          .more = {"--focus-distance", "0.6", "--blades", "3"},
          .before = lensImages}},
        {"refocus --anamorphic-ratio",
         {.words = {"--anamorphic-ratio", "3"}, .more = {"--focus-distance", "0.6"}, .before = lensImages}},
        {"refocus --obstruction",
         {.words = {"--obstruction", "0.7"}, .more = {"--focus-distance", "0.6"}, .before = lensImages}},
        {"refocus --spherical-aberration",
         {.words = {"--spherical-aberration", "1"}, .more = {"--focus-distance", "0.6"}, .before = lensImages}},
        {"refocus --aperture-image",
         {.words = {"--aperture-image", "half.png"}, .more = {"--focus-distance", "0.6"}, .before = lensImages}},

        {"plan --json", {.words = {"--json"}}},

        {"info --json", {.words = {"--json"}}},
        {"info --camera", {.words = {"--camera"}}},
        {"info --depths", {.words = {"--depths", "1,2"}, .more = {"--camera"}}},
        {"info --acceptable-coc", {.words = {"--acceptable-coc", "0.1"}, .more = {"--camera"}}},

        {"pyramid --mesh", {.words = {"--mesh", "(mesh 1)"}}},
        {"pyramid --points", {.words = {"--points", "100"}}},
        {"pyramid --no-measure", {.words = {"--no-measure"}}},
        {"pyramid --export", {.words = {"--export", "levels"}}},
        {"pyramid --cache-dir", {.words = {"--cache-dir", "kept"}}},
        {"pyramid --json", {.words = {"--json"}}},

        {"compare A", {.words = {"three.exr", "two.exr"}}},
        {"compare B", {.words = {"one.exr", "three.exr"}}},
        {"compare --json", {.words = {"--json"}}},
        {"compare --error-map", {.words = {"--error-map", "map.png"}}},
        {"compare --hdr", {.words = {"--hdr"}}},
        {"compare --start-exposure", {.words = {"--start-exposure", "-8"}, .more = {"--hdr"}}},
        {"compare --stop-exposure", {.words = {"--stop-exposure", "6"}, .more = {"--hdr"}}},
        {"compare --exposures", {.words = {"--exposures", "1"}, .more = {"--hdr"}}},
        {"compare --fail-above", {.words = {"--fail-above", "mae=0"}}},

        {"bench prediction --cocs", {.words = {"--cocs", "3"}}},
        {"bench prediction --output", {.words = {"-o", "other"}}},

        {"bench speedup --counts", {.words = {"--counts", "3"}}},
        {"bench speedup --fstops", {.words = {"--fstops", "4"}}},
        {"bench speedup --focus-distances", {.words = {"--focus-distances", "4"}}},
        {"bench speedup --methods", {.words = {"--methods", "scheuermann"}}},
        {"bench speedup --runs", {.words = {"--runs", "2"}}},
        {"bench speedup --seeds",
         {.words = {"--seeds", "1"},
          .more = {"--runs", "2", "--reference-samples", "4"},
          .without = {"--reference-samples"}}},
        {"bench speedup --reference-samples", {.words = {"--reference-samples", "4"}}},
        {"bench speedup --output", {.words = {"-o", "other"}}},
        {"bench speedup --report", {.words = {"--report", "page"}, .without = {"-o"}}},

        {"bench popping --counts", {.words = {"--counts", "3"}}},
        {"bench popping --frames", {.words = {"--frames", "3"}}},
        {"bench popping --path-frames", {.words = {"--path-frames", "9"}}},
        {"bench popping --output", {.words = {"-o", "other"}}},
        {"bench popping --report", {.words = {"--report", "page"}, .without = {"-o"}}},

        {"bench convergence --methods", {.words = {"--methods", "circular"}}},
        {"bench convergence --rows", {.words = {"--rows", "best"}}},
        {"bench convergence --counts", {.words = {"--counts", "3"}}},
        {"bench convergence --lod", {.words = {"--lod", "nearest"}}},
        {"bench convergence --metrics", {.words = {"--metrics", "error"}}},
        {"bench convergence --threshold-factors", {.words = {"--threshold-factors", "3"}}},
        {"bench convergence --shading", {.words = {"--shading", "unlit"}}},
        {"bench convergence --runs", {.words = {"--runs", "2"}}},
        {"bench convergence --seeds", {.words = {"--seeds", "1"}, .more = {"--runs", "2"}}},
        {"bench convergence --reference-samples", {.words = {"--reference-samples", "6"}}},
        {"bench convergence --output", {.words = {"-o", "other"}}},
        {"bench convergence --resume", {.words = {"--resume"}, .before = converged}},
        {"bench convergence --overwrite", {.words = {"--overwrite"}, .before = converged}},
        {"bench convergence --report", {.words = {"--report", "page"}}},

        {"new-shot --output", {.words = {"-o", "other-made.json"}}},
        {"export-camera --output", {.words = {"-o", "other-made.usda"}}},
        {"export-camera --range", {.words = {"--range", "0:2"}}},
        {"export-camera --frame-rate", {.words = {"--frame-rate", "10"}}},
        {"new-shot --overwrite", {.words = {"--overwrite"}, .before = {usualLine("new-shot")}}},

        {"completions SHELL", {.words = {"zsh"}}},

        {"settings --json", {.words = {"--json"}}},
        {"settings --markdown", {.words = {"--markdown"}}},
        {"settings --shot-schema", {.words = {"--shot-schema", "schema.json"}}},
    };
    return table;
}

}  // namespace defocus::engine
