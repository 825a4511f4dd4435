// report.json: how a bake went, for people.
#pragma once

#include "precompute/bake/bake.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace relume::bake {

[[nodiscard]] nlohmann::json report_from(const scene::Scene& scene,
                                         const BakeParameters& parameters,
                                         const BakeSummary& summary);
void write_report(const std::filesystem::path& directory, const nlohmann::json& report);

}  // namespace relume::bake
