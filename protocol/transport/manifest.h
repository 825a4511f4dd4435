// manifest.json: what a transport directory is, and the length and checksum of all it holds.
#pragma once

#include "protocol/basis/light_basis.h"
#include "protocol/transport/format.h"

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

// What the transport takes to what: light to the pixels of one camera.
inline constexpr std::string_view kKind = "image";

// As the manifest and people name a basis: "haar", "sh".
[[nodiscard]] std::string_view name_of(basis::LightBasis::Kind kind);
[[nodiscard]] nlohmann::json json_from(const basis::LightBasis& basis);

struct FileRecord {
    std::string file;
    std::uint64_t bytes = 0;
    std::uint64_t checksum = 0;
};

struct ShardRecord {
    std::string file;
    std::uint64_t bytes = 0;
    std::uint64_t header_checksum = 0;
    std::uint32_t first_block = 0;
    std::uint32_t block_count = 0;
};

// Pinhole camera; right, up and forward are orthonormal.
struct CameraRecord {
    Imath::V3f eye{0, 0, 0};
    Imath::V3f right{1, 0, 0};
    Imath::V3f up{0, 1, 0};
    Imath::V3f forward{0, 0, -1};
    float tan_half_width = 1;
    float tan_half_height = 1;

    // Unit direction through the image point (x, y) in pixels, the first pixel's centre being
    // (0.5, 0.5), of an image of width×height.
    [[nodiscard]] Imath::V3f direction_from_pixel(float x,
                                                  float y,
                                                  const TileGrid& image) const;
};

// Colours from stored channels: colour c = Σ_k matrix[c][k]·channel k. Rows beyond `channels`
// are unused and zero.
struct ColourModel {
    std::uint32_t channels = 1;
    std::array<std::array<float, kMaxChannels>, kColours> matrix{};
};

// Relative L2 error that the bake's sampling leaves in an image, over the pixels that see the
// scene, root mean square over lights of a kind: maps that fall off as photographed ones do,
// and one texel of sun.
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
    TileGrid image;
    basis::LightBasis light_basis;
    ColourModel colour;
    std::uint32_t stating_rows = 0;   // of the sketch that states errors
    std::uint32_t choosing_rows = 0;  // of the sketch by which a server chooses what to do
    FileRecord columns;
    FileRecord receivers;
    FileRecord sketch;
    std::vector<ShardRecord> shards;
    CameraRecord camera;
    std::optional<SamplingError> sampling_error;  // where the bake has estimated it
    nlohmann::json bake = nlohmann::json::object();
    nlohmann::json measured = nlohmann::json::object();

    // Coefficients of the basis, N.
    [[nodiscard]] std::uint32_t column_count() const {
        return static_cast<std::uint32_t>(light_basis.coefficient_count());
    }
    [[nodiscard]] std::uint32_t block_count() const { return image.block_count(); }
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
