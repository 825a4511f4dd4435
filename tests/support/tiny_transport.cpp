#include "tests/support/tiny_transport.h"

#include "protocol/transport/cell.h"
#include "protocol/transport/transport_writer.h"

#include <cmath>
#include <random>

namespace relume::test {
namespace {

using transport::kBlockSize;
using transport::kColours;

// Draws one cell; its kind decides which encoding it will need.
transport::QuantisedCell random_cell(std::mt19937_64& random, float density) {
    transport::QuantisedCell cell{};
    std::uniform_real_distribution<float> uniform(0, 1);
    if (uniform(random) > density) {
        return cell;
    }
    constexpr float kRareKinds = 0.03F;
    const float kind = uniform(random);
    const int range = kind < kRareKinds ? 100000 : (kind < 3 * kRareKinds ? 2000 : 127);
    const float occupancy = uniform(random);
    std::uniform_int_distribution<int> value(-range, range);
    for (std::int32_t& q : cell) {
        q = uniform(random) < occupancy ? value(random) : 0;
    }
    return cell;
}

transport::Manifest tiny_manifest(const TinyTransportOptions& options) {
    transport::Manifest manifest;
    manifest.generator = "relume tests";
    manifest.fingerprint = options.seed;
    manifest.layout = transport::ReceiverLayout::pixel_tiles(
        {.width = options.width, .height = options.height});
    manifest.signal_basis = options.signal_basis;
    manifest.stating_rows = 256;
    manifest.choosing_rows = 64;
    manifest.colour.channels = options.channels;
    if (options.channels == 1) {
        manifest.colour.matrix = {{{1}, {1}, {1}}};
    } else {
        manifest.colour.matrix = {{{1, 0.5F, 0}, {1, -0.25F, 0.25F}, {1, 0, -0.5F}}};
    }
    return manifest;
}

transport::BakedTables tiny_tables(const transport::Manifest& manifest,
                                   std::mt19937_64& random) {
    transport::BakedTables tables;
    const std::uint32_t channels = manifest.colour.channels;
    const basis::Bands bands = manifest.signal_basis.bands();
    for (std::size_t j = 0; j < manifest.column_count(); ++j) {
        const int band = bands.of_coefficient[j];
        for (std::uint32_t k = 0; k < channels; ++k) {
            tables.steps.push_back(std::ldexp(1e-4F, -(band + static_cast<int>(k))));
        }
    }
    const std::size_t slots = manifest.layout.slot_count();
    std::uniform_real_distribution<float> tint(0.2F, 1);
    tables.coverage.assign(slots, 0);
    tables.tint.assign(slots * kColours, 0);
    const auto add_receiver = [&](std::size_t block, std::size_t slot, float coverage) {
        tables.coverage[block * kBlockSize + slot] = coverage;
        for (std::size_t c = 0; c < kColours; ++c) {
            tables.tint[(block * kColours + c) * kBlockSize + slot] = tint(random);
        }
    };
    if (manifest.kind == transport::Kind::mesh) {
        const transport::VertexClusters& clusters = manifest.layout.clusters();
        for (std::uint32_t block = 0; block < clusters.block_count(); ++block) {
            const auto& cluster = clusters.clusters()[clusters.cluster_of_block(block)];
            for (std::uint32_t slot = 0; slot < cluster.vertices; ++slot) {
                add_receiver(block, slot, 1);
            }
        }
        return tables;
    }
    for (std::uint32_t y = 0; y < manifest.image().height; ++y) {
        for (std::uint32_t x = 0; x < manifest.image().width; ++x) {
            const auto [block, slot] = manifest.image().place_from_pixel(x, y);
            add_receiver(block, slot, y * 4 < manifest.image().height ? 0.5F : 1);
        }
    }
    return tables;
}

}  // namespace

void write_random_transport(const std::filesystem::path& directory,
                            const transport::Manifest& manifest,
                            const TinyTransportOptions& options,
                            const transport::Surface* surface,
                            const transport::VisibilityFieldBuilder* visibility) {
    const transport::ShardPlan plan =
        transport::ShardPlan::equal(manifest.block_count(), options.blocks_per_shard);
    std::mt19937_64 random(options.seed);
    const std::size_t segments =
        std::size_t{manifest.column_count()} * manifest.colour.channels;
    transport::TransportWriter writer(directory, manifest, plan);
    for (std::uint32_t shard = 0; shard < plan.shard_count(); ++shard) {
        std::vector<transport::EncodedBlock> blocks;
        for (std::uint32_t i = 0; i < plan.blocks_in(shard); ++i) {
            blocks.emplace_back(segments);
            for (std::size_t segment = 0; segment < segments; ++segment) {
                blocks.back().append(random_cell(random, options.density));
            }
        }
        writer.write_shard(shard, blocks);
    }
    if (surface != nullptr) {
        writer.write_surface(*surface);
    }
    if (visibility != nullptr) {
        writer.write_visibility(*visibility);
    }
    writer.finish(tiny_tables(manifest, random), {{"note", "random"}});
}

void write_tiny_transport(const std::filesystem::path& directory,
                          const TinyTransportOptions& options) {
    write_random_transport(directory, tiny_manifest(options), options);
}

std::vector<double> dense_product(const transport::Transport& transport,
                                  std::span<const float> lighting) {
    const std::size_t columns = transport.column_count();
    const auto& colour = transport.manifest().colour;
    std::vector<double> sums(std::size_t{transport.manifest().block_count()} * kColours *
                             kBlockSize);
    transport::DecodedCell values;
    for (const transport::ShardReader& shard : transport.shards()) {
        for (std::size_t j = 0; j < columns; ++j) {
            for (std::uint32_t k = 0; k < colour.channels; ++k) {
                const transport::SegmentView segment = shard.segment(j, k);
                if (segment.empty()) {
                    continue;
                }
                const std::uint8_t* cell = segment.cells;
                for (std::uint32_t block = 0; block < shard.block_count(); ++block) {
                    cell = transport::decode_cell(segment.tag(block), cell, values);
                    const std::size_t first =
                        std::size_t{shard.first_block() + block} * kColours * kBlockSize;
                    for (std::size_t c = 0; c < kColours; ++c) {
                        const double weight = double{transport.step(j, k)} *
                                              double{colour.matrix[c][k]} *
                                              double{lighting[c * columns + j]};
                        for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
                            sums[first + c * kBlockSize + slot] +=
                                weight * double{values[slot]};
                        }
                    }
                }
            }
        }
    }
    return sums;
}

