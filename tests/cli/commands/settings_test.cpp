// Tests that the pages in docs/ equal the pages generated from the table of settings.

#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace defocus::engine {
namespace {

class SettingsPages : public ProgramTest {
protected:
    static std::string published(const char* name) { return textOf(std::string(DEFOCUS_SOURCE_DIR) + "/docs/" + name); }
};

TEST_F(SettingsPages, settingsPageIsThatOfTheProgram) {
    const Outcome outcome = run({"settings", "--markdown"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.out, published("settings.md")) << "defocus settings --markdown >docs/settings.md";
}

TEST_F(SettingsPages, shotSchemaIsThatOfTheProgram) {
    const Outcome outcome = run({"settings", "--shot-schema", DEFOCUS_SOURCE_DIR "/docs/shot.schema.json"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    EXPECT_EQ(outcome.out, published("shot.schema.json"))
        << "defocus settings --shot-schema docs/shot.schema.json regenerates the file";
}

TEST_F(SettingsPages, tableAndJsonNameEverySetting) {
    const Outcome table = run({"settings"});
    const nlohmann::json rows = nlohmann::json::parse(run({"settings", "--json"}).out);
    ASSERT_GT(rows.size(), 50u);
    for (const nlohmann::json& row : rows)
        EXPECT_NE(table.out.find(row.at("option").get<std::string>() + " "), std::string::npos) << row;
}

}  // namespace
}  // namespace defocus::engine
