// Source: glTF 2.0 specification; accessors, data alignment and sparse accessors (3.6.2), normalised integers (3.11).
#include "scene/gltf/accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace defocus::engine::gltf {

namespace {

// Returns the size in bytes of a component type; 0 for types that are not in glTF, such as tinygltf's INT and DOUBLE.
std::size_t componentBytes(int componentType) {
    if (componentType == TINYGLTF_COMPONENT_TYPE_INT || componentType == TINYGLTF_COMPONENT_TYPE_DOUBLE) return 0;
    const int bytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(componentType));
    return static_cast<std::size_t>(std::max(bytes, 0));
}

// Memory layout of an accessor element: `columns` columns of `rows` components. Columns of matrices are aligned to four
// bytes.
struct Layout {
    std::size_t rows = 1;
    std::size_t columns = 1;
    std::size_t componentBytes = 4;
    std::size_t columnBytes = 4;
    [[nodiscard]] std::size_t components() const { return rows * columns; }
    [[nodiscard]] std::size_t elementBytes() const { return columns * columnBytes; }
};

Layout layoutOf(int type, int componentType) {
    const auto components =
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
    Layout layout;
    if (type == TINYGLTF_TYPE_MAT2 || type == TINYGLTF_TYPE_MAT3 || type == TINYGLTF_TYPE_MAT4)
        layout.columns = static_cast<std::size_t>(std::sqrt(components));
    layout.rows = components / layout.columns;
    layout.componentBytes = componentBytes(componentType);
    layout.columnBytes = layout.rows * layout.componentBytes;
    if (layout.columns > 1) layout.columnBytes = (layout.columnBytes + 3) / 4 * 4;
    return layout;
}

const tinygltf::Accessor& accessorAt(const Source& source, int index) {
    return source.model.accessors[static_cast<std::size_t>(index)];
}

// Throws Error unless `count` elements of `elementBytes` bytes, spaced by `stride` bytes from byte `offset`, lie inside
// buffer view `view`.
void checkRange(const Source& source, const std::string& what, int view, std::uint64_t offset, std::uint64_t count,
                std::uint64_t elementBytes, std::uint64_t stride) {
    const std::uint64_t available = viewBytes(source, view).size();
    const bool inside = count == 0 || (offset <= available && elementBytes <= available - offset &&
                                       (count - 1) <= (available - offset - elementBytes) / stride);
    if (!inside)
        fault(source.document, "{}: {} elements from byte {} extend past the end of buffer view {}, which has {} bytes",
              what, count, offset, view, available);
}

std::uint64_t strideOf(const Source& source, const tinygltf::Accessor& accessor, const Layout& layout) {
    const std::uint64_t stride = source.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
    return stride != 0 ? stride : layout.elementBytes();
}

void checkSparse(const Source& source, const tinygltf::Accessor& accessor, const Layout& layout,
                 const std::string& what) {
    const int type = accessor.sparse.indices.componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        fault(source.document, "{}: sparse indices cannot have component type {}", what, type);
    if (accessor.sparse.count < 1 || static_cast<std::size_t>(accessor.sparse.count) > accessor.count)
        fault(source.document, "{}: invalid sparse data: the number of sparse elements is {}, but must be 1 to {}",
              what, accessor.sparse.count, accessor.count);
    if (accessor.sparse.indices.byteOffset < 0 || accessor.sparse.values.byteOffset < 0)
        fault(source.document, "{}: invalid sparse data: a byte offset is negative", what);
    const auto count = static_cast<std::uint64_t>(accessor.sparse.count);
    checkRange(source, what + " (sparse indices)", accessor.sparse.indices.bufferView,
               static_cast<std::uint64_t>(accessor.sparse.indices.byteOffset), count, componentBytes(type),
               componentBytes(type));
    checkRange(source, what + " (sparse values)", accessor.sparse.values.bufferView,
               static_cast<std::uint64_t>(accessor.sparse.values.byteOffset), count, layout.elementBytes(),
               layout.elementBytes());
}

template <typename T>
double loadAs(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

double loadComponent(const std::byte* bytes, int componentType) {
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return loadAs<std::int8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return loadAs<std::uint8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return loadAs<std::int16_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return loadAs<std::uint16_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return loadAs<std::uint32_t>(bytes);
        default:
            return loadAs<float>(bytes);
    }
}

