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
    std::filesystem::path schema;  // schema to complete; empty: none
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

std::string standardText(const Setting& setting) {
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
        row["default"] = setting.text(Request{}) ? Json(standardText(setting)) : Json(nullptr);
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
                   standardText(setting));
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
    const std::string standard = standardText(setting);
    return fmt::format("| `{}` | `{}` | {}{} | {} | {}{} | {} |\n", setting.option, snakeCase(setting.name),
                       cell(rangeText(setting)), unit, standard.empty() ? "" : fmt::format("`{}`", standard), shot,
                       setting.keyed ? ", keys" : "", cell(setting.help));
}

std::string methodRow(const Method& method, const MethodSetting& setting) {
    const std::string range = setting.choices.empty() ? fmt::format("{:g} to {:g}", setting.min, setting.max)
                                                      : fmt::format("{}", fmt::join(setting.choices, ", "));
    return fmt::format("| `{}` | `--{}` | {} | `{}` | {} |\n", method.name, setting.name, cell(range), setting.standard,
                       cell(setting.description));
}

std::string markdown() {
    std::string page =
        "# Settings\n\n"
        "Every setting of a picture, by its names. `defocus settings --markdown` prints this page from the table that "
        "the\nprogram itself reads (`src/frame/settings/rows.cpp`).\n\n"
        "- **Option**: on the command line of `render`, `capture`, `view`, `plan` and the benches that follow it.\n"
        "- **Python**: the keyword of `defocus.render` and its kin. C++ has the same names in `defocus::Request`.\n"
        "- **Shot**: its place in a shot file, and whether it may have keys there. A camera's extras in a glTF file "
        "may "
        "hold\n  the values of the lens by the last part of that place.\n"
        "- **Default**: empty where the scene, its camera or the number of samples decides.\n";
    SettingGroup group = SettingGroup::developer;
    bool first = true;
    for (const Setting& setting : settings()) {
        if (first || setting.group != group)
            page += fmt::format(
                "\n## {}\n\n| option | Python | range | default | shot | what it does |\n| --- | --- | --- | --- | --- "
                "| --- "
                "|\n",
                groupTitle(setting.group));
        first = false;
        group = setting.group;
        page += markdownRow(setting);
    }
    page +=
        "\n## Settings of methods\n\n| method | option | range | default | what it does |\n| --- | --- | --- | --- | "
        "--- "
        "|\n";
    for (const Method& method : methods())
        for (const MethodSetting& setting : method.settings) page += methodRow(method, setting);
    return page;
}

// ---- docs/shot.schema.json ------------------------------------------------------------------------------------------

void printSchema(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = readFile(path);
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    const Json schema = Json::parse(text, text + bytes.size(), nullptr, false);
    if (!schema.is_object()) fail("{}: not a JSON schema", path.string());
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
    CLI::Option* json = command->add_flag("--json", arguments->json, "JSON for programs");
    CLI::Option* page = command->add_flag("--markdown", arguments->markdown, "The page docs/settings.md");
    CLI::Option* schema =
        command
            ->add_option("--shot-schema", arguments->schema,
                         "This JSON schema of shots with the settings' types, ranges and descriptions as they are now")
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
