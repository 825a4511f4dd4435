// The BRDF whose curves people edit: what the scene says of a material, what the command line
// says, or a measured one in factors.
#pragma once

#include "precompute/bake/base/measured_brdf.h"
#include "precompute/bake/curves/edited_material.h"
#include "precompute/scene/material.h"
#include "protocol/curve/curve_brdf.h"

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>

namespace relume::bake {

struct StatedModel {
    curve::CurveBrdf brdf;
    bool is_of_scene = false;
    std::optional<Imath::V3f> albedo{};
    nlohmann::json notes = nlohmann::json::object();
};

// The models of a request, by material.
class StatedModels {
  public:
    // Throws program::UsageError for an option that is no MATERIAL=MODEL, and for a material
    // that has two.
    StatedModels(const CurveRequest& request, std::span<const MeasuredBrdf> measured);

    // Of the material: what the request says, else the scene. Throws program::UsageError,
    // factors::FactorError.
    [[nodiscard]] StatedModel take(const scene::Material& material);
    // Throws program::UsageError for a model of a material that was not asked for.
    void require_all_taken() const;

  private:
    // Text of a model, or a measured BRDF.
    using Stated = std::variant<std::string, const MeasuredBrdf*>;
    void add(const std::string& material, Stated stated);

    factors::CurveMethod factors_;
    std::map<std::string, Stated> by_material_;
};

// MODEL or MODEL:parameter=value,… with red, green and blue as r/g/b; what is not said is
// usual. Throws program::UsageError, which begins with `option`.
[[nodiscard]] curve::CurveBrdf curve_brdf_from_text(const std::string& option,
                                                    const std::string& text);

}  // namespace relume::bake
