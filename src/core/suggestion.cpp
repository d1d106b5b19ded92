// Source: F. J. Damerau, "A technique for computer detection and correction of spelling errors", 1964.

#include "core/suggestion.h"

#include <algorithm>

namespace defocus::engine {

namespace {

std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> distance(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) distance[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) distance[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substitution = a[i - 1] == b[j - 1] ? 0 : 1;
            distance[i][j] =
                std::min({distance[i - 1][j] + 1, distance[i][j - 1] + 1, distance[i - 1][j - 1] + substitution});
            const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) distance[i][j] = std::min(distance[i][j], distance[i - 2][j - 2] + 1);
        }
    }
    return distance[a.size()][b.size()];
}

std::string inSmallLetters(std::string_view text) {
    std::string result(text);
    for (char& letter : result)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    return result;
}

}  // namespace

std::string nearestWord(std::string_view word, const std::vector<std::string>& known) {
    constexpr std::size_t longestWord = 64;  // max bytes of a word; limits the cost of the edit distance
    if (word.size() > longestWord) return {};
    const std::string small = inSmallLetters(word);
    std::string nearest;
    std::size_t min = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string& candidate : known) {
        const std::size_t distance = editDistance(small, inSmallLetters(candidate));
        if (distance < min) {
            min = distance;
            nearest = candidate;
        }
    }
    constexpr std::size_t shortestPart = 3;
    if (!nearest.empty() || word.size() < shortestPart) return nearest;
    for (const std::string& candidate : known)
        if (inSmallLetters(candidate).find(small) != std::string::npos &&
            (nearest.empty() || candidate.size() < nearest.size()))
            nearest = candidate;
    return nearest;
}

std::optional<std::size_t> placeOfName(std::string_view name, const std::vector<std::string>& known) {
    const auto placeOf = [&](const auto& found) -> std::size_t {
        return static_cast<std::size_t>(found - known.begin());
    };
    if (const auto same = std::ranges::find(known, name); same != known.end()) return placeOf(same);
    const auto alike = [small = inSmallLetters(name)](const std::string& each) {
        return inSmallLetters(each) == small;
    };
    const auto first = std::ranges::find_if(known, alike);
    if (first == known.end()) return {};
    const auto other = [&](const std::string& each) { return each != *first && alike(each); };
    if (std::find_if(first + 1, known.end(), other) != known.end()) return {};
    return placeOf(first);
}

}  // namespace defocus::engine
