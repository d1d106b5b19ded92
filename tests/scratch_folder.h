#pragma once
// Creates a temporary folder for one test, and removes it at the end of the test.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace defocus::engine {

class ScratchFolder {
public:
    ScratchFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "defocus-test-XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no scratch folder");
        path_ = pattern;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

// Returns the message of the exception of type ErrorType that `body` throws; empty if `body` throws none.
template <typename ErrorType, typename Body>
std::string messageOf(const Body& body) {
    try {
        body();
    } catch (const ErrorType& error) {
        return error.what();
    }
    return {};
}

}  // namespace defocus::engine
