// Small valid transport directories made from a seed, and the dense product computed from them
// in the plainest way: what engine, server and file tests compare against.
#pragma once

#include "protocol/transport/transport.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace relume::test {

struct TinyTransportOptions {
    std::uint32_t width = 40;  // not a multiple of a tile, so that edges are ragged
    std::uint32_t height = 24;
    basis::CubemapBasis signal_basis = basis::CubemapBasis::haar(8);
    std::uint32_t channels = 1;  // 1 or 3
    std::uint32_t blocks_per_shard = 3;
    std::uint64_t seed = 1;
    // Of the cells, about this part holds values; of those, values in all encodings occur.
    float density = 0.6F;
};

// Transport values fall off with the band, as they do under smooth receivers.
void write_tiny_transport(const std::filesystem::path& directory,
                          const TinyTransportOptions& options = {});

// Of any manifest: random cells, and a random tint of every receiver. `options` says how many
// blocks make a shard, the density and the seed. A mesh has a surface.
void write_random_transport(const std::filesystem::path& directory,
                            const transport::Manifest& manifest,
                            const TinyTransportOptions& options,
                            const transport::Surface* surface = nullptr,
                            const transport::VisibilityFieldBuilder* visibility = nullptr);

// Σ_j T_j L_j in double precision: [blocks][3][256], before tint. `lighting` is planar [3][N].
[[nodiscard]] std::vector<double> dense_product(const transport::Transport& transport,
                                                std::span<const float> lighting);

// From each block's Haar coefficients to its receivers, by the definition of the basis.
void receivers_from_sums(std::vector<double>& sums);

// ‖a − b‖ / ‖b‖.
[[nodiscard]] double relative_l2(std::span<const float> a, std::span<const double> b);

}  // namespace relume::test
