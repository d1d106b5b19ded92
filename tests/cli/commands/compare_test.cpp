// Tests `defocus compare`, which runs in the test process.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "cli/command.h"
#include "core/error.h"
#include "image/image_io.h"

namespace defocus::engine {
namespace {

class Compare : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (std::filesystem::temp_directory_path() / "defocus-test-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder = pattern;
        Image image(20, 16, 3);
        std::ranges::fill(image.pixels, srgbDecode(0.6f));
        writeImage(folder / "six.exr", image);
        std::ranges::fill(image.pixels, srgbDecode(0.5f));
        writeImage(folder / "five.exr", image);
        writeImage(folder / "small.exr", Image(20, 15, 3));
    }
    void TearDown() override {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }

    // Returns the output of `defocus compare` with these arguments. @six, @five, @small and @none stand for the paths
    // of the test's files.
    std::string run(std::string arguments) const {
        for (const char* name : {"six", "five", "small", "none"}) {
            const std::string word = std::string("@") + name;
            for (std::size_t at; (at = arguments.find(word)) != std::string::npos;)
                arguments.replace(at, word.size(), (folder / (std::string(name) + ".exr")).string());
        }
        CLI::App program;
        const GlobalOptions global;
        addCompareCommand(program, global);
        testing::internal::CaptureStdout();
        try {
            program.parse("compare " + arguments);
        } catch (...) {
            output = testing::internal::GetCapturedStdout();
            throw;
        }
        return output = testing::internal::GetCapturedStdout();
    }

    std::filesystem::path folder;
    mutable std::string output;  // output of the last run of the command
};

TEST_F(Compare, printsJsonWithTheStatedKeys) {
    const auto json = nlohmann::json::parse(run("@six @five --json"));
    EXPECT_NEAR(json.at("mae").get<double>(), 0.1, 1e-6);
    EXPECT_NEAR(json.at("rmse").get<double>(), 0.1, 1e-6);
    EXPECT_NEAR(json.at("psnr").get<double>(), 20, 1e-4);
    EXPECT_NEAR(json.at("ssim").get<double>(), (0.6 + 1e-4) / (0.61 + 1e-4), 1e-6);
    EXPECT_GT(json.at("flip").get<double>(), 0.01);
    EXPECT_NEAR(json.at("maxError").get<double>(), 0.1, 1e-6);
    EXPECT_EQ(json.at("maxErrorPixel"), nlohmann::json::parse("[0, 0]"));
    EXPECT_EQ(json.at("nonFinite"), 0);
    EXPECT_EQ(json.at("pixelCount"), 320);
}

TEST_F(Compare, equalImagesHaveNoPsnrInJson) {
    const auto json = nlohmann::json::parse(run("@six @six --json"));
    EXPECT_TRUE(json.at("psnr").is_null());
    EXPECT_EQ(json.at("mae"), 0.0);
    EXPECT_EQ(json.at("ssim"), 1.0);
}

TEST_F(Compare, printsATableForPeople) {
    const std::string table = run("@six @five");
    EXPECT_NE(table.find("psnr        20.00 dB\n"), std::string::npos) << table;
    EXPECT_NE(table.find("max error   0.100000 at pixel 0,0\n"), std::string::npos) << table;
    EXPECT_NE(run("@six @six").find("infinite"), std::string::npos);
}

TEST_F(Compare, failsAboveALimitButStillReports) {
    EXPECT_NO_THROW(run("@six @five --fail-above rmse=0.2 --fail-above psnr=19 --fail-above ssim=0.9"));
    EXPECT_NO_THROW(run("@six @six --fail-above psnr=1000 --fail-above mae=0"));
    EXPECT_THROW(run("@six @five --fail-above rmse=0.05"), Error);
    EXPECT_NE(output.find("rmse"), std::string::npos);
    EXPECT_THROW(run("@six @five --fail-above ssim=0.999"), Error);
    EXPECT_THROW(run("@six @five --fail-above maxError=0.09"), Error);
    EXPECT_THROW(run("@six @five --fail-above flip=0"), Error);
    try {
        run("@six @five --fail-above mae=0.5 --fail-above psnr=42 --fail-above rmse=0.01");
        FAIL() << "no error";
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("psnr 20 is below 42, rmse 0.1 is above 0.01"), std::string::npos) << message;
        EXPECT_EQ(message.find("mae"), std::string::npos) << message;
    }
}

TEST_F(Compare, aWrongCommandLineIsAParseError) {
    for (const char* arguments :
         {"@six", "@six @five --fail-above psnr", "@six @five --fail-above colour=1", "@six @five --fail-above mae=x",
          "@six @five --fail-above mae=nan", "@six @five --start-exposure 1", "@six @five --hdr --exposures 0",
          "@six @five --hdr --start-exposure 100"})
        EXPECT_THROW(run(arguments), CLI::ParseError) << arguments;
}

TEST_F(Compare, filesThatCannotBeComparedAreNamed) {
    for (const auto& [arguments, part] :
         {std::pair("@six @none", "none.exr"), {"@six @small", "20x15"}, {"@six @five --error-map e.webm", "e.webm"}}) {
        try {
            run(arguments);
            FAIL() << "no error: " << arguments;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
        EXPECT_EQ(output, "") << arguments;
    }
}

TEST_F(Compare, writesTheErrorMapColouredOrPlain) {
    const double flip = nlohmann::json::parse(run("@six @five --json")).at("flip").get<double>();
    run("@six @five --error-map " + (folder / "e.exr").string());
    const Image plain = readImage(folder / "e.exr");
    ASSERT_EQ(plain.channels, 1);
    EXPECT_NEAR(plain.pixels[0], flip, 1e-5);
    run("@six @five --error-map " + (folder / "e.png").string());
    const Image coloured = readImage(folder / "e.png");
    EXPECT_EQ(coloured.channels, 3);
    EXPECT_EQ(coloured.width, 20);
}

TEST_F(Compare, hdrTakesTheGivenExposures) {
    const auto flipOf = [&](const std::string& options) {
        return nlohmann::json::parse(run("@six @five --json " + options)).at("flip").get<double>();
    };
    EXPECT_NE(flipOf("--hdr"), flipOf(""));
    EXPECT_LT(flipOf("--hdr --start-exposure -9 --stop-exposure -8 --exposures 2"), flipOf("--hdr"));
    EXPECT_THROW(flipOf("--hdr --start-exposure 3 --stop-exposure 2"), Error);
}

TEST_F(Compare, helpHasAnExample) {
    CLI::App program;
    addCompareCommand(program, {});
    const std::string help = program.get_subcommand("compare")->help();
    EXPECT_NE(help.find("defocus compare reference.exr"), std::string::npos);
    EXPECT_NE(help.find("psnr"), std::string::npos);
}

}  // namespace
}  // namespace defocus::engine
