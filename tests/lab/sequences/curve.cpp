#include "tests/lab/sequences/curve.h"

#include "protocol/base/text/name_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

namespace relume::lab {
namespace {

constexpr text::NameTable<Curve::Way, 4> kWayNames({{
    {Curve::Way::linear, "linear"},
    {Curve::Way::slow_fast_slow, "slow-fast-slow"},
    {Curve::Way::geometric, "geometric"},
    {Curve::Way::hold, "hold"},
}});

double between(const Curve::Key& a, const Curve::Key& b, double t, Curve::Way way) {
    constexpr double kTurn = 2 * std::numbers::pi;
    switch (way) {
        case Curve::Way::hold:
            return a.value;
        case Curve::Way::geometric:
            return a.value * std::pow(b.value / a.value, t);
        case Curve::Way::slow_fast_slow:
            t -= std::sin(kTurn * t) / kTurn;
            break;
        case Curve::Way::linear:
            break;
    }
    return a.value + (b.value - a.value) * t;
}

double value_at(const Curve::Keys& curve, std::uint32_t image, std::uint64_t /*seed*/) {
    const auto next =
        std::find_if(curve.keys.begin(), curve.keys.end(),
                     [image](const Curve::Key& key) { return key.image > image; });
    if (next == curve.keys.begin()) {
        return next->value;
    }
    const auto last = next - 1;
    if (next == curve.keys.end()) {
        return last->value;
    }
    const double t = static_cast<double>(image - last->image) /
                     static_cast<double>(next->image - last->image);
    return between(*last, *next, t, curve.way);
}

double value_at(const Curve::Samples& curve, std::uint32_t image, std::uint64_t /*seed*/) {
    return curve.values[std::min<std::size_t>(image, curve.values.size() - 1)];
}

double value_at(const Curve::Random& curve, std::uint32_t image, std::uint64_t seed) {
    // The standard fixes the numbers of both, unlike those of its distributions.
    std::seed_seq sequence{seed & 0xFFFFFFFFU, seed >> 32U, curve.stream,
                           std::uint64_t{image / curve.every}};
    std::mt19937_64 random(sequence);
    const double t = std::ldexp(static_cast<double>(random() >> 11U), -53);
    return between({0, curve.from}, {1, curve.to}, t,
                   curve.geometric ? Curve::Way::geometric : Curve::Way::linear);
}

std::uint32_t rest_of(const Curve::Keys& curve) {
    return curve.keys.size() == 1 ? 0 : curve.keys.back().image;
}

std::uint32_t rest_of(const Curve::Samples& curve) {
    const auto last_other =
        std::find_if(curve.values.rbegin(), curve.values.rend(),
                     [&](double value) { return value != curve.values.back(); });
    return static_cast<std::uint32_t>(curve.values.rend() - last_other);
}

std::uint32_t rest_of(const Curve::Random& /*curve*/) {
    return Curve::kNever;
}

[[noreturn]] void refuse(const std::string& where,
                         const nlohmann::json& found,
                         std::string_view expected) {
    throw std::invalid_argument(
        fmt::format("{}: found {}, expected {}", where, found.dump(), expected));
}

// A whole number from 0 on.
bool is_count(const nlohmann::json& json) {
    return json.is_number_integer() && json >= 0;
}

Curve::Way way_from_json(const nlohmann::json& json, const std::string& where) {
    const auto found = json.find("way");
    if (found == json.end()) {
        return Curve::Way::linear;
    }
    const auto way =
        found->is_string() ? kWayNames.value(found->get<std::string>()) : std::nullopt;
    if (!way) {
        refuse(where + "/way", *found, kWayNames.alternatives());
    }
    return *way;
}

Curve::Keys keys_from_json(const nlohmann::json& json, const std::string& where) {
    constexpr std::string_view kExpected =
        "pairs [image, value], images ascending, values above zero where the way is geometric";
    Curve::Keys curve{.keys = {}, .way = way_from_json(json, where)};
    const nlohmann::json& keys = json.at("keys");
    if (!keys.is_array() || keys.empty()) {
        refuse(where + "/keys", keys, kExpected);
    }
    for (const nlohmann::json& key : keys) {
        if (!key.is_array() || key.size() != 2 || !is_count(key[0]) || !key[1].is_number()) {
            refuse(where + "/keys", key, kExpected);
        }
        const Curve::Key next{key[0].get<std::uint32_t>(), key[1].get<double>()};
        if ((!curve.keys.empty() && next.image <= curve.keys.back().image) ||
            (curve.way == Curve::Way::geometric && next.value <= 0)) {
            refuse(where + "/keys", key, kExpected);
        }
        curve.keys.push_back(next);
    }
    return curve;
}

Curve::Samples samples_from_json(const nlohmann::json& json, const std::string& where) {
    const nlohmann::json& values = json.at("samples");
    if (!values.is_array() || values.empty() ||
        !std::all_of(values.begin(), values.end(),
                     [](const nlohmann::json& value) { return value.is_number(); })) {
        refuse(where + "/samples", values, "numbers, an image each");
    }
    return {.values = values.get<std::vector<double>>()};
}

Curve::Random random_from_json(const nlohmann::json& json,
                               const std::string& where,
                               std::uint64_t stream) {
    constexpr std::string_view kExpected =
        "{\"from\": number, \"to\": number, \"every\": images, \"way\": linear or geometric}";
    const nlohmann::json& random = json.at("random");
    if (!random.is_object() || !random.contains("from") || !random["from"].is_number() ||
        !random.contains("to") || !random["to"].is_number() || !random.contains("every") ||
        !is_count(random["every"]) || random["every"].get<std::uint32_t>() == 0) {
        refuse(where + "/random", random, kExpected);
    }
    const Curve::Way way = way_from_json(random, where + "/random");
    Curve::Random curve{.from = random["from"].get<double>(),
                        .to = random["to"].get<double>(),
                        .every = random["every"].get<std::uint32_t>(),
                        .geometric = way == Curve::Way::geometric,
                        .stream = stream};
    const bool positive = curve.from > 0 && curve.to > 0;
    if (way == Curve::Way::hold || way == Curve::Way::slow_fast_slow ||
        (curve.geometric && !positive)) {
        refuse(where + "/random", random, kExpected);
    }
    return curve;
}

}  // namespace

Curve::Curve(double constant) : shape_(Keys{.keys = {{0, constant}}}) {}

Curve::Curve(std::variant<Keys, Samples, Random> shape) : shape_(std::move(shape)) {}

double Curve::at(std::uint32_t image, std::uint64_t seed) const {
    return std::visit([&](const auto& shape) { return value_at(shape, image, seed); }, shape_);
}

std::uint32_t Curve::rests_from() const {
    return std::visit([](const auto& shape) { return rest_of(shape); }, shape_);
}

Curve curve_from_json(const nlohmann::json& json,
                      const std::string& where,
                      std::uint64_t stream) {
    if (json.is_number()) {
        return Curve(json.get<double>());
    }
    if (json.is_object() && json.contains("keys")) {
        return Curve(keys_from_json(json, where));
    }
    if (json.is_object() && json.contains("samples")) {
        return Curve(samples_from_json(json, where));
    }
    if (json.is_object() && json.contains("random")) {
        return Curve(random_from_json(json, where, stream));
    }
    refuse(where, json, "a number, or an object with keys, samples or random");
}

}  // namespace relume::lab
