#include "core/message.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace defocus::engine {

namespace {

constexpr std::size_t longestMessage = 400;  // max length of a message, bytes

}  // namespace

void writeMessage(std::string_view text) noexcept {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

std::string printable(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
        const bool c0 = (byte < 0x20 && byte != '\n') || byte == 0x7F;
        const bool c1 = byte == 0xC2 && next >= 0x80 && next < 0xA0;  // C1 control character: two bytes in UTF-8
        result.push_back(c0 || c1 ? '?' : text[i]);
        if (c1) ++i;
    }
    return result;
}

std::string shortLine(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
    if (text.size() <= longestMessage) return text;
    std::size_t end = longestMessage;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // keeps UTF-8 characters intact
    return text.substr(0, end) + "…";
}

void claimClosedOutputs() {
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor)
        if (::fcntl(descriptor, F_GETFD) < 0)
            static_cast<void>(::open("/dev/null", O_RDONLY));  // opens this descriptor, the lowest free one
}

}  // namespace defocus::engine
