// What all sessions over one operator share.
#pragma once

#include "server/engine/operators/transport_operator.h"
#include "server/engine/sums/spare_sums.h"

#include <memory>
#include <utility>

namespace relume::engine {

// The operator, and spare sums that its sessions borrow in turn. Only the spare sums change;
// safe to share between threads.
class Workspace {
  public:
    // Not null.
    explicit Workspace(std::shared_ptr<const TransportOperator> transport_operator)
        : operator_(std::move(transport_operator)) {}

    [[nodiscard]] const TransportOperator& transport_operator() const { return *operator_; }
    [[nodiscard]] const ColumnTable& columns() const { return operator_->columns(); }
    // The sums in which sessions make whole products.
    [[nodiscard]] SpareSums& spare_sums() const { return spare_sums_; }

  private:
    std::shared_ptr<const TransportOperator> operator_;
    mutable SpareSums spare_sums_;
};

}  // namespace relume::engine
