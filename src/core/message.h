#pragma once
// Prints messages to the user on stderr. Write errors are ignored; no function throws.

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace defocus::engine {

void writeMessage(std::string_view text) noexcept;

// Returns the text with each control character replaced by '?', because a terminal would interpret it. Line breaks are
// kept.
std::string printable(std::string_view text);

// Returns `text` truncated to a few hundred bytes, with control characters replaced by spaces, so that an error with
// names from a file stays one short line.
std::string shortLine(std::string text);

template <typename... Args>
void printMessage(fmt::format_string<Args...> format, Args&&... args) {
    writeMessage(printable(fmt::format(format, std::forward<Args>(args)...)));
}

// Opens /dev/null for each of stdin, stdout and stderr that is closed (2>&-). Otherwise the next opened file would get
// that descriptor and receive the program's output. main must call this first.
void claimClosedOutputs();

}  // namespace defocus::engine
