#include "frame/program_facts.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "defocus/version.h"

namespace defocus::engine {

std::string programVersion() {
    return DEFOCUS_VERSION_STRING;
}

std::string shellWord(const std::string& word) {
    const auto plain = [](char letter) {
        return std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
               std::string_view("_-./,:=+@%").find(letter) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
    std::string quoted = "'";
    for (const char letter : word) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return quoted + "'";
}

std::string commandLine(std::vector<std::string> words) {
    if (words.empty()) return {};
    words.front() = std::filesystem::path(words.front()).filename().string();
    std::string line;
    for (const std::string& word : words) {
        if (!line.empty()) line.push_back(' ');
        line.append(shellWord(word));
    }
    return line;
}

}  // namespace defocus::engine
