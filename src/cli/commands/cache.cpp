// defocus cache: lists and removes the simplified meshes in the disk cache.

#include "lod/pyramid/cache.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/options/request_options.h"
#include "core/error.h"

namespace defocus::engine {

namespace {

struct CacheArguments {
    Request request;  // only the request's cache folder is used
};

std::filesystem::path folderOf(const CacheArguments& arguments) {
    const std::filesystem::path folder =
        arguments.request.cacheFolder.empty() ? defaultCacheFolder() : arguments.request.cacheFolder;
    if (folder.empty()) fail("no cache folder: neither XDG_CACHE_HOME nor HOME is set; give a folder with --cache-dir");
    return folder;
}

std::string megabytes(std::uint64_t bytes) {
    return fmt::format("{:.1f} MB", static_cast<double>(bytes) * 1e-6);
}

// Returns the local time, to the minute.
std::string dateText(std::filesystem::file_time_type time) {
    const auto system = std::chrono::file_clock::to_sys(time);
    const auto seconds = std::chrono::time_point_cast<std::chrono::seconds>(system);
    return fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(std::chrono::system_clock::to_time_t(seconds)));
}

// Returns the number and total size of the files, such as "3 files, 12.5 MB".
std::string totalOf(const std::vector<CacheFile>& files) {
    std::uint64_t bytes = 0;
    for (const CacheFile& file : files) bytes += file.bytes;
    return fmt::format("{} file{}, {}", files.size(), files.size() == 1 ? "" : "s", megabytes(bytes));
}

void list(const CacheArguments& arguments) {
    const std::filesystem::path folder = folderOf(arguments);
    const std::vector<CacheFile> files = cacheFiles(folder);
    std::uint64_t triangles = 0;
    if (!files.empty()) fmt::print("{:<25} {:>11}  {:<16}  {:>11}\n", "file", "size", "written", "triangles");
    for (const CacheFile& file : files) {
        fmt::print("{:<25} {:>11}  {:<16}  {:>11}{}\n", file.path.filename().string(), megabytes(file.bytes),
                   dateText(file.written), file.triangles, file.pending ? "  (incomplete)" : "");
        triangles += file.triangles;
    }
    fmt::print("{}, {} triangles in {}\n", totalOf(files), triangles, folder.string());
}

void clear(const CacheArguments& arguments) {
    const std::filesystem::path folder = folderOf(arguments);
    fmt::print("removed {} from {}\n", totalOf(clearCache(folder)), folder.string());
}

}  // namespace

void addCacheCommand(CLI::App& program) {
    auto arguments = std::make_shared<CacheArguments>();
    CLI::App* command = program.add_subcommand("cache", "List or remove cached simplified meshes");
    command->require_subcommand(1);
    const char* example = "Examples:\n  defocus cache list\n  defocus cache clear --cache-dir /tmp/pyramids";

    CLI::App* listing = command->add_subcommand("list", "Print the size, date and triangle count of each file");
    CLI::App* clearing = command->add_subcommand("clear", "Remove the files of the cache");
    for (CLI::App* place : {command, listing, clearing}) {
        addSettings(*place, arguments->request, {"cacheFolder"});
        place->footer(example);
    }
    // Reject an empty folder name, which may come from an unset variable in a script. Otherwise it would select the
    // default folder, and `clear` would remove the files there.
    const auto checked = [arguments, command, listing, clearing](void (*act)(const CacheArguments&)) {
        for (const CLI::App* place : {command, listing, clearing})
            if (place->count("--cache-dir") > 0 && arguments->request.cacheFolder.empty())
                throw UsageError("--cache-dir: the name is empty; give a folder");
        act(*arguments);
    };
    listing->callback([checked] { checked(list); });
    clearing->callback([checked] { checked(clear); });
}

}  // namespace defocus::engine
