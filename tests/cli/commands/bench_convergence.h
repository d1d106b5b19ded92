#pragma once
// Runs `defocus bench convergence` on a small scene and checks the report.

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "cli/gl_program.h"
#include "cli/two_quads.h"

namespace defocus::engine {

class BenchConvergence : public GlProgramTest {
protected:
    void SetUp() override {
        GlProgramTest::SetUp();
        writeTwoQuads(folder() / "quads.gltf");
    }

    Outcome bench(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(),
                         {"--quiet", "bench", "convergence", "quads.gltf", "--size", "64x48", "--fstop", "1",
                          "--counts", "2,8", "--methods", "accumulation", "--threshold-factors", "1", "--runs", "2",
                          "--reference-samples", "16", "--allow-changed"});
        return run(arguments);
    }

    // Returns the rows of a CSV file. The key of a row is the text of `keys` columns, from column `first` on. Expects
    // unique keys.
    std::map<std::string, std::vector<std::string>> rowsOf(const std::string& file, std::size_t first,
                                                           std::size_t keys) const {
        std::istringstream text(textOf(folder() / file));
        std::map<std::string, std::vector<std::string>> rows;
        std::string line;
        for (std::getline(text, line); std::getline(text, line);) {
            std::vector<std::string> cells;
            std::istringstream values(line);
            for (std::string cell; std::getline(values, cell, ',');) cells.push_back(cell);
            std::string key;
            for (std::size_t i = first; i < first + keys; ++i) key += cells.at(i) + ' ';
            EXPECT_TRUE(rows.emplace(key, cells).second) << key << " occurs twice in " << file;
        }
        return rows;
    }

    // Expects a self-contained HTML page: it loads nothing from other hosts, its links lead into the page or to data
    // files beside it, and every image has alternative text.
    static void expectSelfContained(const std::string& page) {
        const std::regex outside(
            "src=\"(?!data:)|href=\"(?!data:|#|[a-z]+[.](json|csv)\")|url\\((?!#)|@import|<script(?!>)|<link");
        const std::regex picture("<img (?![^>]*alt=\"[^\"]+\")|<svg (?![^>]*role=\"img\")");
        std::smatch found;
        EXPECT_FALSE(std::regex_search(page, found, outside)) << found.str();
        EXPECT_FALSE(std::regex_search(page, found, picture)) << found.str();
    }
};

}  // namespace defocus::engine
