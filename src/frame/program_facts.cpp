#include "frame/program_facts.h"

#include <filesystem>
#include <iterator>
#include <string_view>
#include <vector>

#include "defocus/version.h"

namespace defocus::engine {

namespace {

std::string quoted(const std::string& word) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.,:=/+@%";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string text(1, '\'');
    for (const char letter : word) {
        if (letter == '\'')
            text.append("'\\''");
        else
            text.push_back(letter);
    }
    text.push_back('\'');
    return text;
}

}  // namespace

std::string programVersion() {
    return DEFOCUS_VERSION_STRING;
}

std::string commandLine(std::vector<std::string> words) {
    if (words.empty()) return {};
    words.front() = std::filesystem::path(words.front()).filename().string();
    std::string line;
    for (const std::string& word : words) {
        if (!line.empty()) line.push_back(' ');
        line.append(quoted(word));
    }
    return line;
}

}  // namespace defocus::engine
