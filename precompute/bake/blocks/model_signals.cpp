#include "precompute/bake/blocks/model_signals.h"

#include <numeric>
#include <utility>

namespace relume::bake {
namespace {

double dense_product(std::span<const float> a, std::span<const float> b) {
    // Sums side by side, which the compiler makes one vector.
    constexpr std::size_t kLanes = 8;
    std::array<double, kLanes> sums{};
    std::size_t j = 0;
    for (; j + kLanes <= a.size(); j += kLanes) {
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            sums[lane] += double{a[j + lane]} * double{b[j + lane]};
        }
    }
    double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    for (; j < a.size(); ++j) {
        sum += double{a[j]} * double{b[j]};
    }
    return sum;
}

}  // namespace

ModelSignals::ModelSignals(const SignalModel& model) {
    for (const std::vector<float>& coefficients : model.signals) {
        Signal signal;
        for (std::size_t j = 0; j < coefficients.size(); ++j) {
            if (coefficients[j] != 0) {
                signal.terms.push_back({static_cast<std::uint32_t>(j), coefficients[j]});
            }
        }
        constexpr std::size_t kFewest = 16;  // of which one is a term, lest they cost more
        if (signal.terms.size() * kFewest > coefficients.size()) {
            signal.terms.clear();
            signal.coefficients = coefficients;
        }
        signals_.push_back(std::move(signal));
    }
}

std::array<double, kModelSignals> ModelSignals::products(std::span<const float> row) const {
    std::array<double, kModelSignals> values{};
    for (std::size_t i = 0; i < kModelSignals; ++i) {
        const Signal& signal = signals_[i];
        if (!signal.coefficients.empty()) {
            values[i] = dense_product(row, signal.coefficients);
        }
        for (const auto& [index, value] : signal.terms) {
            values[i] += double{row[index]} * double{value};
        }
    }
    return values;
}

LitColours ModelSignals::colours(const CoefficientRow& row) const {
    LitColours lit;
    for (std::size_t c = 0; c < 3; ++c) {
        const std::array<double, kModelSignals> products_of_row = products(row.rgb[c]);
        for (std::size_t i = 0; i < kModelSignals; ++i) {
            lit[i][c] = products_of_row[i];
        }
    }
    return lit;
}

}  // namespace relume::bake
