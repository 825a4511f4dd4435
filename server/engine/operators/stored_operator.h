// The operator of a transport directory. It has the transport twice: by column, as stored, for
// changes of few columns, and arranged block by block for whole products.
#pragma once

#include "protocol/transport/transport.h"
#include "server/engine/operators/strip_matrix.h"
#include "server/engine/operators/transport_operator.h"

#include <cstdint>
#include <memory>
#include <span>

namespace relume::engine {

// Runs are the transport's shards. Sums are in the basis of the blocks, before tint.
class StoredOperator final : public TransportOperator {
  public:
    explicit StoredOperator(std::shared_ptr<const transport::Transport> transport);

    [[nodiscard]] const transport::Transport& transport() const { return *transport_; }
    [[nodiscard]] const StripMatrix& strips() const { return strips_; }
    // Bytes of memory: the transport as read, and the strips.
    [[nodiscard]] std::uint64_t bytes() const {
        return transport_->total_bytes() + strips_.bytes();
    }

    [[nodiscard]] std::size_t run_count() const override;
    [[nodiscard]] BlockRun run(std::size_t number) const override;
    void add(std::size_t run,
             std::span<const ColumnChange> changes,
             const RunSums& targets) const override;
    void set_weights(std::span<const float> signal, Weights& weights) const override;
    void multiply(std::uint32_t block,
                  std::uint32_t band,
                  std::span<const Member> members) const override;
    [[nodiscard]] std::uint32_t bands_of_block(std::uint32_t block) const override;
    [[nodiscard]] std::uint64_t product_bytes_of_block(std::uint32_t block) const override;
    [[nodiscard]] std::uint64_t product_bytes() const override;

  private:
    std::shared_ptr<const transport::Transport> transport_;
    StripMatrix strips_;
};

}  // namespace relume::engine