// Calls store(element, component, value) for each component of an accessor. Values of sparse elements come last, so
// that they replace the values of the buffer view.
template <typename Store>
void forEachComponent(const Source& source, int index, const std::string& what, const Store& store) {
    const tinygltf::Accessor& accessor = accessorAt(source, index);
    const Layout layout = layoutOf(accessor.type, accessor.componentType);
    const auto storeElement = [&](std::size_t element, const std::byte* bytes) {
        for (std::size_t column = 0; column < layout.columns; ++column)
            for (std::size_t row = 0; row < layout.rows; ++row)
                store(element, column * layout.rows + row,
                      loadComponent(bytes + column * layout.columnBytes + row * layout.componentBytes,
                                    accessor.componentType));
    };
    if (accessor.bufferView >= 0) {
        const std::byte* first = viewBytes(source, accessor.bufferView).data() + accessor.byteOffset;
        const std::uint64_t stride = strideOf(source, accessor, layout);
        for (std::size_t i = 0; i < accessor.count; ++i) storeElement(i, first + i * stride);
    }
    if (!accessor.sparse.isSparse) return;
    const int indexType = accessor.sparse.indices.componentType;
    const std::byte* indices = viewBytes(source, accessor.sparse.indices.bufferView).data() +
                               static_cast<std::size_t>(accessor.sparse.indices.byteOffset);
    const std::byte* values = viewBytes(source, accessor.sparse.values.bufferView).data() +
                              static_cast<std::size_t>(accessor.sparse.values.byteOffset);
    for (std::size_t i = 0; i < static_cast<std::size_t>(accessor.sparse.count); ++i) {
        const auto element =
            static_cast<std::size_t>(loadComponent(indices + i * componentBytes(indexType), indexType));
        if (element >= accessor.count)
            fault(source.document, "{}: sparse index {} is out of range; there are {} elements", what, element,
                  accessor.count);
        storeElement(element, values + i * layout.elementBytes());
    }
}

void checkComponents(const Source& source, int accessor, int components, const std::string& what) {
    if (componentCount(source, accessor) != components)
        fault(source.document, "{}: accessor {} has {} components per element, not {}", what, accessor,
              componentCount(source, accessor), components);
}

}  // namespace

void checkAccessors(const Source& source) {
    for (std::size_t i = 0; i < source.model.accessors.size(); ++i) {
        const tinygltf::Accessor& accessor = source.model.accessors[i];
        const std::string what = fmt::format("accessor {}", i);
        if (componentBytes(accessor.componentType) == 0)
            fault(source.document, "{}: unknown component type {}", what, accessor.componentType);
        if (accessor.count == 0) fault(source.document, "{}: it has no elements", what);
        const Layout layout = layoutOf(accessor.type, accessor.componentType);
        if (accessor.bufferView >= 0)
            checkRange(source, what, accessor.bufferView, accessor.byteOffset, accessor.count, layout.elementBytes(),
                       strideOf(source, accessor, layout));
        if (accessor.sparse.isSparse) checkSparse(source, accessor, layout, what);
    }
}

std::size_t elementCount(const Source& source, int accessor) {
    return accessorAt(source, accessor).count;
}

int componentCount(const Source& source, int accessor) {
    const tinygltf::Accessor& found = accessorAt(source, accessor);
    return static_cast<int>(layoutOf(found.type, found.componentType).components());
}

double normalisationScale(const Source& source, int accessor) {
    const tinygltf::Accessor& found = accessorAt(source, accessor);
    if (!found.normalized) return 1.0;
    switch (found.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return 127.0;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 255.0;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return 32767.0;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 65535.0;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return 4294967295.0;
        default:
            return 1.0;
    }
}

std::vector<float> readFloats(Source& source, int accessor, int components, const std::string& what) {
    checkComponents(source, accessor, components, what);
    const auto perElement = static_cast<std::size_t>(components);
    takeBudget(source, elementCount(source, accessor), perElement * sizeof(float), what);
    std::vector<float> result(elementCount(source, accessor) * perElement);
    const double scale = normalisationScale(source, accessor);
    // Clamp signed normalised integers to −1, because −128/127 and −32768/32767 are less than −1 (glTF 2.0
    // specification, section 3.11).
    const bool clamps = scale != 1.0;
    forEachComponent(source, accessor, what, [&](std::size_t element, std::size_t component, double value) {
        result[element * perElement + component] = static_cast<float>(clamps ? std::max(value / scale, -1.0) : value);
    });
    return result;
}

std::vector<std::uint32_t> readIntegers(Source& source, int accessor, int components, const std::string& what) {
    checkComponents(source, accessor, components, what);
    const int type = accessorAt(source, accessor).componentType;
    if (type == TINYGLTF_COMPONENT_TYPE_FLOAT || type == TINYGLTF_COMPONENT_TYPE_BYTE ||
        type == TINYGLTF_COMPONENT_TYPE_SHORT)
        fault(source.document, "{}: accessor {} must hold unsigned integers", what, accessor);
    const auto perElement = static_cast<std::size_t>(components);
    takeBudget(source, elementCount(source, accessor), perElement * sizeof(std::uint32_t), what);
    std::vector<std::uint32_t> result(elementCount(source, accessor) * perElement);
    forEachComponent(source, accessor, what, [&](std::size_t element, std::size_t component, double value) {
        result[element * perElement + component] = static_cast<std::uint32_t>(value);
    });
    return result;
}

}  // namespace defocus::engine::gltf
