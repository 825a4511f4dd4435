#include "server/engine/error_estimate.h"

#include "server/engine/kernels/vector_loops.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace relume::engine {
namespace {

using transport::kColours;

// Float sums of this many columns, then double: fast, and the error stays near float's epsilon.
constexpr std::size_t kColumnsPerChunk = 256;

double squared_norm(std::span<const double> values) {
    double sum = 0;
    for (const double value : values) {
        sum += value * value;
    }
    return sum;
}

}  // namespace

ErrorEstimate::ErrorEstimate(const Scene& scene)
    : scene_(&scene),
      target_(kColours * scene.transport().manifest().sketch_rows),
      approximation_(target_.size()) {}

ErrorEstimate::Sketch ErrorEstimate::sketch_of(std::span<const float> lighting) const {
    const transport::Transport& transport = scene_->transport();
    const std::size_t rows = transport.manifest().sketch_rows;
    const std::size_t columns = scene_->coefficient_count();
    const std::size_t chunks = (columns + kColumnsPerChunk - 1) / kColumnsPerChunk;
    std::vector<float> partial(chunks * kColours * rows);
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
        const std::span<float> sums =
            std::span(partial).subspan(chunk * kColours * rows, kColours * rows);
        const std::size_t end = std::min(columns, (chunk + 1) * kColumnsPerChunk);
        for (std::size_t j = chunk * kColumnsPerChunk; j < end; ++j) {
            for (std::uint32_t c = 0; c < kColours; ++c) {
                const float weight = lighting[c * columns + j] * transport.sketch_scale(j, c);
                if (weight != 0) {
                    add_scaled(transport.sketch(j, c), weight, sums.subspan(c * rows, rows));
                }
            }
        }
    });
    Sketch sketch(kColours * rows);
    for (std::size_t i = 0; i < partial.size(); ++i) {
        sketch[i % sketch.size()] += double{partial[i]};
    }
    return sketch;
}

void ErrorEstimate::set_target(std::span<const float> lighting) {
    target_ = sketch_of(lighting);
}

void ErrorEstimate::set_approximation(std::span<const float> lighting) {
    approximation_ = sketch_of(lighting);
}

void ErrorEstimate::change_approximation(std::span<const ColumnChange> changes) {
    const transport::Transport& transport = scene_->transport();
    const std::size_t rows = transport.manifest().sketch_rows;
    for (const ColumnChange& change : changes) {
        for (std::uint32_t c = 0; c < kColours; ++c) {
            const double weight =
                double{change.amount[c]} * double{transport.sketch_scale(change.column, c)};
            const auto values = transport.sketch(change.column, c);
            for (std::size_t r = 0; r < rows; ++r) {
                approximation_[c * rows + r] += weight * static_cast<double>(values[r]);
            }
        }
    }
}

double ErrorEstimate::relative_l2() const {
    double squared_difference = 0;
    for (std::size_t i = 0; i < target_.size(); ++i) {
        const double difference = target_[i] - approximation_[i];
        squared_difference += difference * difference;
    }
    const double norm = squared_norm(target_);
    if (norm == 0) {
        return squared_difference == 0 ? 0 : 1;
    }
    return std::sqrt(squared_difference / norm);
}

double ErrorEstimate::shown_norm() const {
    return std::sqrt(squared_norm(approximation_));
}

}  // namespace relume::engine
