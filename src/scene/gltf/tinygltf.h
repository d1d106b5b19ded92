#pragma once
// tinygltf's structures in a renamed namespace. tinygltf is compiled into this library (structure.cpp), and the new
// name avoids clashes with a program's own copy. Internal to the loader.

#include <fstream>  // tinygltf needs it, but does not include it with TINYGLTF_NO_FS

#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define tinygltf defocusTinygltf
#include <tiny_gltf.h>
#undef tinygltf

namespace defocus::engine::gltf {

namespace tinygltf = ::defocusTinygltf;

}  // namespace defocus::engine::gltf
