#pragma once
// A value of a JSON document together with its location, so that error messages can name the place and the expected
// value.

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

    // Throws Error with the message "FILE: /pointer: message".
    [[noreturn]] void failWith(const std::string& message) const;
    // Throws Error with the message "FILE: /pointer: expected WHAT, not VALUE".
    [[noreturn]] void failExpecting(const std::string& what) const;

    // Throws Error unless the value is an object with keys from `known` only. For an unknown key, the message suggests
    // the nearest.
    void requireObject(const std::vector<std::string>& known) const;
    [[nodiscard]] bool has(const char* key) const { return value_->contains(key); }
    // Returns the member. Throws Error if it is missing.
    [[nodiscard]] JsonReader at(const char* key) const;
    [[nodiscard]] std::optional<JsonReader> find(const char* key) const;
    // Returns the members of an object by name, or of an array in order.
    [[nodiscard]] std::vector<std::pair<std::string, JsonReader>> members() const;
    // Returns the elements of an array. Throws Error unless the value is an array of at least `min` elements.
    [[nodiscard]] std::vector<JsonReader> elements(std::size_t min, const std::string& what) const;

    [[nodiscard]] double number(double min, double max) const;
    [[nodiscard]] std::int64_t integer(std::int64_t min, std::int64_t max) const;
    [[nodiscard]] bool boolean() const;
    [[nodiscard]] std::string text() const;  // a text that isn't empty
    // Returns the index of the text in `choices`.
    [[nodiscard]] std::size_t choice(const std::vector<std::string>& choices) const;
    // Returns three finite numbers; none for any other value.
    [[nodiscard]] std::optional<std::vector<double>> threeNumbers() const;

private:
    const nlohmann::json* value_;
    std::string file_;
    std::string pointer_;
};

}  // namespace defocus::engine
