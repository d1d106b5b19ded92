#include "core/source_date.h"

#include <charconv>
#include <cstdlib>
#include <string_view>

#include "core/error.h"

namespace defocus::engine {

namespace {

constexpr std::time_t endOf9999 = 253'402'300'799;

}  // namespace

std::optional<std::time_t> sourceDate() {
    const char* const value = std::getenv("SOURCE_DATE_EPOCH");
    if (value == nullptr) return {};
    const std::string_view text = value;
    std::time_t seconds = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), seconds);
    if (fault != std::errc() || end != text.data() + text.size() || seconds < 0 || seconds > endOf9999) return {};
    return seconds;
}

void checkSourceDate() {
    const char* const value = std::getenv("SOURCE_DATE_EPOCH");
    if (value != nullptr && !sourceDate())
        fail("SOURCE_DATE_EPOCH is '{}', not a number of seconds from 0 to {}; correct or unset it", value, endOf9999);
}

std::string utcText(std::time_t time, const char* format) {
    std::tm utc{};
    gmtime_r(&time, &utc);
    char text[64];
    return {text, std::strftime(text, sizeof text, format, &utc)};
}

}  // namespace defocus::engine
