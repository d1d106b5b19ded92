#pragma once
// Lines for the person at the terminal, on stderr. That nobody can read them is no reason to fail: what can't be
// written is lost, and nothing throws.

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace defocus::engine {

void writeMessage(std::string_view text) noexcept;

// Returns the text without control characters, which a terminal would obey: a '?' stands for each but ends of lines.
std::string printable(std::string_view text);

template <typename... Args>
void printMessage(fmt::format_string<Args...> format, Args&&... args) {
    writeMessage(printable(fmt::format(format, std::forward<Args>(args)...)));
}

// Call first of all: an output that the program was started without (2>&-) becomes one that can't be written to, or
// the next file that is opened would take its number and get what is printed.
void claimClosedOutputs();

}  // namespace defocus::engine
