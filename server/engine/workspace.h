// What all sessions over one operator share.
#pragma once

#include "server/engine/operators/transport_operator.h"
#include "server/engine/sums/spare_sums.h"

#include <memory>
#include <utility>

namespace relume::engine {

// The operator, and the sums that its sessions lend one another. Immutable but for what it
// lends; safe to share between threads.
class Workspace {
  public:
    // Not null.
    explicit Workspace(std::shared_ptr<const TransportOperator> transport_operator)
        : operator_(std::move(transport_operator)) {}

    [[nodiscard]] const TransportOperator& transport_operator() const { return *operator_; }
    [[nodiscard]] const ColumnTable& columns() const { return operator_->columns(); }
    // Where sessions borrow the sums that they make whole products in.
    [[nodiscard]] SpareSums& spare_sums() const { return spare_sums_; }

  private:
    std::shared_ptr<const TransportOperator> operator_;
    mutable SpareSums spare_sums_;
};

}  // namespace relume::engine
