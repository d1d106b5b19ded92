#pragma once
// Reads and writes image files through OpenImageIO: linear float EXR with metadata, tone-mapped PNG and JPEG, textures,
// and HDR environment maps.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/mat4x4.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "image/image.h"
#include "image/tone_map.h"

namespace defocus::engine {

struct Rational {  // fraction, as in EXR's framesPerSecond
    int numerator = 0;
    int denominator = 1;
    bool operator==(const Rational&) const = default;
};
struct TimeCode {  // SMPTE non-drop-frame time code
    int hours = 0;
    int minutes = 0;
    int seconds = 0;
    int frame = 0;
    bool operator==(const TimeCode&) const = default;
};
// Metadata by EXR attribute name. OpenEXR's standard names ("Standard Attributes") are used where they exist: isoSpeed,
// aperture (f-number), focus (m from the entrance pupil), nominalFocalLength (mm), expTime (s), framesPerSecond,
// timeCode, comments, worldToCamera …. All other names have the prefix "defocus:". EXR requires floats under standard
// names, so a double is stored as float under a standard name, and as double under a prefixed name. A glm matrix is
// stored unchanged: EXR's row-major matrices for row vectors equal glm's column-major matrices for column vectors.
// worldToCamera maps to EXR's camera space, which is left-handed and looks along +z. Every EXR file also gets the
// chromaticities of Rec. 709.
using MetadataValue = std::variant<int, double, std::string, glm::mat4, Rational, TimeCode>;
using Metadata = std::map<std::string, MetadataValue>;

// Returns the attribute with this name and type; nullptr if there is none.
template <typename Value>
const Value* attributeOf(const Metadata& metadata, const char* name) {
    const auto found = metadata.find(name);
    return found == metadata.end() ? nullptr : std::get_if<Value>(&found->second);
}

using defocus::compareImages;
using defocus::readImage;
using defocus::writeImage;

// Reads an image like readImage of the public API, and stores the file's attributes in `metadata`, with the names that
// OpenEXR uses. Numeric attributes of PNG files are stored as strings.
Image readImage(const std::filesystem::path& path, Metadata& metadata);

// Reads the same values as readImage, but in strips of rows, for images that do not fit into memory. An image is kept
// in memory if its format's decoder only returns complete images (interlaced PNG, tiled TIFF and EXR).
class StripReader {
public:
    // Throws Error if the file cannot be read.
    explicit StripReader(const std::filesystem::path& path);
    ~StripReader();
    StripReader(StripReader&&) noexcept;

    [[nodiscard]] int width() const;
    [[nodiscard]] int height() const;
    // Returns rows [first, first + count), valid until the next call. Strips may overlap, but must not skip rows, and
    // `first` must not decrease. Throws Error if the rows cannot be read.
    ImageView rows(int first, int count);

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Writes an image like writeImage of the public API, but with metadata. EXR files store all metadata and add capDate if
// it is missing. PNG files store metadata as text; JPEG files store only `comments`.
void writeImage(const std::filesystem::path& path, const ImageView& image, const Metadata& metadata,
                const WriteOptions& options = {});

// Named images of equal size in one EXR file, such as the colours summed over some samples of a frame. Layer NAME has
// the channels NAME.R, NAME.G, NAME.B and NAME.A: 32-bit float, with lossless ZIP compression. Names must not end with
// a dot.
struct ImageLayer {
    std::string name;
    Image image;  // image with 3 or 4 channels
};
// Image whose channels have names in an EXR file.
struct NamedChannels {
    std::vector<std::string> names;  // one per channel of `image`, such as "N.X"
    Image image;
};
// Writes the channels of images of equal size to one EXR file: 32-bit float, with lossless ZIP compression. Throws
// Error if images differ in size or if two channels have the same name.
void writeChannels(const std::filesystem::path& path, const std::vector<NamedChannels>& parts,
                   const Metadata& metadata);

// readLayers returns the layers in alphabetical order, and throws Error in the same cases as readImage and if the file
// has no layers. writeLayers throws Error in the same cases as writeChannels.
void writeLayers(const std::filesystem::path& path, const std::vector<ImageLayer>& layers, const Metadata& metadata);
std::vector<ImageLayer> readLayers(const std::filesystem::path& path, Metadata* metadata = nullptr);

// Returns whether the path's extension is .exr, in lower or upper case.
bool isExr(const std::filesystem::path& path);

// Throws Error if writeImage does not support the extension of `path`.
void checkImageExtension(const std::filesystem::path& path);

// Decodes a PNG, JPEG or WebP file in memory; 16-bit values are reduced to 8 bits. `name` identifies the image in error
// messages. `take` is called with the pixel count before memory is allocated, and may throw.
TextureImage decodeTexture(std::span<const std::byte> encoded, const std::string& name,
                           const std::function<void(std::uint64_t pixels)>& take = {});

}  // namespace defocus::engine
