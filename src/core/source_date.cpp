#include "core/source_date.h"

#include <cstdlib>

#include "core/error.h"
#include "core/parse.h"

namespace defocus::engine {

namespace {

constexpr std::time_t endOf9999 = 253'402'300'799;

}  // namespace

std::optional<std::time_t> sourceDate() {
    const char* const value = std::getenv("SOURCE_DATE_EPOCH");
    if (value == nullptr) return {};
    const std::optional<std::time_t> seconds = parsedNumber<std::time_t>(value);
    return seconds && *seconds >= 0 && *seconds <= endOf9999 ? seconds : std::nullopt;
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
