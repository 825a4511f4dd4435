// manifest.json: what a transport directory is, and the length and checksum of all it holds.
#pragma once

#include "protocol/base/text/name_table.h"
#include "protocol/basis/signal_basis.h"
#include "protocol/transport/block_basis.h"
#include "protocol/transport/camera_record.h"
#include "protocol/transport/colour_model.h"
#include "protocol/transport/curves_section.h"
#include "protocol/transport/file_record.h"
#include "protocol/transport/format.h"
#include "protocol/transport/materials_section.h"
#include "protocol/transport/mesh_section.h"
#include "protocol/transport/receiver_layout.h"
#include "protocol/transport/sketch.h"

#include <Imath/ImathVec.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace relume::transport {

// What the signal and the receivers of a transport are. The kind decides which sections its
// manifest has.
//   image   from light to the pixels of one camera: sections image, basis and camera; a block
//           is a tile of pixels, stored in the tile's Haar basis
//   mesh    from light to the vertices of a surface, for cameras that move: sections mesh,
//           basis and camera; a block is one term of a cluster of vertices
//   curves  from curves of materials to the pixels of one camera, under a light that is frozen
//           in it: sections curves and light beside those of an image
enum class Kind : std::uint8_t { image, mesh, curves };

inline constexpr text::NameTable<Kind, 3> kKindNames({{
    {Kind::image, "image"},
    {Kind::mesh, "mesh"},
    {Kind::curves, "curves"},
}});

// As the manifest and people name a basis: "haar", "sh", "daubechies4".
[[nodiscard]] std::string_view name_of(const basis::SignalBasis& basis);
[[nodiscard]] nlohmann::json json_from(const basis::SignalBasis& basis);

struct ShardRecord {
    std::string file;
    std::uint64_t bytes = 0;
    std::uint64_t header_checksum = 0;
    std::uint32_t first_block = 0;
    std::uint32_t block_count = 0;
};

// The relative L2 error that the bake's sampling leaves in an image, over the pixels that see
// the scene, as the root mean square over lights of one kind. Natural lights fall off with
// frequency as photographed maps do; a sun is one bright texel.
struct SamplingError {
    double natural = 0;
    double sun = 0;

    friend bool operator==(const SamplingError&, const SamplingError&) = default;
};
// {"natural", "sun"}; null where there is none.
[[nodiscard]] nlohmann::json json_from(const std::optional<SamplingError>& error);

struct Manifest {
    std::string generator;
    std::uint64_t fingerprint = 0;
    Kind kind = Kind::image;
    ReceiverLayout layout;
    BlockBasis block_basis = BlockBasis::haar_tile;
    basis::SignalBasis signal_basis;
    ColourModel colour;
    std::uint32_t stating_rows = 0;   // of the sketch that states errors
    std::uint32_t choosing_rows = 0;  // of the sketch by which a server chooses what to do
    FileRecord columns;
    FileRecord receivers;
    FileRecord sketch;
    std::vector<ShardRecord> shards;
    CameraRecord camera;
    std::optional<MeshSection> mesh;              // of kind `mesh`
    std::optional<CurvesSection> curves;          // of kind `curves`
    std::optional<MaterialsSection> materials;    // of kind `image` whose materials are edited
    std::optional<VisibilityRecord> visibility;   // of kind `mesh` whose vertices' is known
    std::optional<SamplingError> sampling_error;  // where the bake has estimated it
    nlohmann::json bake = nlohmann::json::object();
    nlohmann::json measured = nlohmann::json::object();

    // Coefficients of the basis, N.
    [[nodiscard]] std::uint32_t column_count() const {
        return static_cast<std::uint32_t>(signal_basis.coefficient_count());
    }
    [[nodiscard]] std::uint32_t block_count() const { return layout.block_count(); }
    // Of a sketch of so many rows.
    [[nodiscard]] SketchStrata sketch_strata(std::uint32_t rows) const {
        return kind == Kind::mesh ? SketchStrata::several(rows, block_count())
                                  : SketchStrata{rows, block_count()};
    }
    // Of kinds `image` and `curves`: how the pixels lie in tiles.
    [[nodiscard]] const TileGrid& image() const { return layout.tiles(); }
};

// Longest manifest read: 16384² pixels have 16384 shards of about 170 bytes of text each.
inline constexpr std::size_t kMaxManifestBytes = std::size_t{8} << 20;

// The file's text, checksum line first. The same manifest gives the same bytes.
[[nodiscard]] std::string text_from_manifest(const Manifest& manifest);
// Throws TransportError naming `file` and the key, what was found and what was expected.
[[nodiscard]] Manifest manifest_from_text(std::string_view json_text, std::string_view file);
// As manifest_from_text, of a file.
[[nodiscard]] Manifest read_manifest(const std::filesystem::path& path);

}  // namespace relume::transport
