// What a bake is of: receivers of one kind, and what a transport of that kind has beside rows.
#pragma once

#include "precompute/bake/blocks/cluster_sample.h"
#include "precompute/bake/blocks/row_source.h"
#include "precompute/bake/fields/field_bake.h"
#include "precompute/bake/receivers/receivers.h"
#include "protocol/transport/manifest.h"
#include "protocol/transport/transport_writer.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace relume::bake {

class BakeSubject {
  public:
    BakeSubject() = default;
    BakeSubject(const BakeSubject&) = delete;
    BakeSubject& operator=(const BakeSubject&) = delete;
    virtual ~BakeSubject() = default;

    [[nodiscard]] virtual const Receivers& receivers() const = 0;
    // Rows of the receivers. The subject outlives them.
    [[nodiscard]] virtual std::unique_ptr<RowSource> rows() const = 0;
    // From a sample for every cluster, of which the rows are baked.
    [[nodiscard]] virtual transport::SamplingError sampling_error(
        std::span<const ClusterSample> samples) const = 0;
    // Throws BakeError where no receiver sees a surface.
    virtual void check() const = 0;
    // Sets what the manifest says of the receivers and of the signal, and the fingerprint of a
    // bake of them by the manifest's generator.
    virtual void describe(transport::Manifest& manifest) const = 0;

    // What was found out about them before the bake: more of the manifest's `measured`.
    [[nodiscard]] virtual nlohmann::json measured() const = 0;

    // How much of each receiver sees the scene, in [0, 1].
    [[nodiscard]] virtual std::vector<float> coverage() = 0;
    // Points whose visibility is stored beside the rows; none: nobody asks for it.
    [[nodiscard]] virtual std::optional<std::uint64_t> field_point_count() const {
        return std::nullopt;
    }
    // Bakes it, before write_tables(). Throws BakeInterrupted, BakeError, files::FileError.
    virtual void bake_fields(const FieldWork& /*work*/) {}
    // Files of the transport that are neither shards nor tables of all kinds.
    virtual void write_tables(transport::TransportWriter& writer) = 0;
    // What people and clients look at beside the finished transport in `directory`. After
    // coverage(). Throws BakeError, files::FileError.
    virtual void write_files(const std::filesystem::path& directory) const = 0;
};

}  // namespace relume::bake
