#include "scene/camera_files/usda_layer.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace defocus::engine {

namespace {

constexpr int deepestValue = 16;  // max nesting of lists, tuples and dictionaries
constexpr int deepestPrim = 128;  // max nesting of prims
constexpr std::array listEdits = {"prepend", "append", "add", "delete", "reorder"};
constexpr std::array arcNames = {"references",  "payload",  "inherits", "specializes",
                                 "variantSets", "variants", "subLayers"};

bool contains(const auto& names, std::string_view word) {
    return std::find(std::begin(names), std::end(names), word) != std::end(names);
}

bool inWord(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == ':' || letter == '.' ||
           static_cast<unsigned char>(letter) >= 0x80;
}

class Parser {
public:
    Parser(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    UsdLayer layer() {
        UsdLayer result;
        at_ = std::min(text_.find('\n'), text_.size());  // skips the first line, "#usda 1.0"
        if (next() == '(') metadata(result);
        while (next() != '\0') result.prims.push_back(prim(0));
        return result;
    }

private:
    [[noreturn]] void refuse(const std::string& what) const {
        const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
        fail("{}: line {}: {}", file_, line, what);
    }

    // ---- tokens

    // Skips spaces and comments. Returns the next character; 0 at the end of the text.
    char next() {
        for (; at_ < text_.size(); ++at_) {
            const char letter = text_[at_];
            if (letter == '#')
                at_ = std::min(text_.find('\n', at_), text_.size() - 1);
            else if (std::isspace(static_cast<unsigned char>(letter)) == 0 && letter != ';')
                return letter == '\0' ? '\x01' : letter;
        }
        return '\0';
    }

    bool accept(char letter) {
        if (next() != letter) return false;
        ++at_;
        return true;
    }

    void expect(char letter) {
        if (!accept(letter)) refuse(fmt::format("expected '{}'", letter));
    }

    // Returns the word at the current position without consuming it; empty if there is none.
    std::string_view peekWord() {
        next();
        std::size_t end = at_;
        while (end < text_.size() && inWord(text_[end])) ++end;
        return text_.substr(at_, end - at_);
    }

    std::string word(const char* what) {
        const std::string_view found = peekWord();
        if (found.empty()) refuse(fmt::format("expected {}", what));
        at_ += found.size();
        return std::string(found);
    }

    bool acceptWord(std::string_view expected) {
        if (peekWord() != expected) return false;
        at_ += expected.size();
        return true;
    }

    // Consumes the text up to and including `end`. Returns the text before `end`.
    std::string until(std::string_view end) {
        const std::size_t found = text_.find(end, at_);
        if (found == std::string_view::npos) refuse(fmt::format("there is no closing {}", end));
        const std::string taken(text_.substr(at_, found - at_));
        at_ = found + end.size();
        return taken;
    }

    std::string quoted() {
        const char quote = next();
        if (quote != '"' && quote != '\'') refuse("expected a name in quotes");
        const std::string triple(3, quote);
        if (text_.substr(at_).starts_with(triple)) {
            at_ += 3;
            return until(triple);
        }
        std::string result;
        for (++at_; at_ < text_.size() && text_[at_] != quote && text_[at_] != '\n'; ++at_) {
            if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
            result += text_[at_];
        }
        if (at_ >= text_.size() || text_[at_] != quote) refuse("a string has no closing quote");
        ++at_;
        return result;
    }

    double number() {
        next();
        std::size_t end = at_;
        while (end < text_.size() && (inWord(text_[end]) || text_[end] == '-' || text_[end] == '+') &&
               text_[end] != ':')
            ++end;
        std::string_view digits = text_.substr(at_, end - at_);
        if (digits.starts_with('+')) digits.remove_prefix(1);
        double value = 0;
        const auto [rest, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (digits.empty() || rest != digits.data() + digits.size() || fault == std::errc::invalid_argument)
            refuse(fmt::format("'{}' is not a number", text_.substr(at_, end - at_)));
        if (fault == std::errc::result_out_of_range) refuse("a number is out of range");
        at_ = end;
        return value;
    }

    // ---- values

    void simpleValue(UsdValue& into, bool keep) {
        const char first = next();
        const auto text = [&](std::string found) {
            if (keep) into.texts.push_back(std::move(found));
        };
        if (first == '"' || first == '\'') return text(quoted());
        if (first == '<') {
            ++at_;
            return text(until(">"));
        }
        if (first == '@') {
            const bool triple = text_.substr(at_).starts_with("@@@");
            at_ += triple ? 3 : 1;
            text(until(triple ? "@@@" : "@"));
            if (next() == '<') simpleValue(into, keep);
            return;
        }
        const std::string_view name = peekWord();
        if (name == "None") into.blocked = true;
        const bool infinite = name == "inf" || name == "nan";
        if (!infinite && (std::isalpha(static_cast<unsigned char>(first)) != 0 || first == '_')) {
            at_ += name.size();
            const bool boolean = name == "true" || name == "false";
            if (keep && boolean) into.numbers.push_back(name == "true" ? 1 : 0);
            if (!boolean && !into.blocked) text(std::string(name));
            return;
        }
        const double found = number();
        if (keep) into.numbers.push_back(found);
    }

    // Parses a value. If `keep` is false, only checks the syntax and stores nothing, because the data arrays of meshes
    // are large.
    void value(UsdValue& into, bool keep, int depth = 0) {
        if (depth > deepestValue) refuse("the value is nested too deeply");
        const char first = next();
        if (first == '(' || first == '[') {
            const char last = first == '(' ? ')' : ']';
            for (++at_; !accept(last);) {
                value(into, keep, depth + 1);
                if (next() == '(' && first == '[') skipBlock();  // skips the layer offset of a reference
                if (!accept(',') && next() != last) refuse(fmt::format("expected ',' or '{}'", last));
            }
        } else if (first == '{') {
            skipBlock();
        } else {
            simpleValue(into, keep);
        }
    }

    // Skips a block with its nested blocks: (…), {…} or […].
    void skipBlock() {
        int depth = 0;
        do {
            const char letter = next();
            if (letter == '\0') refuse("a block is not closed");
            if (letter == '"' || letter == '\'' || letter == '@') {
                UsdValue ignored;
                simpleValue(ignored, false);
                continue;
            }
            if (letter == '(' || letter == '{' || letter == '[') ++depth;
            if (letter == ')' || letter == '}' || letter == ']') --depth;
            ++at_;
        } while (depth > 0);
    }

    // ---- metadata

    // Parses metadata in parentheses. Calls `found(key, value)` for each entry.
    template <typename Found>
    void entries(const Found& found) {
        expect('(');
        while (!accept(')')) {
            if (next() == '"' || next() == '\'') {  // documentation, which has no key
                quoted();
                continue;
            }
            std::string key = word("a name or ')'");
            if (contains(listEdits, key)) key = word("a name");
            UsdValue content;
            if (accept('=')) value(content, true);
            if (next() == '(') skipBlock();
            found(key, content);
            accept(',');
        }
    }

    void metadata(UsdLayer& layer) {
        entries([&](const std::string& key, const UsdValue& content) { layer.metadata[key] = content; });
    }

    void metadata(UsdPrim& prim) {
        entries([&](const std::string& key, const UsdValue&) {
            if (contains(arcNames, key) && !contains(prim.arcs, key)) prim.arcs.push_back(key);
        });
    }

    // ---- prims

    void samples(UsdAttribute& attribute, bool keep) {
        expect('{');
        while (!accept('}')) {
            const double time = number();
            expect(':');
            UsdValue content;
            value(content, keep);
            if (keep) attribute.samples.emplace_back(time, std::move(content));
            if (!accept(',') && next() != '}') refuse("expected ',' or '}'");
        }
        std::ranges::stable_sort(attribute.samples, {}, &std::pair<double, UsdValue>::first);
    }

    void property(UsdPrim& prim) {
        std::string type = word("a property, a prim or '}'");
        static constexpr std::array qualifiers = {"custom", "uniform", "varying", "config"};
        while (contains(qualifiers, type) || contains(listEdits, type)) type = word("a type");
        if (accept('[')) expect(']');
        std::string name = word("the name of a property");
        if (type == "nameChildren" || type == "properties") refuse("expected '='");
        constexpr std::string_view timed = ".timeSamples";
        const bool sampled = name.ends_with(timed);
        if (sampled) name.resize(name.size() - timed.size());
        const bool connected = name.ends_with(".connect");
        const bool keep = !connected && type != "rel" && (prim.type == "Camera" || name.starts_with("xformOp"));
        if (accept('=')) {
            UsdAttribute scratch;
            UsdAttribute& attribute = keep ? prim.attributes[name] : scratch;
            if (sampled)
                samples(attribute, keep);
            else
                value(attribute.value, keep);
        }
        if (next() == '(') skipBlock();
    }

    void content(UsdPrim& prim, int depth) {
        const std::string_view first = peekWord();
        if (first == "def" || first == "over" || first == "class") {
            prim.children.push_back(this->prim(depth + 1));
        } else if (acceptWord("variantSet")) {
            quoted();
            expect('=');
            if (next() != '{') refuse("expected '{'");
            skipBlock();
            if (!contains(prim.arcs, "variantSets")) prim.arcs.emplace_back("variantSets");
        } else if (first == "reorder") {
            word("'reorder'");
            word("'nameChildren' or 'properties'");
            expect('=');
            UsdValue ignored;
            value(ignored, false);
        } else {
            property(prim);
        }
    }

    UsdPrim prim(int depth) {
        if (depth > deepestPrim) refuse("the prims are nested too deeply");
        UsdPrim result;
        result.specifier = word("'def', 'over' or 'class'");
        if (result.specifier != "def" && result.specifier != "over" && result.specifier != "class")
            refuse(fmt::format("expected 'def', 'over' or 'class', not '{}'", result.specifier));
        if (next() != '"' && next() != '\'') result.type = word("a type or a name");
        result.name = quoted();
        if (next() == '(') metadata(result);
        expect('{');
        while (!accept('}')) content(result, depth);
        return result;
    }

    std::string_view text_;
    const std::string& file_;
    std::size_t at_ = 0;
};

}  // namespace

UsdLayer parseUsda(std::string_view text, const std::string& file) {
    if (text.starts_with("PXR-USDC"))
        fail("{}: binary USD files cannot be read; convert the file to text with: usdcat {} -o shot.usda", file, file);
    if (text.starts_with("PK\x03\x04"))
        fail("{}: packed USD files (.usdz) cannot be read; unpack the file and convert it to text with usdcat", file);
    if (!text.starts_with("#usda")) fail("{}: not a USD text file: the first line must begin with #usda", file);
    return Parser(text, file).layer();
}

}  // namespace defocus::engine
