// tinygltf, compiled here and not taken from Debian's shared library: libdraco.so of the same
// Debian carries another tinygltf under the same names, and which of the two a program would
// get is the linker's whim. Files and pictures are not its business (see CMakeLists.txt).
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
