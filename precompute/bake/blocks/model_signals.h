// The signals of a signal model, and what a row answers to them.
#pragma once

#include "precompute/bake/blocks/signal_model.h"
#include "precompute/bake/rows/row_baker.h"
#include "protocol/basis/cubemap_basis.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

// A receiver in red, green and blue under every signal: the natural ones, then the hard ones.
using LitColours = std::array<std::array<double, 3>, kModelSignals>;

class ModelSignals {
  public:
    explicit ModelSignals(const SignalModel& model);

    // T·L of one row of N coefficients, under every signal.
    [[nodiscard]] std::array<double, kModelSignals> products(std::span<const float> row) const;
    [[nodiscard]] LitColours colours(const CoefficientRow& row) const;

  private:
    struct Signal {
        std::vector<float> coefficients;  // N values, or none where `terms` are few
        std::vector<basis::CubemapBasis::Term> terms;
    };
    std::vector<Signal> signals_;
};

}  // namespace relume::bake
