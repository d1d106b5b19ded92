#include "scene/camera_files/camera_usda.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <glm/gtc/type_ptr.hpp>
#include <string_view>

namespace defocus::engine {

namespace {

// USD gives lens lengths in tenths of the layer's unit. The unit is 1 m here, so 1 mm is 0.01 tenths of it.
constexpr double unitsPerMillimetre = 0.01;

// Names of the lens values that USD attributes express, directly or indirectly.
constexpr std::array<std::string_view, 5> usdValues = {"focalLength", "horizontalAperture", "fStop", "focusDistance",
                                                       "dofEnabled"};

std::string identifier(const std::string& name) {
    std::string result;
    for (const char letter : name)
        result += std::isalnum(static_cast<unsigned char>(letter)) != 0 && static_cast<unsigned char>(letter) < 0x80
                      ? letter
                      : '_';
    if (result.empty()) result = "Camera";
    return std::isdigit(static_cast<unsigned char>(result[0])) != 0 ? "_" + result : result;
}

std::string matrixText(const glm::dmat4& matrix) {
    const double* values = glm::value_ptr(matrix);  // GLM's columns become USD's rows
    std::string rows;
    for (int row = 0; row < 4; ++row)
        rows += fmt::format("{}({})", row > 0 ? ", " : "", fmt::join(values + 4 * row, values + 4 * row + 4, ", "));
    return "( " + rows + " )";
}

class Writer {
public:
    explicit Writer(const CameraTake& take) : take_(take) {}

    // Adds an attribute, with time samples if its value changes over time.
    void add(std::string_view type, std::string_view name,
             const std::function<std::string(const CameraSample&)>& text) {
        const std::string first = text(take_.samples.front());
        bool changes = false;
        for (const CameraSample& sample : take_.samples) changes = changes || text(sample) != first;
        if (!changes) {
            lines += fmt::format("        {} {} = {}\n", type, name, first);
            return;
        }
        lines += fmt::format("        {} {}.timeSamples = {{\n", type, name);
        for (const CameraSample& sample : take_.samples)
            lines += fmt::format("            {}: {},\n", sample.time * take_.frameRate, text(sample));
        lines += "        }\n";
    }

    std::string lines;

private:
    const CameraTake& take_;
};

}  // namespace

std::string cameraUsdaText(const CameraTake& take) {
    const std::string name = identifier(take.name);
    Writer writer(take);
    const auto lens = [](const char* key, double factor) {
        return [=](const CameraSample& sample) { return fmt::format("{}", lensValueOf(sample, key, 0) * factor); };
    };
    writer.add("float", "focalLength", lens("focalLength", unitsPerMillimetre));
    writer.add("float", "horizontalAperture", lens("horizontalAperture", unitsPerMillimetre));
    writer.add("float", "verticalAperture", [&](const CameraSample& sample) {
        return fmt::format("{}", lensValueOf(sample, "horizontalAperture", 0) * unitsPerMillimetre / take.aspect);
    });
    writer.add("float", "fStop", [](const CameraSample& sample) {
        return fmt::format("{}", lensValueOf(sample, "dofEnabled", 1) != 0 ? lensValueOf(sample, "fStop", 0) : 0.0);
    });
    writer.add("float", "focusDistance", lens("focusDistance", 1));
    writer.add("float2", "clippingRange",
               [](const CameraSample& sample) { return fmt::format("({}, 1000000)", sample.nearPlane); });
    writer.lines += "        token projection = \"perspective\"\n";
    if (take.shutter) {
        writer.lines += fmt::format("        double shutter:open = {}\n", take.shutter->open * take.frameRate);
        writer.lines += fmt::format("        double shutter:close = {}\n", take.shutter->close * take.frameRate);
    }
    for (const std::string& value : lensNames(take))
        if (std::ranges::find(usdValues, value) == usdValues.end())
            writer.add("custom double", "defocus:" + value, lens(value.c_str(), 1));
    writer.add("matrix4d", "xformOp:transform",
               [](const CameraSample& sample) { return matrixText(sample.worldFromCamera); });

    std::string range;
    if (take.samples.size() > 1)
        range = fmt::format("    startTimeCode = {}\n    endTimeCode = {}\n",
                            take.samples.front().time * take.frameRate, take.samples.back().time * take.frameRate);
    return fmt::format(
        "#usda 1.0\n"
        "(\n"
        "    defaultPrim = \"World\"\n"
        "    doc = \"Camera written by defocus\"\n"
        "    metersPerUnit = 1\n"
        "    upAxis = \"Y\"\n"
        "    timeCodesPerSecond = {0}\n"
        "    framesPerSecond = {0}\n"
        "{1}"
        ")\n\n"
        "def Xform \"World\"\n"
        "{{\n"
        "    def Camera \"{2}\"\n"
        "    {{\n"
        "{3}"
        "        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n"
        "    }}\n"
        "}}\n",
        take.frameRate, range, name, writer.lines);
}

}  // namespace defocus::engine
