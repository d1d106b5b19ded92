#include "frame/layer_names.h"

namespace defocus::engine {

namespace {

constexpr LayerNames layerTable[] = {
    {Layer::depth, "depth", "depth", "Depth", {"Z"}},
    {Layer::position, "position", "P", "Position", {"X", "Y", "Z"}},
    {Layer::normal, "normal", "N", "Normal", {"X", "Y", "Z"}},
    {Layer::albedo, "albedo", "albedo", "DiffCol", {"R", "G", "B"}},
    {Layer::emission, "emission", "emission", "Emit", {"R", "G", "B"}},
    {Layer::motion, "motion", "motion", "Vector", {"X", "Y"}},
    {Layer::coc, "coc", "coc", "CoC", {"X"}},
    {Layer::objects, "objects", "CryptoObject", "CryptoObject", {}},
    {Layer::materials, "materials", "CryptoMaterial", "CryptoMaterial", {}},
};

}  // namespace

std::span<const LayerNames> allLayerNames() {
    return layerTable;
}

const LayerNames& layerNames(Layer layer) {
    return layerTable[static_cast<std::size_t>(layer)];
}

}  // namespace defocus::engine
