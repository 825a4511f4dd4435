// The surface of a transport of kind `mesh`: what a view needs beside the sums.
#pragma once

#include "protocol/brdf/factored_brdf.h"
#include "protocol/transport/manifest.h"
#include "protocol/transport/surface_mesh.h"
#include "protocol/transport/surface_textures.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace relume::transport {

struct Surface {
    SurfaceMesh mesh;
    std::vector<brdf::FactoredBrdf> brdfs;
    std::vector<SurfaceTexture> textures;
};

// False where a triangle of a material with holes has one: the weights are of its second and
// third corner. Thread-safe.
[[nodiscard]] bool is_solid_at(const Surface& surface,
                               const CutoutRecord& cutout,
                               std::uint32_t triangle,
                               float weight_1,
                               float weight_2);

// The bytes of the files of a surface, with their names for messages.
struct SurfaceFiles {
    struct File {
        std::string name;
        std::span<const std::byte> bytes;
    };
    File mesh;
    File brdfs;
    File textures;
};

// Reads the three files and holds them to the manifest, which is of kind `mesh`: the vertices
// of a triangle are of its material's clusters, a material's BRDF is there and has as many
// lobes as the material and as many terms as its clusters, and its textures are there. Throws
// TransportError naming the file, what was found and what was expected.
[[nodiscard]] Surface surface_from_files(const Manifest& manifest, const SurfaceFiles& files);

}  // namespace relume::transport
