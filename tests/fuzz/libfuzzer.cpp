// Runs the target that DEFOCUS_FUZZ_TARGET names under clang's libFuzzer. If DEFOCUS_FUZZ_SEEDS names a folder, the
// target's seeds are written to it.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "fuzz/targets.h"

namespace {

const defocus::engine::FuzzTarget* target = nullptr;

// Max CPU seconds for one input. libFuzzer's own limit (-timeout) measures wall-clock time, which grows on a busy
// machine.
constexpr double longestRun = 60;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    const char* const name = std::getenv("DEFOCUS_FUZZ_TARGET");
    try {
        target = &defocus::engine::fuzzTargetNamed(name != nullptr ? name : "");
    } catch (const defocus::Error& error) {
        std::fprintf(stderr, "DEFOCUS_FUZZ_TARGET: %s\n", error.what());
        std::exit(2);
    }
    // By default, libFuzzer generates no input longer than the longest seed.
    static std::string length = "-max_len=" + std::to_string(target->maxBytes);
    static std::vector<char*> words(*arguments, *arguments + *count);
    words.insert(words.begin() + 1, length.data());
    words.push_back(nullptr);
    *count += 1;
    *arguments = words.data();
    if (const char* const folder = std::getenv("DEFOCUS_FUZZ_SEEDS")) {
        std::filesystem::create_directories(folder);
        std::size_t number = 0;
        for (const auto& seed : target->seeds()) {
            if (seed.size() > target->maxBytes) continue;
            std::ofstream(std::filesystem::path(folder) / ("seed-" + std::to_string(number++)), std::ios::binary)
                .write(reinterpret_cast<const char*>(seed.data()), static_cast<std::streamsize>(seed.size()));
        }
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > target->maxBytes) return 0;
    const std::clock_t begin = std::clock();
    target->run(std::as_bytes(std::span(data, size)));
    if (const double seconds = double(std::clock() - begin) / CLOCKS_PER_SEC; seconds > longestRun) {
        std::fprintf(stderr, "SUMMARY: %.0f s of processor time\n", seconds);
        std::abort();
    }
    return 0;
}
