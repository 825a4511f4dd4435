#include "tests/bench/dense_transport.h"

#include "protocol/transport/hash.h"
#include "protocol/transport/transport_writer.h"

#include <tbb/parallel_for.h>

namespace relume::bench {
namespace {

using transport::kBlockSize;

// Eight values from each hash.
transport::QuantisedCell random_cell(std::uint64_t seed) {
    transport::QuantisedCell cell{};
    for (std::size_t i = 0; i < kBlockSize; i += 8) {
        std::uint64_t bits = transport::mix_bits(seed * kBlockSize + i);
        for (std::size_t k = 0; k < 8; ++k, bits >>= 8U) {
            const auto magnitude = static_cast<std::int32_t>(bits % 127) + 1;
            cell[i + k] = (bits & 0x80U) != 0 ? magnitude : -magnitude;
        }
    }
    return cell;
}

transport::EncodedBlock random_block(std::uint32_t block, std::uint32_t columns) {
    transport::EncodedBlock encoded(columns);
    for (std::uint32_t column = 0; column < columns; ++column) {
        encoded.append(random_cell(std::uint64_t{block} * columns + column));
    }
    return encoded;
}

}  // namespace

void write_dense_transport(const std::filesystem::path& directory,
                           const DenseTransportSize& size) {
    transport::Manifest manifest;
    manifest.generator = "relume-bench";
    manifest.layout =
        transport::ReceiverLayout::pixel_tiles({.width = size.width, .height = size.height});
    manifest.signal_basis = basis::CubemapBasis::haar(size.face_resolution);
    manifest.stating_rows = transport::kMinSketchRows;
    manifest.choosing_rows = transport::kMinSketchRows;
    manifest.colour.matrix = {{{1}, {1}, {1}}};
    const std::uint32_t columns = manifest.column_count();
    const transport::ShardPlan plan =
        transport::ShardPlan::equal(manifest.block_count(), transport::kMaxBlocksPerShard);
    transport::TransportWriter writer(directory, manifest, plan);
    for (std::uint32_t shard = 0; shard < plan.shard_count(); ++shard) {
        std::vector<transport::EncodedBlock> blocks(plan.blocks_in(shard),
                                                    transport::EncodedBlock(0));
        tbb::parallel_for(std::uint32_t{0}, plan.blocks_in(shard), [&](std::uint32_t i) {
            blocks[i] = random_block(plan.first_block(shard) + i, columns);
        });
        writer.write_shard(shard, blocks);
    }
    const std::size_t receivers = std::size_t{manifest.block_count()} * kBlockSize;
    transport::BakedTables tables;
    tables.steps.assign(columns, 1e-3F);
    tables.coverage.assign(receivers, 1.0F);
    tables.tint.assign(receivers * transport::kColours, 1.0F);
    writer.finish(tables, nlohmann::json::object());
}

}  // namespace relume::bench
