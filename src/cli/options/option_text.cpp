#include "cli/options/option_text.h"

#include "core/error.h"

namespace defocus::engine {

CLI::Option* addParsed(CLI::App& command, const std::string& names, const std::string& type,
                       const std::string& description, std::function<void(const std::string&)> parse) {
    const std::string shown = names.substr(0, names.find(','));
    return command
        .add_option_function<std::string>(
            names,
            [parse = std::move(parse), shown](const std::string& text) {
                try {
                    parse(text);
                } catch (const Error& error) {
                    throw CLI::ValidationError(shown, error.what());
                }
            },
            description)
        ->type_name(type);
}

CLI::Option* addNumber(CLI::App& command, const std::string& names, std::optional<double>& target, const Range& range,
                       const std::string& type, const std::string& description) {
    return addParsed(command, names, type, description,
                     [&target, range](const std::string& text) { target = parseNumber(text, range); });
}

CLI::Option* addNumber(CLI::App& command, const std::string& names, double& target, const Range& range,
                       const std::string& type, const std::string& description) {
    return addParsed(command, names, type, description,
                     [&target, range](const std::string& text) { target = parseNumber(text, range); })
        ->default_str(fmt::format("{:g}", target));
}

bool isEveryday(const CLI::Option& option) {
    // CLI11 marks --help as not configurable, although --help lists this option.
    return option.get_configurable() || option.get_name().starts_with("--help");
}

std::vector<std::string> namesOf(const CLI::Option& option) {
    if (option.get_positional()) return {option.get_name()};
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames()) names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
    return names;
}

CLI::Option* addNumbers(CLI::App& command, const std::string& names, std::vector<double>& target, const Range& range,
                        const std::string& type, const std::string& description) {
    return addList(command, names, type, target, description,
                   [range](const std::string& part) { return parseNumber(part, range); })
        ->default_str(fmt::format("{:g}", fmt::join(target, ",")));
}

}  // namespace defocus::engine
