#include "tests/lab/cpca/coded_cluster.h"

#include "precompute/bake/blocks/light_model.h"
#include "protocol/basis/cpu_clones.h"
#include "protocol/transport/block_basis.h"
#include "protocol/transport/quantise.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relume::lab {
namespace {

using transport::kBlockSize;
using transport::kDeadZone;

// A value that is just worth storing gains this many squared steps, and takes this many bytes
// with its share of the strips' heads.
constexpr double kGainOfValue =
    double{kDeadZone} * kDeadZone - (2 - double{kDeadZone}) * (2 - double{kDeadZone});
constexpr double kBytesOfValue = 1.25;
constexpr std::int32_t kWeightRange = 32767;
constexpr std::size_t kColumnsAtOnce = 256;

struct FloatSums {
    std::array<float, kBlockSize> natural{};
    std::array<float, kBlockSize> sun{};
    std::array<float, kBlockSize> gain{};
    std::array<float, kBlockSize> nonzeros{};
};

RELUME_CPU_CLONES void add_column(const float* values,
                                  std::size_t count,
                                  float step,
                                  float variance,
                                  float weight,
                                  FloatSums& sums) {
    const float scale = 1 / step;
    const float energy_of_step = step * step;
    for (std::size_t i = 0; i < count; ++i) {
        const float scaled = std::min(std::abs(values[i]) * scale, 0x1p30F);
        const float rounded = static_cast<float>(static_cast<std::int32_t>(scaled + 0.5F));
        const float kept = scaled < kDeadZone ? 0.0F : rounded;
        const float off = scaled - kept;
        const float error = weight * (off * off * energy_of_step);
        sums.natural[i] += variance * error;
        sums.sun[i] += error;
        sums.gain[i] += weight * (scaled * scaled - off * off);
        sums.nonzeros[i] += kept > 0 ? weight : 0.0F;
    }
}

void drain(std::array<float, kBlockSize>& from, std::array<double, kBlockSize>& to) {
    for (std::size_t i = 0; i < kBlockSize; ++i) {
        to[i] += double{from[i]};
        from[i] = 0;
    }
}

}  // namespace

std::vector<float> steps_of_rule(const basis::CubemapBasis& basis, const StepRule& rule) {
    std::vector<float> steps;
    for (std::size_t j = 0; j < basis.coefficient_count(); ++j) {
        const float octave = basis.octave_from_band(basis.band_from_coefficient(j));
        steps.push_back(
            std::min(rule.scale * std::exp2(bake::kStepGrowth * octave), rule.coarsest));
    }
    return steps;
}

Eigen::MatrixXf stored_weights(const Eigen::MatrixXf& weights) {
    Eigen::MatrixXf stored = weights;
    for (Eigen::Index i = 0; i < stored.cols(); ++i) {
        const float largest = stored.col(i).cwiseAbs().maxCoeff();
        const float scale = largest > 0 ? largest / kWeightRange : 1.0F;
        stored.col(i) = (stored.col(i) / scale).array().round() * scale;
    }
    return stored;
}

CodedCluster::CodedCluster(const VertexRows& rows,
                           std::vector<std::uint32_t> members,
                           ClusterBasis basis,
                           float falloff,
                           const LightWeights& lights)
    : rows_(rows),
      members_(std::move(members)),
      basis_(basis),
      lights_(lights),
      planes_(members_.empty() ? 0 : rows.planes[members_.front()]),
      width_(basis == ClusterBasis::haar_line ? kBlockSize : members_.size()) {
    if (basis_ == ClusterBasis::learned) {
        learn(falloff);
    }
    fill();
    add_energies();
}

// The Gram matrix of the members' rows, weighted by column.
void CodedCluster::learn(float falloff) {
    const std::size_t columns = rows_.columns();
    std::vector<float> column_weights(columns);
    for (std::size_t j = 0; j < columns; ++j) {
        column_weights[j] = std::exp2(
            -falloff * rows_.basis.octave_from_band(rows_.basis.band_from_coefficient(j)));
    }
    const auto count = static_cast<Eigen::Index>(members_.size());
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(count, count);
    RowVectors part(count, static_cast<Eigen::Index>(columns));
    for (std::size_t plane = 0; plane < planes_; ++plane) {
        for (Eigen::Index i = 0; i < count; ++i) {
            const float* row =
                &rows_.row(members_[static_cast<std::size_t>(i)])[plane * columns];
            for (std::size_t j = 0; j < columns; ++j) {
                part(i, static_cast<Eigen::Index>(j)) = column_weights[j] * row[j];
            }
        }
        const Eigen::MatrixXf products = part * part.transpose();
        gram += products.cast<double>();
    }
    PrincipalWeights principal = principal_weights(gram);
    weights_ = stored_weights(principal.weights);
    energies_ = std::move(principal.energies);
}

