#pragma once
// Disables Mesa's on-disk shader cache if the disk is nearly full. Mesa maps the cache's index into memory, so a full
// disk would end the process with SIGBUS.

#include <string>

namespace defocus::engine {

// Turns the cache off for this process if the cache's folder has less than 16 MiB of free space. Call it before the
// process creates its first context; later calls do nothing.
void protectShaderCache();

// Returns the warning that protectShaderCache has turned the cache off; empty if the cache is on.
std::string shaderCacheWarning();

}  // namespace defocus::engine
