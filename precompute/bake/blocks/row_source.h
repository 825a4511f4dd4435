// Rows of receivers, whatever the signal is that they answer to: what blocks are made of.
#pragma once

#include "precompute/bake/blocks/signal_model.h"
#include "precompute/bake/receivers/receivers.h"
#include "precompute/bake/rows/row_baker.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::bake {

class RowSource {
  public:
    RowSource() = default;
    RowSource(const RowSource&) = delete;
    RowSource& operator=(const RowSource&) = delete;
    virtual ~RowSource() = default;

    [[nodiscard]] virtual const Receivers& receivers() const = 0;
    // Of the columns of every row.
    [[nodiscard]] virtual const SignalModel& signals() const = 0;

    // Makes the receivers of these clusters ready to be baked, in parallel; `first_cluster`
    // never decreases. Returns the rays cast.
    virtual std::uint64_t move_to(std::uint32_t first_cluster, std::uint32_t cluster_count) = 0;
    // The rows of a receiver that is ready, as many as it has terms; false, and `rows` left as
    // it is, where it sees nothing. Adds to `rays` those that it casts. Thread-safe while
    // move_to does not run; depends on nothing but the receiver.
    virtual bool bake(std::size_t receiver,
                      std::vector<CoefficientRow>& rows,
                      std::uint64_t& rays) const = 0;
    // As bake, of any receiver and without the help of its neighbours: a look ahead.
    virtual bool bake_alone(std::size_t receiver, std::vector<CoefficientRow>& rows) const = 0;
};

}  // namespace relume::bake
