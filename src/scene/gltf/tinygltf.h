#pragma once
// tinygltf's structures, under a name of their own: its functions are compiled into this library (structure.cpp), and
// a program that links it may bring its own. Internal to the loader.

#include <fstream>  // which tinygltf leaves out here, but uses

#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define tinygltf defocusTinygltf
#include <tiny_gltf.h>
#undef tinygltf

namespace defocus::engine::gltf {

namespace tinygltf = ::defocusTinygltf;

}  // namespace defocus::engine::gltf