void CodedCluster::fill() {
    const std::size_t columns = rows_.columns();
    coefficients_.resize(planes_ * columns * width_);
    RowVectors values(static_cast<Eigen::Index>(kColumnsAtOnce),
                      static_cast<Eigen::Index>(members_.size()));
    for (std::size_t plane = 0; plane < planes_; ++plane) {
        for (std::size_t first = 0; first < columns; first += kColumnsAtOnce) {
            const std::size_t count = std::min(kColumnsAtOnce, columns - first);
            for (std::size_t i = 0; i < members_.size(); ++i) {
                const float* row = &rows_.row(members_[i])[plane * columns + first];
                for (std::size_t j = 0; j < count; ++j) {
                    values(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = row[j];
                }
            }
            float* out = &coefficients_[(plane * columns + first) * width_];
            if (basis_ == ClusterBasis::learned) {
                Eigen::Map<RowVectors>(out, static_cast<Eigen::Index>(count),
                                       static_cast<Eigen::Index>(width_)) =
                    values.topRows(static_cast<Eigen::Index>(count)) * weights_;
                continue;
            }
            for (std::size_t j = 0; j < count; ++j) {
                const auto own = values.row(static_cast<Eigen::Index>(j));
                float* cell = out + j * width_;
                std::copy_n(own.data(), members_.size(), cell);
                if (basis_ == ClusterBasis::haar_line) {
                    // As bake::encode_block: slots without a vertex get the mean.
                    std::fill(cell + members_.size(), cell + kBlockSize, own.mean());
                    transport::block_coefficients_from_receivers(
                        transport::BlockBasis::haar_line,
                        std::span<float, kBlockSize>(cell, kBlockSize));
                }
            }
        }
    }
}

void CodedCluster::add_energies() {
    const std::size_t columns = rows_.columns();
    for (std::size_t p = 0; p < planes_; ++p) {
        const float* plane = &coefficients_[p * columns * width_];
        for (std::size_t j = 0; j < columns; ++j) {
            for (std::size_t i = 0; i < width_; ++i) {
                const double energy = double{plane[j * width_ + i]} * plane[j * width_ + i];
                natural_energy_[i] += double{lights_.variances[j]} * energy;
                sun_energy_[i] += energy;
            }
        }
        for (std::size_t i = 0; i < width_; ++i) {
            double constant = 0;
            for (const auto& [j, value] : lights_.constant) {
                constant += double{value} * plane[j * width_ + i];
            }
            natural_energy_[i] += constant * constant;
        }
    }
    for (std::size_t i = 0; i < width_; ++i) {
        energy_.natural += natural_energy_[i];
        energy_.sun += sun_energy_[i];
    }
}

void CodedCluster::add_constant_error(std::span<const float> steps, Sums& natural) const {
    const std::size_t columns = rows_.columns();
    for (std::size_t p = 0; p < planes_; ++p) {
        for (std::size_t i = 0; i < width_; ++i) {
            double off = 0;
            for (const auto& [j, value] : lights_.constant) {
                const float exact = coefficients_[(p * columns + j) * width_ + i];
                const auto stored =
                    static_cast<float>(transport::quantised(exact * (1 / steps[j])));
                off += double{value} * (exact - steps[j] * stored);
            }
            natural[i] += off * off;
        }
    }
}

CodedCluster::ComponentSums CodedCluster::sums(std::span<const float> steps,
                                               std::span<const WeighedColumn> columns) const {
    ComponentSums total;
    FloatSums some;
    std::size_t added = 0;
    const auto drain_all = [&] {
        drain(some.natural, total.natural);
        drain(some.sun, total.sun);
        drain(some.gain, total.gain);
        drain(some.nonzeros, total.nonzeros);
    };
    for (std::size_t plane = 0; plane < planes_; ++plane) {
        for (const auto& [j, weight] : columns) {
            add_column(&coefficients_[(plane * rows_.columns() + j) * width_], width_, steps[j],
                       lights_.variances[j], weight, some);
            if (++added % kColumnsAtOnce == 0) {
                drain_all();
            }
        }
    }
    drain_all();
    add_constant_error(steps, total.natural);
    return total;
}

// The prefix whose gain, less what its bytes gain elsewhere, is largest.
std::size_t CodedCluster::worthwhile(const ComponentSums& sums, std::size_t most) const {
    if (basis_ != ClusterBasis::learned) {
        return width_;
    }
    double best = 0;
    double sum = 0;
    std::size_t components = 0;
    const auto own_bytes = static_cast<double>(stored_weight_bytes(members_.size(), 1));
    for (std::size_t i = 0; i < std::min(width_, most); ++i) {
        const double bytes = kBytesOfValue * sums.nonzeros[i] + own_bytes;
        sum += sums.gain[i] - kGainOfValue / kBytesOfValue * bytes;
        if (sum > best) {
            best = sum;
            components = i + 1;
        }
    }
    return components;
}

std::size_t CodedCluster::components(std::span<const float> steps, std::size_t most) const {
    return worthwhile(sums(steps, lights_.all), most);
}

LightSums CodedCluster::error(std::span<const float> steps,
                              std::span<const WeighedColumn> columns,
                              std::size_t most) const {
    const ComponentSums all = sums(steps, columns);
    const std::size_t components = worthwhile(all, most);
    LightSums error;
    for (std::size_t i = 0; i < width_; ++i) {
        error.natural += i < components ? all.natural[i] : natural_energy_[i];
        error.sun += i < components ? all.sun[i] : sun_energy_[i];
    }
    return error;
}

EncodedCluster CodedCluster::encode(std::span<const float> steps,
                                    std::size_t most_components,
                                    const RowVectors& lights) const {
    const std::size_t components = std::min(most_components, width_);
    const std::size_t columns = rows_.columns();
    const auto light_count = static_cast<std::size_t>(lights.cols());
    EncodedCluster encoded{.blocks = {},
                           .components = components,
                           .basis_bytes = basis_ == ClusterBasis::learned
                                              ? stored_weight_bytes(members_.size(), components)
                                              : 0,
                           .bytes_of_band = std::vector<double>(rows_.basis.band_count()),
                           .nonzeros_of_band = std::vector<double>(rows_.basis.band_count()),
                           .answers = std::vector<float>(width_ * planes_ * light_count)};
    for (std::uint32_t first = 0; first < planes_; first += rows_.channels) {
        transport::EncodedBlock& block = encoded.blocks.emplace_back(columns * rows_.channels);
        for (std::size_t j = 0; j < columns; ++j) {
            const std::uint32_t band = rows_.basis.band_from_coefficient(j);
            for (std::uint32_t plane = first; plane < first + rows_.channels; ++plane) {
                const float* values = &coefficients_[(plane * columns + j) * width_];
                transport::QuantisedCell cell{};
                for (std::size_t i = 0; i < components; ++i) {
                    cell[i] = transport::quantised(values[i] * (1 / steps[j]));
                    if (cell[i] == 0) {
                        continue;
                    }
                    ++encoded.nonzeros_of_band[band];
                    const float stored = steps[j] * static_cast<float>(cell[i]);
                    float* answers = &encoded.answers[(i * planes_ + plane) * light_count];
                    const float* light = lights.row(static_cast<Eigen::Index>(j)).data();
                    for (std::size_t l = 0; l < light_count; ++l) {
                        answers[l] += stored * light[l];
                    }
                }
                block.append(cell);
                encoded.bytes_of_band[band] +=
                    static_cast<double>(block.cell(j * rows_.channels + plane - first).size());
            }
        }
    }
    return encoded;
}

void CodedCluster::vertices_from_components(std::span<float> values,
                                            std::size_t components) const {
    if (basis_ == ClusterBasis::haar_line) {
        transport::block_receivers_from_coefficients(transport::BlockBasis::haar_line,
                                                     std::span<float, kBlockSize>(values));
    } else if (basis_ == ClusterBasis::learned) {
        const auto count = static_cast<Eigen::Index>(components);
        const Eigen::VectorXf vertices =
            weights_.leftCols(count) * Eigen::Map<const Eigen::VectorXf>(values.data(), count);
        std::copy_n(vertices.data(), vertices.size(), values.begin());
    }
}

}  // namespace relume::lab
