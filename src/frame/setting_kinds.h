#pragma once
// The kinds of rows of the table of settings. Each takes a member, as a function from a request, const or not, to the
// value, and makes the row that reads and writes it. Private to setting_rows.cpp.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/parse.h"
#include "frame/settings.h"

namespace defocus::setting_kinds {

template <typename Value>
struct IsOptional : std::false_type {};
template <typename Value>
struct IsOptional<std::optional<Value>> : std::true_type {};

// The value of a member; none for an optional that holds nothing.
template <typename Member>
auto valueOf(const Request& request, Member member) {
    const auto& value = member(request);
    if constexpr (IsOptional<std::decay_t<decltype(value)>>::value)
        return value;
    else
        return std::optional(value);
}

// Takes a member back to what a default-made request has.
template <typename Member>
auto clearing(Member member) {
    return [=](Request& request) {
        const Request standard;
        member(request) = member(standard);
    };
}

inline Setting row(SettingKind kind, std::string name, std::string option, std::string metavar, std::string help) {
    Setting setting;
    setting.kind = kind;
    setting.name = std::move(name);
    setting.option = std::move(option);
    setting.metavar = std::move(metavar);
    setting.help = std::move(help);
    return setting;
}

template <typename Member>
Setting number(std::string name, std::string option, std::string metavar, double least, double most, Member member,
               std::string help) {
    Setting setting = row(SettingKind::number, std::move(name), std::move(option), std::move(metavar), std::move(help));
    setting.least = least;
    setting.most = most;
    setting.set = [=](Request& request, const std::string& text) {
        member(request) = parseNumber(text, {least, most});
    };
    setting.clear = clearing(member);
    setting.text = [=](const Request& request) -> std::optional<std::string> {
        const std::optional<double> value = valueOf(request, member);
        return value ? std::optional(fmt::format("{}", *value)) : std::nullopt;
    };
    return setting;
}

template <typename Member>
Setting whole(std::string name, std::string option, std::uint64_t least, std::uint64_t most, Member member,
              std::string help) {
    Setting setting = row(SettingKind::whole, std::move(name), std::move(option), "N", std::move(help));
    setting.least = static_cast<double>(least);
    setting.most = static_cast<double>(most);
    setting.set = [=](Request& request, const std::string& text) {
        auto& value = member(request);
        value = static_cast<std::decay_t<decltype(value)>>(parseWhole(text, least, most));
    };
    setting.clear = clearing(member);
    setting.text = [=](const Request& request) { return std::optional(fmt::format("{}", member(request))); };
    return setting;
}

inline bool parseTruth(const std::string& text) {
    return parseChoice(text, {"false", "true"}) == 1;
}

template <typename Member>
Setting truth(std::string name, std::string option, Member member, std::string help) {
    Setting setting = row(SettingKind::truth, std::move(name), std::move(option), "", std::move(help));
    setting.set = [=](Request& request, const std::string& text) { member(request) = parseTruth(text); };
    setting.clear = clearing(member);
    setting.text = [=](const Request& request) {
        return std::optional<std::string>(member(request) ? "true" : "false");
    };
    return setting;
}

template <typename Value, typename Member>
Setting choice(std::string name, std::string option, std::vector<std::pair<std::string, Value>> choices, Member member,
               std::string help) {
    std::vector<std::string> names;
    for (const auto& [text, value] : choices) names.push_back(text);
    Setting setting = row(SettingKind::choice, std::move(name), std::move(option),
                          fmt::format("{}", fmt::join(names, "|")), std::move(help));
    setting.choices = names;
    setting.set = [=](Request& request, const std::string& text) {
        member(request) = choices[parseChoice(text, names)].second;
    };
    setting.clear = clearing(member);
    setting.text = [=](const Request& request) -> std::optional<std::string> {
        const auto found = std::ranges::find(choices, member(request), &std::pair<std::string, Value>::second);
        return found == choices.end() ? std::nullopt : std::optional(found->first);
    };
    return setting;
}

template <typename Member>
Setting text(std::string name, std::string option, std::string metavar, Member member, std::string help) {
    Setting setting = row(SettingKind::text, std::move(name), std::move(option), std::move(metavar), std::move(help));
    setting.set = [=](Request& request, const std::string& given) { member(request) = given; };
    setting.clear = clearing(member);
    setting.text = [=](const Request& request) {
        return member(request).empty() ? std::nullopt : std::optional<std::string>(member(request));
    };
    return setting;
}

template <typename Member>
Setting path(std::string name, std::string option, std::string metavar, Member member, std::string help) {
    Setting setting = row(SettingKind::path, std::move(name), std::move(option), std::move(metavar), std::move(help));
    setting.set = [=](Request& request, const std::string& given) { member(request) = given; };
    setting.clear = clearing(member);
    setting.text = [=](const Request& request) {
        return member(request).empty() ? std::nullopt : std::optional(member(request).string());
    };
    return setting;
}

template <typename Set, typename Text>
Setting other(std::string name, std::string option, std::string metavar, Set set, Text text, std::string help) {
    Setting setting = row(SettingKind::other, std::move(name), std::move(option), std::move(metavar), std::move(help));
    setting.set = set;
    setting.text = text;
    setting.clear = [=](Request& request) {
        if (const std::optional<std::string> standard = text(Request{})) set(request, *standard);
    };
    return setting;
}

}  // namespace defocus::setting_kinds
