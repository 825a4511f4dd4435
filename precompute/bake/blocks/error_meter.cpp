#include "precompute/bake/blocks/error_meter.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace relume::bake {
namespace {

double relative(double error, double value) {
    return value > 0 ? std::sqrt(error / value) : 0.0;
}

}  // namespace

void ErrorSums::add(const ErrorSums& other) {
    error += other.error;
    value += other.value;
    gradient_error += other.gradient_error;
    gradient += other.gradient;
}

void ErrorMeter::measure_stored(std::span<const float> stored,
                                const Imath::V3f& tint,
                                LitReceiver& light) const {
    const transport::ColourModel& colour = quantisation_.colour;
    const std::size_t columns = stored.size() / colour.channels;
    for (std::size_t k = 0; k < colour.channels; ++k) {
        const auto values = lights_.products(stored.subspan(k * columns, columns));
        for (std::size_t i = 0; i < kModelSignals; ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                light.stored[i][c] +=
                    double{tint[static_cast<int>(c)]} * colour.matrix[c][k] * values[i];
            }
        }
    }
}

BlockErrors ErrorMeter::errors(const ClusterPatch& patch, std::span<const LitReceiver> lit) {
    BlockErrors sums;
    for (std::size_t i = 0; i < kModelSignals; ++i) {
        ErrorSums& sum = sums[i / kSignalsPerKind];
        for (std::size_t c = 0; c < 3; ++c) {
            const auto error = [&](std::size_t p) {
                return lit[p].stored[i][c] - lit[p].exact[i][c];
            };
            const auto value = [&](std::size_t p) { return lit[p].exact[i][c]; };
            for (std::size_t p = 0; p < lit.size(); ++p) {
                sum.error += error(p) * error(p);
                sum.value += value(p) * value(p);
            }
            for (const auto& [a, b] : patch.neighbours) {
                sum.gradient_error += std::pow(error(b) - error(a), 2);
                sum.gradient += std::pow(value(b) - value(a), 2);
            }
        }
    }
    return sums;
}

nlohmann::json json_from_errors(std::span<const BlockErrors> blocks) {
    BlockErrors total;
    for (const BlockErrors& block : blocks) {
        for (std::size_t kind = 0; kind < kSignalKinds; ++kind) {
            total[kind].add(block[kind]);
        }
    }
    const auto json = [](const ErrorSums& sums) {
        return nlohmann::json{{"relative_l2", relative(sums.error, sums.value)},
                              {"relative_h1", relative(sums.gradient_error, sums.gradient)}};
    };
    return {{"natural", json(total[kNatural])}, {"sun", json(total[kSun])}};
}

}  // namespace relume::bake
