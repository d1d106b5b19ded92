#include "cli/option_text.h"

#include "core/error.h"

namespace defocus {

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

}  // namespace defocus
