#include "scene/units.h"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "core/parse.h"

namespace defocus::engine {

namespace {

struct Unit {
    std::string_view name;
    double metres;
};
constexpr std::array<Unit, 3> units = {{{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}}};

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

double guessedMetresPerUnit(double extent) {
    constexpr double thumb = 0.05, building = 30, everyday = 0.75;  // metres
    if (!(extent > 0) || !std::isfinite(extent) || (extent >= thumb && extent <= building)) return 1;
    return std::pow(10, std::round(std::log10(everyday / extent)));
}

}  // namespace defocus::engine
