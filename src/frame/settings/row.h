#pragma once
// Builds rows of the settings table: one function for each kind of value, and one member of Row for each column. The
// parameter `member` is a callable that takes a Request, const or not, and returns a reference to the setting's value.
// Only the rows*.cpp files use this header.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/parse.h"
#include "frame/settings/settings.h"

namespace defocus::engine {

class Row {
public:
    Row(SettingKind kind, std::string name, std::string option, std::string metavar, std::string help) {
        setting_.kind = kind;
        setting_.name = std::move(name);
        setting_.option = std::move(option);
        setting_.metavar = std::move(metavar);
        setting_.help = std::move(help);
    }

    // The following functions set the columns of the row, which are the members of Setting.
    Row&& kind(SettingKind kind) && { return with(&Setting::kind, kind); }
    Row&& metavar(std::string metavar) && { return with(&Setting::metavar, std::move(metavar)); }
    Row&& unit(std::string unit) && { return with(&Setting::unit, std::move(unit)); }
    Row&& range(double min, double max) && {
        setting_.min = min;
        setting_.max = max;
        return std::move(*this);
    }
    Row&& choices(std::vector<std::string> choices) && { return with(&Setting::choices, std::move(choices)); }
    Row&& everyday(bool everyday = true) && { return with(&Setting::everyday, everyday); }
    Row&& example(std::string example) && { return with(&Setting::example, std::move(example)); }
    Row&& excludes(std::vector<std::string> names) && { return with(&Setting::excludes, std::move(names)); }
    Row&& effect(SettingEffect effect) && {
        setting_.recorded = effect != SettingEffect::run;
        return with(&Setting::effect, effect);
    }
    Row&& recorded() && { return with(&Setting::recorded, true); }
    Row&& keyed() && { return with(&Setting::keyed, true); }
    Row&& lensField() && { return with(&Setting::lensField, true); }
    Row&& inShot(std::string place) && { return with(&Setting::shotPlace, std::move(place)); }
    Row&& json(std::string schema, char arraySeparator = 0) && {
        setting_.arraySeparator = arraySeparator;
        return with(&Setting::schema, std::move(schema));
    }
    Row&& unused(Setting::Unused reason) && { return with(&Setting::unused, std::move(reason)); }

    // Sets the functions that parse and format the value. If a numeric setting also accepts words (its `choices`), the
    // error message for an invalid number lists these words.
    template <typename Set, typename Text>
    Row&& values(Set set, Text text) && {
        setting_.set = set;
        const bool hasWords = setting_.kind == SettingKind::number || setting_.kind == SettingKind::integer;
        if (hasWords && !setting_.choices.empty())
            setting_.set = [set, words = fmt::format("{}", fmt::join(setting_.choices, ", "))](
                               Request& request, const std::string& value) {
                try {
                    set(request, value);
                } catch (const Error& error) {
                    fail("{}, or {}", error.what(), words);
                }
            };
        setting_.text = text;
        return std::move(*this);
    }
    template <typename Set, typename Text, typename Clear>
    Row&& values(Set set, Text text, Clear clear) && {
        setting_.clear = clear;
        return std::move(*this).values(set, text);
    }
    // Defines how the setting is cleared: by restoring the default value of `member`, or by calling `member` if it is a
    // function of a Request.
    template <typename Member>
    Row&& clears(Member member) && {
        if constexpr (std::is_same_v<Member, void (*)(Request&)>)
            setting_.clear = member;
        else
            setting_.clear = [=](Request& request) { member(request) = member(std::as_const(defaultRequest())); };
        return std::move(*this);
    }
    // Marks a setting that may be given several times. `texts` returns all its values.
    Row&& repeats(std::function<std::vector<std::string>(const Request&)> texts) && {
        setting_.repeated = true;
        return with(&Setting::texts, std::move(texts));
    }

    // NOLINTNEXTLINE(google-explicit-constructor): a finished row converts to a Setting
    operator Setting() && { return std::move(setting_); }

private:
    static const Request& defaultRequest() {
        static const Request request;
        return request;
    }
    template <typename Column, typename Value>
    Row&& with(Column Setting::*column, Value value) {
        setting_.*column = std::move(value);
        return std::move(*this);
    }

