// What a manifest of kind `curves` says of the materials that people edit, and of the light
// that is frozen in it.
#pragma once

#include "protocol/transport/manifest_reader.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace relume::transport {

// An edited curve, in the order of the signal's basis (basis/curve_basis.h).
struct CurveRecord {
    static constexpr std::size_t kSamples = 256;
    using Samples = std::array<std::array<float, kSamples>, 3>;  // red, green and blue

    std::string id;     // by which rooms call the material; a name, used once
    std::string name;   // of the material in the scene's file
    std::string curve;  // which of its BRDF's curves, and over which angle: protocol/curve
    std::string angle;
    nlohmann::json brdf = nlohmann::json::object();  // model and parameters, as baked
    Samples baked{};                                 // finite, not negative

    friend bool operator==(const CurveRecord&, const CurveRecord&) = default;
};

struct CurvesSection {
    static constexpr std::uint32_t kMostCurves = 16;

    std::vector<CurveRecord> curves;                  // 1 … kMostCurves
    nlohmann::json light = nlohmann::json::object();  // for people to read

    friend bool operator==(const CurvesSection&, const CurvesSection&) = default;
};

// The sections `curves` and `light` of a manifest. Reading throws TransportError naming the
// key, what was found and what was expected.
[[nodiscard]] nlohmann::json json_from(const std::vector<CurveRecord>& curves);
[[nodiscard]] CurvesSection curves_section(const ManifestReader& top);

}  // namespace relume::transport
