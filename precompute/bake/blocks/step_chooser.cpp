#include "precompute/bake/blocks/step_chooser.h"

#include "protocol/transport/block_basis.h"
#include "protocol/transport/cell_cost.h"
#include "protocol/transport/quantise.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace relume::bake {
namespace {

constexpr std::size_t kColumnsPerBand = 256;
// Where [Ng03]'s levels happen to hit every value: no less than this, relative.
constexpr double kFinestError = 1e-5;

float largest(const std::array<float, transport::kBlockSize>& values) {
    float most = 0;
    for (const float value : values) {
        most = std::max(most, std::abs(value));
    }
    return most;
}

// The largest step that holds, of those from a billionth of `high` to all of it.
template <typename Holds>
float largest_within(float high, Holds holds) {
    constexpr float kRange = 0x1p-30F;
    constexpr int kHalvings = 16;
    high = std::max(high, std::numeric_limits<float>::min() / kRange);
    float low = high * kRange;
    for (int i = 0; i < kHalvings; ++i) {
        const float middle = std::sqrt(low * high);
        (holds(middle) ? low : high) = middle;
    }
    return low;
}

}  // namespace

StepChooser::StepChooser(const SignalModel& signals, std::size_t blocks)
    : signals_(signals), blocks_(blocks) {
    std::vector<std::vector<std::uint32_t>> of_band(signals.natural_weight.size());
    for (std::uint32_t j = 0; j < signals.band.size(); ++j) {
        of_band[signals.band[j]].push_back(j);
    }
    for (std::uint32_t band = 0; band < of_band.size(); ++band) {
        const std::size_t all = of_band[band].size();
        const std::size_t kept = std::min(all, kColumnsPerBand);
        for (std::size_t i = 0; i < kept; ++i) {
            columns_.push_back(
                {.index = of_band[band][i * all / kept],
                 .band = band,
                 .weight = static_cast<double>(all) / static_cast<double>(kept)});
        }
    }
    cells_.assign(columns_.size() * blocks_, Cell{});
    is_set_.assign(blocks_, {});
}

void StepChooser::set_row(std::size_t block, std::uint32_t slot, std::span<const float> row) {
    is_set_[block][slot] = true;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        cells_[i * blocks_ + block][slot] = row[columns_[i].index];
    }
}

template <typename Error>
StepChooser::SquaredErrors StepChooser::sum_over_cells(Error error_of) const {
    std::vector<double> errors(columns_.size());
    tbb::parallel_for(std::size_t{0}, columns_.size(), [&](std::size_t i) {
        for (std::size_t block = 0; block < blocks_; ++block) {
            errors[i] += error_of(i, cells_[i * blocks_ + block]);
        }
    });
    SquaredErrors total;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        const Column& column = columns_[i];
        const double error = errors[i] * column.weight;
        total.natural += signals_.natural_weight[column.band] * error;
        // A lone texel's coefficients have the same energy in every band.
        total.lone_light += error;
    }
    return total;
}

// 2^bits levels over the range of each column, rounded to the nearest.
StepChooser::SquaredErrors StepChooser::column_range_errors(std::uint32_t bits) const {
    const auto levels = static_cast<float>((1U << (bits - 1)) - 1);
    std::vector<float> steps(columns_.size(), 0.0F);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        for (std::size_t block = 0; block < blocks_; ++block) {
            steps[i] = std::max(steps[i], largest(cells_[i * blocks_ + block]) / levels);
        }
    }
    return sum_over_cells([&](std::size_t i, const Cell& cell) {
        double error = 0;
        for (const float value : cell) {
            const float difference =
                steps[i] > 0 ? value - steps[i] * std::round(value / steps[i]) : 0.0F;
            error += double{difference} * double{difference};
        }
        return error;
    });
}

template <typename Step>
StepChooser::SquaredErrors StepChooser::errors(Step step) const {
    return sum_over_cells([&](std::size_t i, const Cell& cell) {
        const float size = step(columns_[i]);
        double error = 0;
        for (const float value : cell) {
            const float difference =
                value - size * static_cast<float>(transport::quantised(value / size));
            error += double{difference} * double{difference};
        }
        return error;
    });
}

