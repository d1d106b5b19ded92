#include "scene/units.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/parse.h"

namespace defocus::engine {

namespace {

struct Unit {
    std::string_view name;
    double metres;
    double millimetres;  // length of the unit in mm; an integer, so that most conversions are exact
};
constexpr std::array<Unit, 3> units = {{{"m", 1, 1000}, {"cm", 1e-2, 10}, {"mm", 1e-3, 1}}};

double millimetresOf(std::string_view name) {
    return std::ranges::find(units, name, &Unit::name)->millimetres;
}

std::string lengthIn(const std::string& unit, const std::string& text) {
    const std::size_t begin = text.find_last_not_of("cm") + 1;
    const std::string suffix = text.substr(begin);
    if (std::ranges::find(units, suffix, &Unit::name) == units.end()) return text;
    try {
        const double value = parseNumber(text.substr(0, begin), {-1e12, 1e12});
        return fmt::format("{}", value * millimetresOf(suffix) / millimetresOf(unit));
    } catch (const Error&) {
        return text;
    }
}

}  // namespace

double metresOfUnit(const std::string& text) try {
    for (const Unit& unit : units)
        if (text == unit.name) return unit.metres;
    return parseNumber(text, {1e-9, 1e9});
} catch (const Error&) {
    fail("'{}' is not m, cm, mm, or a number of metres from 1e-9 to 1e9", text);
}

std::string unitOfMetres(double metres) {
    for (const Unit& unit : units)
        if (metres == unit.metres) return std::string(unit.name);
    return fmt::format("{}", metres);
}

std::string lengthsIn(const std::string& unit, const std::string& text) {
    std::vector<std::string> parts = splitAt(text, ',');
    for (std::string& part : parts) part = lengthIn(unit, part);
    return fmt::format("{}", fmt::join(parts, ","));
}

double guessedMetresPerUnit(double extent) {
    constexpr double thumb = 0.05, building = 30, everyday = 0.75;  // sizes of objects in metres
    if (!(extent > 0) || !std::isfinite(extent) || (extent >= thumb && extent <= building)) return 1;
    return std::pow(10, std::round(std::log10(everyday / extent)));
}

}  // namespace defocus::engine
