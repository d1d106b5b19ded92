#pragma once
// A value of a JSON document that knows its place in it, so that each fault can say where it is and what was expected.

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace defocus::engine {

class JsonReader {
public:
    JsonReader(const nlohmann::json& value, std::string file, std::string pointer = "")
        : value_(&value), file_(std::move(file)), pointer_(std::move(pointer)) {}

    [[nodiscard]] const nlohmann::json& value() const { return *value_; }
    [[nodiscard]] const std::string& pointer() const { return pointer_; }

    // "FILE: /pointer: message"
    [[noreturn]] void failWith(const std::string& message) const;
    // "FILE: /pointer: expected WHAT, not VALUE"
    [[noreturn]] void failExpecting(const std::string& what) const;

    // An object none of whose keys is missing in `known`; a fault suggests the nearest.
    void requireObject(const std::vector<std::string>& known) const;
    [[nodiscard]] bool has(const char* key) const { return value_->contains(key); }
    // The member, which must be there.
    [[nodiscard]] JsonReader at(const char* key) const;
    [[nodiscard]] std::optional<JsonReader> find(const char* key) const;
    // The members of an object by name, or of an array in order.
    [[nodiscard]] std::vector<std::pair<std::string, JsonReader>> members() const;
    // Elements of an array of `least` or more.
    [[nodiscard]] std::vector<JsonReader> elements(std::size_t min, const std::string& what) const;

    [[nodiscard]] double number(double min, double max) const;
    [[nodiscard]] std::int64_t integer(std::int64_t min, std::int64_t max) const;
    [[nodiscard]] bool boolean() const;
    [[nodiscard]] std::string text() const;  // not empty
    // The place of the text in `choices`.
    [[nodiscard]] std::size_t choice(const std::vector<std::string>& choices) const;
    // Three finite numbers; nothing for another value.
    [[nodiscard]] std::optional<std::vector<double>> threeNumbers() const;

private:
    const nlohmann::json* value_;
    std::string file_;
    std::string pointer_;
};

}  // namespace defocus::engine
