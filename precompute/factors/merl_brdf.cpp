#include "precompute/factors/merl_brdf.h"

#include "precompute/factors/error.h"
#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>

namespace relume::factors {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr std::array<double, 3> kScales{1.0 / 1500, 1.15 / 1500, 1.66 / 1500};

// Two neighbouring cells and how the second weighs.
struct Between {
    std::size_t first;
    std::size_t second;
    float weight;
};

// `at` counts cells from their beginnings.
Between between_middles(float at, std::size_t count) {
    const float last = static_cast<float>(count - 1);
    const float from_middle = std::clamp(at - 0.5F, 0.0F, last);
    const std::size_t first = std::min(static_cast<std::size_t>(from_middle), count - 2);
    return {first, first + 1, from_middle - static_cast<float>(first)};
}

// The same on a circle, for 0 ≤ at ≤ count.
Between between_on_circle(float at, std::size_t count) {
    const float from_middle = at < 0.5F ? at - 0.5F + static_cast<float>(count) : at - 0.5F;
    const std::size_t first = std::min(static_cast<std::size_t>(from_middle), count - 1);
    return {first, (first + 1) % count, from_middle - static_cast<float>(first)};
}

Imath::V3f mixed(const Imath::V3f& a, const Imath::V3f& b, float weight) {
    return a * (1 - weight) + b * weight;
}

struct Values {
    std::vector<Imath::V3f> cells;
    std::size_t unmeasured = 0;
};

Values values_of(std::span<const std::byte> planes) {
    Values values;
    values.cells.resize(MerlBrdf::kCells);
    for (std::size_t colour = 0; colour < 3; ++colour) {
        for (std::size_t i = 0; i < MerlBrdf::kCells; ++i) {
            double stored = 0;
            std::memcpy(&stored, &planes[(colour * MerlBrdf::kCells + i) * sizeof(double)],
                        sizeof(double));
            const double scaled = stored * kScales[colour];
            if (!(std::fabs(scaled) <= std::numeric_limits<float>::max())) {
                throw FactorError(fmt::format(
                    "value {} of plane {} is {}, expected one finite in single precision", i,
                    colour, stored));
            }
            const auto value = static_cast<float>(scaled);
            values.unmeasured += value < 0 ? 1U : 0U;
            values.cells[i][static_cast<int>(colour)] = std::max(value, 0.0F);
        }
    }
    return values;
}

// Averages the cells of φd and 180° − φd.
void make_even(std::vector<Imath::V3f>& cells) {
    constexpr std::size_t kLine = MerlBrdf::kPhiDifference;
    for (std::size_t line = 0; line < cells.size(); line += kLine) {
        for (std::size_t i = 0; i < kLine / 2; ++i) {
            Imath::V3f& one = cells[line + i];
            Imath::V3f& other = cells[line + kLine - 1 - i];
            one = other = (one + other) * 0.5F;
        }
    }
}

Values parse(std::span<const std::byte> bytes) {
    if (bytes.size() != MerlBrdf::kFileBytes) {
        throw FactorError(
            fmt::format("{} bytes, expected {}", bytes.size(), MerlBrdf::kFileBytes));
    }
    std::array<std::int32_t, 3> counts{};
    std::memcpy(counts.data(), bytes.data(), sizeof(counts));
    if (counts != std::array<std::int32_t, 3>{90, 90, 180}) {
        throw FactorError(
            fmt::format("{}×{}×{} cells, expected 90×90×180", counts[0], counts[1], counts[2]));
    }
    Values values = values_of(bytes.subspan(sizeof(counts)));
    make_even(values.cells);
    return values;
}

}  // namespace

MerlBrdf::MerlBrdf(std::string_view file, std::span<const std::byte> bytes) {
    try {
        Values values = parse(bytes);
        cells_ = std::make_shared<const std::vector<Imath::V3f>>(std::move(values.cells));
        unmeasured_count_ = values.unmeasured;
    } catch (const FactorError& error) {
        throw FactorError(fmt::format("{}: {}", file, error.what()));
    }
}

MerlBrdf MerlBrdf::read(const std::filesystem::path& path) {
    try {
        const std::string bytes = files::read_regular_file(path, kFileBytes);
        return {path.string(), std::as_bytes(std::span(bytes))};
    } catch (const files::FileError& error) {
        throw FactorError(error.what());
    }
}

Imath::V3f MerlBrdf::evaluate(const Imath::V3f& wi, const Imath::V3f& wo) const {
    const Imath::V3f half = (wi + wo).normalized();
    const float sine = std::hypot(half.x, half.y);
    const float theta_half = std::atan2(sine, half.z);
    // The frame of the half vector: x down its meridian, y along its parallel.
    const float cos_phi = sine > 0 ? half.x / sine : 1.0F;
    const float sin_phi = sine > 0 ? half.y / sine : 0.0F;
    const float x = wi.dot({half.z * cos_phi, half.z * sin_phi, -sine});
    const float y = wi.dot({-sin_phi, cos_phi, 0});
    const float theta_difference = std::atan2(std::hypot(x, y), wi.dot(half));
    const float angle = std::atan2(y, x);
    const float phi_difference = angle < 0 ? angle + kPi : angle;

    const Between h = between_middles(
        static_cast<float>(kThetaHalf) * std::sqrt(theta_half / (kPi / 2)), kThetaHalf);
    const Between d = between_middles(
        static_cast<float>(kThetaDifference) * theta_difference / (kPi / 2), kThetaDifference);
    const Between p = between_on_circle(
        static_cast<float>(kPhiDifference) * phi_difference / kPi, kPhiDifference);
    const auto along_phi = [&](std::size_t i, std::size_t j) {
        return mixed(cell(i, j, p.first), cell(i, j, p.second), p.weight);
    };
    const auto along_difference = [&](std::size_t i) {
        return mixed(along_phi(i, d.first), along_phi(i, d.second), d.weight);
    };
    return mixed(along_difference(h.first), along_difference(h.second), h.weight);
}

double MerlBrdf::width_rad() const {
    const auto brightness = [&](std::size_t half) {
        const Imath::V3f& value = cell(half, 0, 0);
        return value.x + value.y + value.z;
    };
    std::size_t half = 0;
    while (half + 1 < kThetaHalf && 2 * brightness(half) > brightness(0)) {
        ++half;
    }
    const double part = (static_cast<double>(half) + 0.5) / static_cast<double>(kThetaHalf);
    // The direction moves twice as far as the half vector.
    return std::min(1.0, 2 * part * part * std::numbers::pi / 2);
}

}  // namespace relume::factors