    Setting setting_;
};

namespace rows {

template <typename Value>
struct IsOptional : std::false_type {};
template <typename Value>
struct IsOptional<std::optional<Value>> : std::true_type {};

// Returns a member's value as an optional. If the member itself is an optional, returns the member unchanged.
template <typename Member>
auto valueOf(const Request& request, Member member) {
    const auto& value = member(request);
    if constexpr (IsOptional<std::decay_t<decltype(value)>>::value)
        return value;
    else
        return std::optional(value);
}

template <typename Member>
Row number(std::string name, std::string option, std::string metavar, double min, double max, Member member,
           std::string help) {
    return Row(SettingKind::number, std::move(name), std::move(option), std::move(metavar), std::move(help))
        .range(min, max)
        .clears(member)
        .values(
            [=](Request& request, const std::string& text) {
                member(request) = parseNumber(text, {min, max});
            },
            [=](const Request& request) -> std::optional<std::string> {
                const std::optional<double> value = valueOf(request, member);
                return value ? std::optional(fmt::format("{}", *value)) : std::nullopt;
            });
}

template <typename Member>
Row integer(std::string name, std::string option, std::uint64_t min, std::uint64_t max, Member member,
            std::string help) {
    return Row(SettingKind::integer, std::move(name), std::move(option), "N", std::move(help))
        .range(static_cast<double>(min), static_cast<double>(max))
        .clears(member)
        .values(
            [=](Request& request, const std::string& text) {
                auto& value = member(request);
                using Value = typename decltype(valueOf(request, member))::value_type;
                value = static_cast<Value>(parseInteger(text, min, max));
            },
            [=](const Request& request) -> std::optional<std::string> {
                const auto value = valueOf(request, member);
                return value ? std::optional(fmt::format("{}", *value)) : std::nullopt;
            });
}

inline bool parseBoolean(const std::string& text) {
    return parseChoice(text, {"false", "true"}) == 1;
}

template <typename Member>
Row boolean(std::string name, std::string option, Member member, std::string help) {
    return Row(SettingKind::boolean, std::move(name), std::move(option), "", std::move(help))
        .clears(member)
        .values([=](Request& request, const std::string& text) { member(request) = parseBoolean(text); },
                [=](const Request& request) { return std::optional<std::string>(member(request) ? "true" : "false"); });
}

// Returns the enumerators from 0 to `last` with their names. `nameOf` returns the name of an enumerator.
template <typename Value, typename Name>
std::vector<std::pair<std::string, Value>> named(const Name& nameOf, Value last) {
    std::vector<std::pair<std::string, Value>> choices;
    for (int i = 0; i <= static_cast<int>(last); ++i) {
        const auto value = static_cast<Value>(i);
        choices.emplace_back(nameOf(value), value);
    }
    return choices;
}

template <typename Value, typename Member>
Row choice(std::string name, std::string option, std::vector<std::pair<std::string, Value>> choices, Member member,
           std::string help) {
    std::vector<std::string> names;
    for (const auto& [text, value] : choices) names.push_back(text);
    return Row(SettingKind::choice, std::move(name), std::move(option), fmt::format("{}", fmt::join(names, "|")),
               std::move(help))
        .choices(names)
        .clears(member)
        .values([=](Request& request,
                    const std::string& text) { member(request) = choices[parseChoice(text, names)].second; },
                [=](const Request& request) -> std::optional<std::string> {
                    const auto found =
                        std::ranges::find(choices, member(request), &std::pair<std::string, Value>::second);
                    return found == choices.end() ? std::nullopt : std::optional(found->first);
                });
}

// Returns a row for a string setting or, with SettingKind::path, for the name of a file or folder. An empty string
// means that the setting is unset.
template <typename Member>
Row words(SettingKind kind, std::string name, std::string option, std::string metavar, Member member,
          std::string help) {
    return Row(kind, std::move(name), std::move(option), std::move(metavar), std::move(help))
        .clears(member)
        .values([=](Request& request, const std::string& text) { member(request) = text; },
                [=](const Request& request) -> std::optional<std::string> {
                    if (member(request).empty()) return std::nullopt;
                    if constexpr (requires { member(request).string(); })
                        return member(request).string();
                    else
                        return member(request);
                });
}

// Returns a row for a value that needs its own functions for parsing and formatting.
template <typename Set, typename Text>
Row other(std::string name, std::string option, std::string metavar, Set set, Text text, std::string help) {
    return Row(SettingKind::other, std::move(name), std::move(option), std::move(metavar), std::move(help))
        .values(set, text);
}

}  // namespace rows

}  // namespace defocus::engine
