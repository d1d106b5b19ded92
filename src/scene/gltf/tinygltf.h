#pragma once
// Includes tinygltf with its namespace renamed. structure.cpp compiles tinygltf into this library; the new name avoids
// clashes with another copy in a program. Internal to the code that reads and writes glTF.

#include <fstream>  // tinygltf needs <fstream>, but does not include it with TINYGLTF_NO_FS

#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define tinygltf defocusTinygltf
#include <tiny_gltf.h>
#undef tinygltf

namespace defocus::engine::gltf {

namespace tinygltf = ::defocusTinygltf;

}  // namespace defocus::engine::gltf
