#include "cli/options/image_output.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <set>
#include <span>
#include <string_view>
#include <system_error>

#include "core/error.h"
#include "core/file.h"

namespace defocus::engine {

namespace {

namespace fs = std::filesystem;

// Returns the file extension for an image on standard output: ".exr" for "exr:-".
std::string streamExtension(const fs::path& output) {
    const std::string text = output.string();
    return text == "-" ? ".png" : "." + text.substr(0, text.find(':'));
}

void writeToStandardOutput(std::span<const std::byte> bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
        fail("cannot write to standard output: {}", std::strerror(errno));
}

// A temporary file that the destructor removes. Image writers need a seekable file, which standard output is not.
class ScratchFile {
public:
    explicit ScratchFile(const std::string& extension) {
        std::string pattern = (fs::temp_directory_path() / ("defocus-XXXXXX" + extension)).string();
        const int descriptor = ::mkstemps(pattern.data(), static_cast<int>(extension.size()));
        if (descriptor < 0) fail("cannot write {}: {}", pattern, std::strerror(errno));
        ::close(descriptor);
        path_ = pattern;
    }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ~ScratchFile() {
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    [[nodiscard]] const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

}  // namespace

CLI::Option* addImageOutputs(CLI::App& command, std::vector<fs::path>& outputs) {
    return command
        .add_option("-o,--output", outputs,
                    "Image file to write: .exr (linear floats with metadata), .png or .jpg (tone-mapped). To write to "
                    "standard output, give - (PNG), exr:- (EXR) or jpg:- (JPEG). Can be given several times")
        ->allow_extra_args(false)
        ->type_name("FILE")
        ->default_str("out.exr");
}

bool isStandardOutput(const fs::path& output) {
    const std::string text = output.string();
    return text == "-" || (text.ends_with(":-") && text.find(':') == text.size() - 2);
}

std::string shownOutput(const fs::path& output) {
    return isStandardOutput(output) ? "standard output" : output.string();
}

std::string shownOutputs(const std::vector<fs::path>& outputs) {
    std::string names;
    for (const fs::path& output : outputs) names += (names.empty() ? "" : ", ") + shownOutput(output);
    return names;
}

namespace {

// Throws Error if two outputs are the same file, or if an output would replace an input.
void checkDistinct(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs) {
    std::set<fs::path> files;
    for (const fs::path& output : outputs) {
        if (isStandardOutput(output)) continue;
        std::error_code missing;
        const fs::path file = fs::weakly_canonical(fs::absolute(output, missing), missing);
        const bool regular = !fs::exists(file, missing) || fs::is_regular_file(file, missing);
        if (regular && !files.insert(file).second)
            fail("{}: this output is given twice; give each output once", output.string());
        for (const fs::path& input : inputs)
            if (!input.empty() && fs::equivalent(input, output, missing))
                fail("{}: the file is also an input; give another output", output.string());
    }
}

}  // namespace

void checkImageOutputs(const std::vector<fs::path>& images, const std::vector<fs::path>& more,
                       const std::vector<fs::path>& inputs) {
    std::vector<fs::path> all = images;
    all.insert(all.end(), more.begin(), more.end());
    if (std::ranges::any_of(all, &fs::path::empty)) fail("an output has an empty name; give a file, such as out.png");
    if (std::ranges::count_if(all, isStandardOutput) > 1) fail("only one output can go to standard output");
    for (const fs::path& path : all)
        if (!isStandardOutput(path)) checkWritable(path);
    checkDistinct(all, inputs);
    for (const fs::path& path : images) {
        checkImageExtension(isStandardOutput(path) ? "standard output" + streamExtension(path) : path.string());
        if (isStandardOutput(path) && ::isatty(STDOUT_FILENO) == 1)
            fail("cannot write an image to a terminal; redirect standard output to a file or a program");
    }
}

void writeOutput(const fs::path& output, const Image& image, const Metadata& metadata, const WriteOptions& options) {
    if (!isStandardOutput(output)) return writeImage(output, image, metadata, options);
    const ScratchFile scratch(streamExtension(output));
    writeImage(scratch.path(), image, metadata, options);
    writeToStandardOutput(readFile(scratch.path()));
}

void writeOutput(const fs::path& output, const std::string& text) {
    if (!isStandardOutput(output)) return writeFile(output, text);
    writeToStandardOutput(std::as_bytes(std::span(text)));
}

}  // namespace defocus::engine
