// What a manifest of kind `mesh` says of the surface whose vertices are the receivers.
#pragma once

#include "protocol/transport/file_record.h"
#include "protocol/transport/manifest_reader.h"
#include "protocol/transport/receiver_layout.h"

#include <Imath/ImathVec.h>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace relume::transport {

// Where the positions of mesh.bin lie: world = origin + unit · position. Directions are the
// world's.
struct FrameRecord {
    Imath::V3d origin{0, 0, 0};
    double unit = 1;  // positive

    friend bool operator==(const FrameRecord&, const FrameRecord&) = default;
};

// A part of a material's BRDF with a colour of its own: `colour` times, where there is one, the
// texture of that number in textures.bin.
struct LobeRecord {
    Imath::V3f colour{0, 0, 0};  // not negative
    std::optional<std::uint32_t> texture;

    friend bool operator==(const LobeRecord&, const LobeRecord&) = default;
};

// Holes of a material: there is nothing where the red of the texture of that number, bilinear
// between the middles of its texels, is below the cutoff.
struct CutoutRecord {
    std::uint32_t texture = 0;
    float cutoff = 0.5F;

    friend bool operator==(const CutoutRecord&, const CutoutRecord&) = default;
};

struct MaterialRecord {
    std::string name;
    std::uint32_t brdf = 0;         // its number in brdfs.bin
    std::vector<LobeRecord> lobes;  // as many as the BRDF has
    std::optional<CutoutRecord> cutout{};

    friend bool operator==(const MaterialRecord&, const MaterialRecord&) = default;
};

// The camera of such a manifest is where a room begins; it stands in the frame of the surface.
struct MeshSection {
    static constexpr std::uint32_t kMostMaterials = 4096;

    FrameRecord frame;
    TileGrid view;  // the size of image with which a room begins
    std::vector<MaterialRecord> materials;
    FileRecord mesh;
    FileRecord brdfs;
    FileRecord textures;
};

// The section `mesh`, without its files, with the layout's clusters in it. Reading throws
// TransportError naming the key, what was found and what was expected.
[[nodiscard]] nlohmann::json json_from(const MeshSection& mesh, const VertexClusters& clusters);
// Sets all but the files.
[[nodiscard]] MeshSection mesh_section(const ManifestReader& object);
[[nodiscard]] VertexClusters vertex_clusters(const ManifestReader& object,
                                             std::size_t material_count);

}  // namespace relume::transport
