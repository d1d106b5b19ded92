#pragma once
// Formats --help: a column of options, and a column of wrapped descriptions that end with the default. --help shows the
// common options; --help-all shows all options of the command, or of all commands.

#include <CLI/CLI.hpp>
#include <string>

namespace defocus::engine {

class HelpFormat : public CLI::Formatter {
public:
    HelpFormat() {
        column_width(32);
        label("SUBCOMMAND", "COMMAND");
    }
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
    std::string make_option(const CLI::Option* option, bool isPositional) const override;
    std::string make_option_name(const CLI::Option* option, bool isPositional) const override;
    std::string make_option_opts(const CLI::Option* option) const override;
    std::string make_option_desc(const CLI::Option* option) const override;
    std::string make_subcommand(const CLI::App* command) const override;
};

}  // namespace defocus::engine
