#include "precompute/bake/report.h"

#include "protocol/base/files/atomic_file.h"

#include <nlohmann/json.hpp>
#include <tbb/info.h>

#include <string>

namespace relume::bake {
namespace {

double per_second(std::uint64_t count, double seconds) {
    return seconds > 0 ? static_cast<double>(count) / seconds : 0;
}

}  // namespace

nlohmann::json report_from(const scene::Scene& scene,
                           const BakeParameters& parameters,
                           const BakeSummary& s) {
    return {{"scene",
             {{"name", scene.name},
              {"triangles", scene.triangle_count()},
              {"vertices", scene.vertex_count()},
              {"unused", scene.report.unused},
              {"repairs", scene.report.repairs}}},
            {"parameters", json_from_parameters(parameters)},
            {"threads", parameters.threads > 0
                            ? parameters.threads
                            : static_cast<std::uint32_t>(tbb::info::default_concurrency())},
            {"seconds",
             {{"total", s.seconds},
              {"pilot", s.pilot_seconds},
              {"paths", s.path_seconds},
              {"rows", s.row_seconds},
              {"visibility_of_points", s.field_seconds},
              {"finish", s.finish_seconds},
              {"cpu", s.cpu_seconds}}},
            {"rays",
             {{"visibility", s.visibility_rays},
              {"paths", s.path_rays},
              {"visibility_of_points", s.field_rays}}},
            {"points", {{"count", s.field_points}, {"resumed", s.field_points_resumed}}},
            {"rays_per_second",
             {{"visibility", per_second(s.visibility_rays, s.row_seconds)},
              {"paths", per_second(s.path_rays, s.path_seconds)}}},
            {"shards", {{"count", s.shards}, {"resumed", s.shards_resumed}}},
            {"peak_memory_bytes", s.peak_memory_bytes}};
}

void write_report(const std::filesystem::path& directory, const nlohmann::json& report) {
    const std::string text =
        report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    files::write_file_atomically(directory / "report.json", {files::bytes_of(text)});
}

}  // namespace relume::bake
