// Runs defocus_bench: the program `defocus` (src/cli/run_program.cpp) with the Embree ray tracers added to its table of
// methods.

#include "embree/embree_renderer.h"

namespace defocus::engine {

namespace {

[[maybe_unused]] const bool registered = [] {
    registerEmbree();
    return true;
}();

}  // namespace

}  // namespace defocus::engine
