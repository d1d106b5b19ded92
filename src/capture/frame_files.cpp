#include "capture/frame_files.h"

#include <algorithm>
#include <system_error>

#include "core/error.h"
#include "core/file.h"
#include "image/image_io.h"

namespace defocus::engine {

namespace fs = std::filesystem;

void checkFramePattern(const std::string& pattern) {
    const std::string name = fs::path(pattern).filename().string();
    const std::size_t first = name.find('#');
    if (first == std::string::npos)
        fail("{}: the pattern has no frame number; add #### to the file name, as in frames/####.exr", pattern);
    const std::size_t end = std::min(name.find_first_not_of('#', first), name.size());
    if (name.find('#', end) != std::string::npos ||
        fs::path(pattern).parent_path().string().find('#') != std::string::npos)
        fail("{}: the frame number (####) may occur only once, in the file name", pattern);
    checkImageExtension(pattern);
}

fs::path framePath(const std::string& pattern, int frame) {
    const fs::path path(pattern);
    std::string name = path.filename().string();
    const std::size_t first = name.find('#');
    const std::size_t end = std::min(name.find_first_not_of('#', first), name.size());
    name.replace(first, end - first, fmt::format("{:0{}}", frame, end - first));
    return path.parent_path() / name;
}

FrameState frameState(const fs::path& path, int width, int height, const std::string& settings) {
    std::error_code fault;
    if (!fs::is_regular_file(path, fault)) return FrameState::missing;
    try {
        Metadata metadata;
        const Image image = readImage(path, metadata);
        if (image.width != width || image.height != height) return FrameState::other;
        // JPEG files hold the settings hash in their only comment.
        for (const char* name : {settingsAttribute, "comments"})
            if (const std::string* text = attributeOf<std::string>(metadata, name);
                text != nullptr && *text == settings)
                return FrameState::finished;
        return FrameState::other;
    } catch (const Error&) {
        return FrameState::missing;
    }
}

}  // namespace defocus::engine
