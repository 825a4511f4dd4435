#include "client/cli/curve_drag.h"

#include "protocol/curve/curve.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::cli {
namespace {

constexpr std::uint32_t kSamples = curve::kCurveSamples;
// Of a stroke, in samples. It begins with two, and every edit adds one or more: what changes
// nothing would not be answered by an image of its own.
constexpr std::uint32_t kBegun = 2;
constexpr std::uint32_t kNarrowest = kBegun + CurveDrag::kEditsPerStroke;
constexpr std::uint32_t kWidest = 96;
constexpr double kMostStops = 2;

}  // namespace

CurveDrag::CurveDrag(std::vector<wire::EditableMaterial> materials, std::uint64_t seed)
    : materials_(std::move(materials)), random_(seed) {}

void CurveDrag::begin_stroke() {
    const auto integer = [&](std::uint32_t lowest, std::uint32_t highest) {
        return std::uniform_int_distribution<std::uint32_t>(lowest, highest)(random_);
    };
    material_ = integer(0, static_cast<std::uint32_t>(materials_.size() - 1));
    count_ = integer(kNarrowest, kWidest);
    first_ = integer(0, kSamples - count_);
    factor_ =
        std::exp2(std::uniform_real_distribution<double>(-kMostStops, kMostStops)(random_));
}

nlohmann::json CurveDrag::next() {
    if (edits_ == 0) {
        begin_stroke();
    }
    edits_ = (edits_ + 1) % kEditsPerStroke;
    const std::uint32_t done = edits_ == 0 ? kEditsPerStroke : edits_;
    const std::uint32_t drawn = kBegun + (count_ - kBegun) * done / kEditsPerStroke;
    const wire::EditableMaterial& material = materials_[material_];
    const wire::NumberTable& baked = material.baked.samples;
    nlohmann::json values = nlohmann::json::array();
    for (std::uint32_t i = 0; i < drawn; ++i) {
        const double way = static_cast<double>(i + 1) / (count_ + 1);
        const double factor = std::pow(factor_, std::sin(std::numbers::pi * way));
        nlohmann::json rgb = nlohmann::json::array();
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double value = baked.numbers[(first_ + i) * std::size_t{3} + channel];
            rgb.push_back(std::min(value * factor, wire::kCurveValue.highest));
        }
        values.push_back(std::move(rgb));
    }
    const auto u = [](std::uint32_t sample) {
        return static_cast<double>(sample) / (kSamples - 1);
    };
    return {{"materials",
             {{material.id,
               {{"stroke",
                 {{"from", u(first_)},
                  {"to", u(first_ + drawn - 1)},
                  {"values", std::move(values)}}}}}}}};
}

}  // namespace relume::cli
