#include "capture/setting_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/error.h"
#include "core/parse.h"

namespace defocus {

namespace {

std::string sizeText(const JsonReader& reader) {
    const char* what = "the width and the height in pixels";
    const std::vector<JsonReader> sides = reader.elements(2, what);
    if (sides.size() != 2) reader.failExpecting(what);
    return fmt::format("{}x{}", sides[0].whole(1, mostPixels), sides[1].whole(1, mostPixels));
}

std::string backgroundText(const JsonReader& reader) {
    const auto colour = reader.threeNumbers();
    if (colour && std::ranges::all_of(*colour, [](double c) { return c >= 0 && c <= 1e9; }))
        return fmt::format("{}", fmt::join(*colour, ","));
    if (reader.value() != "environment" && reader.value() != "none")
        reader.failExpecting("\"environment\", \"none\" or three numbers of 0 or more (linear red, green, blue)");
    return reader.text();
}

// By its name or number.
std::string clipText(const JsonReader& reader) {
    if (reader.value().is_string()) return reader.text();
    if (reader.value().is_number()) return std::to_string(reader.whole(0, 1'000'000));
    reader.failExpecting("the number or the name of a clip");
}

std::string textOf(const Setting& setting, const JsonReader& reader) {
    if (setting.name == "size") return sizeText(reader);
    if (setting.name == "background") return backgroundText(reader);
    if (setting.name == "clip") return clipText(reader);
    if (setting.name == "motionSegments") return std::to_string(reader.whole(1, 64));
    switch (setting.kind) {
        case SettingKind::number:
            if (!setting.choices.empty() && reader.value().is_string()) return reader.text();
            return fmt::format("{}", reader.number(setting.least, setting.most));
        case SettingKind::whole:
            if (!setting.choices.empty() && reader.value().is_string()) return reader.text();
            return std::to_string(
                reader.whole(static_cast<std::int64_t>(setting.least), static_cast<std::int64_t>(setting.most)));
        case SettingKind::truth:
            return reader.truth() ? "true" : "false";
        case SettingKind::choice:
            return setting.choices[reader.choice(setting.choices)];
        case SettingKind::text:
        case SettingKind::path:
        case SettingKind::other:
            return reader.text();
    }
    return {};
}

}  // namespace

std::string settingText(const Setting& setting, const JsonReader& reader) {
    std::string text = textOf(setting, reader);
    try {
        Request scratch;
        setting.set(scratch, text);
    } catch (const Error& error) {
        reader.failWith(error.what());
    }
    return text;
}

nlohmann::ordered_json settingJson(const Setting& setting, const std::string& text) {
    Request request;
    setting.set(request, text);
    if (setting.name == "size") return {request.width, request.height};
    if (setting.name == "background" && request.background == Background::uniform) {
        nlohmann::ordered_json colour = nlohmann::ordered_json::array();
        for (const float channel : request.backgroundColor) colour.push_back(channel);
        return colour;
    }
    if (setting.name == "motionSegments") return request.shutter.motionSegments;
    if (std::ranges::find(setting.choices, text) != setting.choices.end()) return text;
    if (setting.kind == SettingKind::number) return parseNumber(text, {setting.least, setting.most});
    if (setting.kind == SettingKind::whole)
        return parseWhole(text, static_cast<std::uint64_t>(setting.least), static_cast<std::uint64_t>(setting.most));
    if (setting.kind == SettingKind::truth) return text == "true";
    return text;
}

}  // namespace defocus
