#pragma once
// Reads values of a JSON document. A reader knows the location of its value in the document, so that error messages can
// contain the location and the expected value.

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

    // Throws Error unless the value is an object whose keys all occur in `known`. The message suggests the known key
    // nearest to an unknown one.
    void requireObject(const std::vector<std::string>& known) const;
    [[nodiscard]] bool has(const char* key) const { return value_->contains(key); }
    // Returns the object's member `key`. Throws Error if it is missing.
    [[nodiscard]] JsonReader at(const char* key) const;
    [[nodiscard]] std::optional<JsonReader> find(const char* key) const;
    // Returns an object's members with their names, or an array's elements with their indices, in order.
    [[nodiscard]] std::vector<std::pair<std::string, JsonReader>> members() const;
    // Returns the elements of an array. Throws Error unless the value is an array with at least `min` elements.
    [[nodiscard]] std::vector<JsonReader> elements(std::size_t min, const std::string& what) const;

    [[nodiscard]] double number(double min, double max) const;
    [[nodiscard]] std::int64_t integer(std::int64_t min, std::int64_t max) const;
    [[nodiscard]] bool boolean() const;
    [[nodiscard]] std::string text() const;  // throws Error unless the value is a non-empty string
    // Returns the index of the value in `choices`. Throws Error if `choices` doesn't contain the value.
    [[nodiscard]] std::size_t choice(const std::vector<std::string>& choices) const;
    // Returns the value if it is an array of three finite numbers, else nullopt.
    [[nodiscard]] std::optional<std::vector<double>> threeNumbers() const;

private:
    const nlohmann::json* value_;
    std::string file_;
    std::string pointer_;
};

}  // namespace defocus::engine