StepChooser::StepRule StepChooser::rule_for(const SquaredErrors& target) const {
    float high = 0;
    for (const Cell& cell : cells_) {
        high = std::max(high, largest(cell));
    }
    const std::vector<float>& growth = signals_.step_growth;
    return {.scale = largest_within(high,
                                    [&](float candidate) {
                                        return errors([&](const Column& column) {
                                                   return candidate * growth[column.band];
                                               }).natural < target.natural;
                                    }),
            .coarsest = largest_within(high, [&](float step) {
                return errors([&](const Column&) { return step; }).lone_light <
                       target.lone_light;
            })};
}

float StepChooser::step_of_band(const StepRule& rule, std::uint32_t band) const {
    return std::min(rule.scale * signals_.step_growth[band], rule.coarsest);
}

void StepChooser::fill_empty_slots() {
    for (std::size_t block = 0; block < blocks_; ++block) {
        const auto& is_set = is_set_[block];
        const auto count = static_cast<float>(std::count(is_set.begin(), is_set.end(), true));
        for (std::size_t i = 0; count > 0 && i < columns_.size(); ++i) {
            Cell& cell = cells_[i * blocks_ + block];
            float sum = 0;
            for (std::size_t slot = 0; slot < cell.size(); ++slot) {
                sum += is_set[slot] ? cell[slot] : 0.0F;
            }
            for (std::size_t slot = 0; slot < cell.size(); ++slot) {
                cell[slot] = is_set[slot] ? cell[slot] : sum / count;
            }
        }
    }
}

void StepChooser::transform(transport::BlockBasis basis) {
    tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t i) {
        transport::block_coefficients_from_receivers(basis, cells_[i]);
    });
}

double StepChooser::bytes(const StepRule& rule) const {
    std::vector<double> bytes(columns_.size());
    tbb::parallel_for(std::size_t{0}, columns_.size(), [&](std::size_t i) {
        const float step = step_of_band(rule, columns_[i].band);
        for (std::size_t block = 0; block < blocks_; ++block) {
            transport::QuantisedCell quantised{};
            transport::quantise_cell(cells_[i * blocks_ + block], step, quantised);
            const auto shape = transport::CellShape::of(quantised);
            bytes[i] += static_cast<double>(shape.bytes(shape.cheapest()));
        }
    });
    double sum = 0;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        sum += bytes[i] * columns_[i].weight;
    }
    return sum;
}

std::vector<float> StepChooser::steps_of_rule(const StepRule& rule,
                                              const transport::ColourModel& colour) const {
    std::vector<float> steps;
    for (const std::uint32_t band : signals_.band) {
        for (std::uint32_t k = 0; k < colour.channels; ++k) {
            // So that a channel's error weighs alike in the colours.
            double norm = 0;
            for (const auto& row : colour.matrix) {
                norm += double{row[k]} * row[k];
            }
            steps.push_back(step_of_band(rule, band) * static_cast<float>(std::sqrt(3 / norm)));
        }
    }
    return steps;
}

ChosenSteps StepChooser::choose(std::uint32_t bits,
                                const transport::ColourModel& colour,
                                std::span<const transport::BlockBasis> bases) {
    SquaredErrors target = column_range_errors(bits);
    const SquaredErrors energy = sum_over_cells([](std::size_t, const Cell& cell) {
        double sum = 0;
        for (const float value : cell) {
            sum += double{value} * double{value};
        }
        return sum;
    });
    target.natural = std::max(target.natural, kFinestError * kFinestError * energy.natural);
    target.lone_light =
        std::max(target.lone_light, kFinestError * kFinestError * energy.lone_light);
    ChosenSteps chosen;
    double fewest = std::numeric_limits<double>::infinity();
    if (bases.size() == 1) {
        transform(bases.front());
        return {.basis = bases.front(),
                .steps = steps_of_rule(rule_for(target), colour),
                .bytes_of_basis = {}};
    }
    const std::vector<Cell> receivers = cells_;
    for (const transport::BlockBasis basis : bases) {
        cells_ = receivers;
        if (basis != transport::BlockBasis::identity) {
            fill_empty_slots();
        }
        transform(basis);
        const StepRule rule = rule_for(target);
        chosen.bytes_of_basis.push_back({.basis = basis, .bytes = bytes(rule)});
        if (chosen.bytes_of_basis.back().bytes < fewest) {
            fewest = (1 - kWorthwhile) * chosen.bytes_of_basis.back().bytes;
            chosen.basis = basis;
            chosen.steps = steps_of_rule(rule, colour);
        }
    }
    return chosen;
}

}  // namespace relume::bake