void receivers_from_sums(std::vector<double>& sums) {
    constexpr std::size_t kSide = transport::kTileSide;
    for (std::size_t first = 0; first < sums.size(); first += kBlockSize) {
        const std::span<double> block = std::span(sums).subspan(first, kBlockSize);
        const std::vector<double> coefficients(block.begin(), block.end());
        for (std::size_t y = 0; y < kSide; ++y) {
            for (std::size_t x = 0; x < kSide; ++x) {
                double value = coefficients[0] / kSide;
                // Of every level the three wavelets whose support holds the receiver.
                for (std::size_t side = 1; side < kSide; side *= 2) {
                    const std::size_t support = kSide / side;
                    const std::size_t row = y / support;
                    const std::size_t column = x / support;
                    const double along_columns = x % support < support / 2 ? 1 : -1;
                    const double along_rows = y % support < support / 2 ? 1 : -1;
                    // Slots in Z-order: by quarters of quarters, from the largest down.
                    std::size_t z = 0;
                    for (std::size_t half = side / 2; half > 0; half /= 2) {
                        z = 4 * z + 2 * (row / half % 2) + column / half % 2;
                    }
                    const double* wavelets = &coefficients[side * side + 3 * z];
                    value += (along_columns * wavelets[0] + along_rows * wavelets[1] +
                              along_columns * along_rows * wavelets[2]) /
                             static_cast<double>(support);
                }
                block[y * kSide + x] = value;
            }
        }
    }
}

double relative_l2(std::span<const float> a, std::span<const double> b) {
    double difference = 0;
    double norm = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double d = double{a[i]} - b[i];
        difference += d * d;
        norm += b[i] * b[i];
    }
    return std::sqrt(difference / norm);
}

}  // namespace relume::test
