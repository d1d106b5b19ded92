#pragma once
// Reader of those parts of USD's text format (.usda) that cameras need: prims, the composition arcs in their metadata,
// and the values of transforms and cameras. Source: the grammar in the USD documentation, "USD ASCII file format".

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace defocus::engine {

// A value whose nested lists and tuples are flattened: a matrix4d is 16 numbers. Each vector is empty if the value has
// another type.
struct UsdValue {
    std::vector<double> numbers;     // booleans are 0 or 1
    std::vector<std::string> texts;  // strings, tokens, paths and assets
    bool blocked = false;            // true: the value is None, with which USD states that there is no value
};

struct UsdAttribute {
    UsdValue value;                                    // value that applies if there are no time samples
    std::vector<std::pair<double, UsdValue>> samples;  // (time code, value), in ascending order
};

struct UsdPrim {
    std::string specifier;  // "def", "over" or "class"
    std::string type;       // "Camera", "Xform", …; empty: the prim has no type
    std::string name;
    std::map<std::string, UsdAttribute, std::less<>> attributes;  // only attributes of transforms and cameras
    std::vector<std::string> arcs;                                // composition arcs: "references", "payload", …
    std::vector<UsdPrim> children;
};

struct UsdLayer {
    std::map<std::string, UsdValue, std::less<>> metadata;
    std::vector<UsdPrim> prims;
};

// Parses a layer. `file`: file name for error messages. Throws Error for binary and zipped USD files, and for text that
// is not .usda; the message contains the line number.
UsdLayer parseUsda(std::string_view text, const std::string& file);

}  // namespace defocus::engine
