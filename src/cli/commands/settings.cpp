// defocus settings: prints the table of all settings, and the documents generated from the table.

#include "frame/settings/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "capture/shot_schema.h"
#include "cli/command.h"
#include "cli/options/option_text.h"
#include "core/error.h"
#include "core/file.h"
#include "render/methods.h"

namespace defocus::engine {

namespace {

using Json = nlohmann::ordered_json;

struct SettingsArguments {
    bool json = false;
    bool markdown = false;
    std::filesystem::path schema;  // schema to update; empty: none
};

std::string rangeText(const Setting& setting) {
    const bool ranged = setting.kind == SettingKind::number || setting.kind == SettingKind::integer;
    const std::string words = fmt::format("{}", fmt::join(setting.choices, ", "));
    if (ranged)
        return fmt::format("{:.10g} to {:.10g}{}{}", setting.min, setting.max, words.empty() ? "" : ", ", words);
    if (!words.empty()) return words;
    if (setting.kind == SettingKind::boolean) return "true, false";
    return setting.metavar;
}

std::string defaultText(const Setting& setting) {
    return setting.text(Request{}).value_or("");
}

Json settingsJson() {
    Json rows = Json::array();
    for (const Setting& setting : settings()) {
        Json row = {{"name", setting.name},
                    {"option", setting.option},
                    {"python", snakeCase(setting.name)},
                    {"group", groupTitle(setting.group)},
                    {"range", rangeText(setting)},
                    {"unit", setting.unit}};
        row["default"] = setting.text(Request{}) ? Json(defaultText(setting)) : Json(nullptr);
        row["shot"] = setting.shotPlace;
        row["keyed"] = setting.keyed;
        row["help"] = setting.help;
        rows.push_back(row);
    }
    return rows;
}

void printTable() {
    SettingGroup group = SettingGroup::developer;
    for (const Setting& setting : settings()) {
        if (setting.group != group) fmt::print("\n{}\n", groupTitle(setting.group));
        group = setting.group;
        fmt::print("  {:<30} {:<34} {}\n", setting.option, fmt::format("{} {}", rangeText(setting), setting.unit),
                   defaultText(setting));
    }
}

// ---- docs/settings.md -----------------------------------------------------------------------------------------------

// Escapes vertical bars, which separate the cells of a Markdown table.
std::string cell(const std::string& text) {
    std::string escaped;
    for (const char letter : text) {
        if (letter == '|') escaped.push_back('\\');
        escaped.push_back(letter);
    }
    return escaped;
}

std::string markdownRow(const Setting& setting) {
    const std::string shot = setting.shotPlace.empty() ? "" : fmt::format("`{}`", setting.shotPlace);
    const std::string unit = setting.unit.empty() ? "" : fmt::format(" {}", setting.unit);
    const std::string value = defaultText(setting);
    return fmt::format("| `{}` | `{}` | {}{} | {} | {}{} | {} |\n", setting.option, snakeCase(setting.name),
                       cell(rangeText(setting)), unit, value.empty() ? "" : fmt::format("`{}`", value), shot,
                       setting.keyed ? ", keyframes" : "", cell(setting.help));
}

std::string methodRow(const Method& method, const MethodSetting& setting) {
    const std::string range = setting.choices.empty() ? fmt::format("{:g} to {:g}", setting.min, setting.max)
                                                      : fmt::format("{}", fmt::join(setting.choices, ", "));
    return fmt::format("| `{}` | `--{}` | {} | `{}` | {} |\n", method.name, setting.name, cell(range),
                       setting.defaultValue, cell(setting.description));
}

std::string markdown() {
    std::string page =
        "# Settings\n"
        "\n"
        "All settings of an image. `defocus settings --markdown` prints this page from the table that the\n"
        "program uses (`src/frame/settings/rows*.cpp`).\n"
        "\n"
        "- **Option**: the option of `render`, `capture`, `view`, `plan` and `bench`.\n"
        "- **Python**: the keyword of `defocus.render` and related functions. `defocus::Request` in C++ has the same "
        "names.\n"
        "- **Shot**: the JSON pointer of the setting in a shot file ([shots](shots.md)). *keyframes* marks settings\n"
        "  that can be animated. The extras of a glTF camera can hold lens values, too; the key is the last part of\n"
        "  the pointer, such as `fStop`.\n"
        "- **Range**: the permitted values. Lengths in mm or m also accept a suffix mm, cm or m, such as 50cm. A\n"
        "  boolean option needs no value: `--dof` is `--dof true`, and `--no-dof` is `--dof false`. The opposite of\n"
        "  `--no-cache` is `--cache`.\n"
        "- **Default**: empty if there is no fixed default. The meaning then says how the value is chosen, if one "
        "is.\n";
    SettingGroup group = SettingGroup::developer;
    bool first = true;
    for (const Setting& setting : settings()) {
        if (first || setting.group != group)
            page += fmt::format(
                "\n"
                "## {}\n\n"
                "| option | Python | range | default | shot | meaning |\n"
                "| --- | --- | --- | --- | --- | --- |\n",
                groupTitle(setting.group));
        first = false;
        group = setting.group;
        page += markdownRow(setting);
    }
    page +=
        "\n"
        "## Settings of methods\n\n"
        "Each setting is an option of `render`, `capture` and `view` (`--method scheuermann --coc thin-lens`). It can\n"
        "also follow the name of the method (`--method scheuermann:coc=thin-lens`).\n\n"
        "| method | option | range | default | meaning |\n"
        "| --- | --- | --- | --- | --- |\n";
    for (const Method& method : methods())
        for (const MethodSetting& setting : method.settings) page += methodRow(method, setting);
    return page;
}

// ---- docs/shot.schema.json ------------------------------------------------------------------------------------------

void printSchema(const std::filesystem::path& path) {
    const Json schema = Json::parse(readText(path), nullptr, false);
    if (!schema.is_object()) fail("{} is not a JSON schema", path.string());
    fmt::print("{}\n", withSettings(schema).dump(2));
}

void runSettings(const SettingsArguments& arguments) {
    if (!arguments.schema.empty()) return printSchema(arguments.schema);
    if (arguments.markdown)
        fmt::print("{}", markdown());
    else if (arguments.json)
        fmt::print("{}\n", settingsJson().dump(2));
    else
        printTable();
}

}  // namespace

void addSettingsCommand(CLI::App& program) {
    auto arguments = std::make_shared<SettingsArguments>();
    CLI::App* command = program.add_subcommand("settings", "List every setting with its range and default");
    CLI::Option* json = command->add_flag("--json", arguments->json, "Print JSON");
    CLI::Option* page = command->add_flag("--markdown", arguments->markdown, "Print the page docs/settings.md");
    CLI::Option* schema =
        command
            ->add_option(
                "--shot-schema", arguments->schema,
                "Print the given JSON schema of shot files, with the current types, ranges and descriptions of the "
                "settings")
            ->type_name("FILE")
            ->check(unnamed(CLI::ExistingFile));
    json->excludes(page)->excludes(schema);
    page->excludes(schema);
    command->callback([arguments] {
        runSettings(*arguments);
        std::fflush(stdout);
    });
}

}  // namespace defocus::engine
