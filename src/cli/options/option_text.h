#pragma once
// Adds options that use this program's own parsers, so that a wrong value gives one clear line such as "--samples: '0'
// is not an integer from 1 to 65536".

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/parse.h"

namespace defocus::engine {

// Adds an option that passes its text to `parse`. An Error from `parse` is reported as a command-line error.
CLI::Option* addParsed(CLI::App& command, const std::string& names, const std::string& type,
                       const std::string& description, std::function<void(const std::string&)> parse);

// Marks an option that only --help-all shows. CLI11 has no such flag; `configurable` is used instead, because the
// program reads no configuration files.
inline CLI::Option* advanced(CLI::Option* option) {
    return option->configurable(false);
}

// Returns whether --help shows the option.
bool isEveryday(const CLI::Option& option);

// Returns all names of an option, such as "-o" and "--output"; for a positional argument, its placeholder.
std::vector<std::string> namesOf(const CLI::Option& option);

// Returns a copy of `check` that adds no text to --help, for options whose description already gives the allowed
// values.
inline CLI::Validator unnamed(const CLI::Validator& check) {
    return check.description("");
}

// Adds an option for a number that may remain unset. `target` must outlive the parsing.
CLI::Option* addNumber(CLI::App& command, const std::string& names, std::optional<double>& target, const Range& range,
                       const std::string& type, const std::string& description);
CLI::Option* addNumber(CLI::App& command, const std::string& names, double& target, const Range& range,
                       const std::string& type, const std::string& description);

template <typename Whole>
CLI::Option* addInteger(CLI::App& command, const std::string& names, Whole& target, std::uint64_t min,
                        std::uint64_t max, const std::string& description) {
    return addParsed(command, names, "N", description,
                     [&target, min, max](const std::string& text) {
                         target = static_cast<Whole>(parseInteger(text, min, max));
                     })
        ->default_str(std::to_string(target));
}

// Adds an option for a comma-separated list; `parse` converts each part.
template <typename Value, typename Parse>
CLI::Option* addList(CLI::App& command, const std::string& names, const std::string& type, std::vector<Value>& target,
                     const std::string& description, Parse parse) {
    return addParsed(command, names, type, description, [&target, parse](const std::string& text) {
        target.clear();
        for (const std::string& part : splitAt(text, ',')) target.push_back(parse(part));
    });
}

// Adds an option for a comma-separated list of numbers.
CLI::Option* addNumbers(CLI::App& command, const std::string& names, std::vector<double>& target, const Range& range,
                        const std::string& type, const std::string& description);

template <typename Whole>
CLI::Option* addIntegers(CLI::App& command, const std::string& names, std::vector<Whole>& target, std::uint64_t min,
                         std::uint64_t max, const std::string& description) {
    return addList(command, names, "N,N,…", target, description,
                   [min, max](const std::string& part) { return static_cast<Whole>(parseInteger(part, min, max)); })
        ->default_str(fmt::format("{}", fmt::join(target, ",")));
}

template <typename Value>
CLI::Option* addChoice(CLI::App& command, const std::string& name, Value& target,
                       const std::vector<std::pair<std::string, Value>>& choices, const std::string& description) {
    std::vector<std::string> names;
    std::string type;
    std::string current;
    for (const auto& [choice, value] : choices) {
        names.push_back(choice);
        type += (type.empty() ? "" : "|") + choice;
        if (value == target) current = choice;
    }
    return addParsed(command, name, type, description,
                     [&target, choices, names](const std::string& text) {
                         target = choices[parseChoice(text, names)].second;
                     })
        ->default_str(current);
}

}  // namespace defocus::engine
