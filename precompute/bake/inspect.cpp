#include "precompute/bake/inspect.h"

#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/base/text/strict_json.h"
#include "protocol/transport/column_summary.h"
#include "protocol/transport/error.h"
#include "protocol/transport/transport.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace relume::bake {
namespace {

constexpr std::size_t kMaxReportBytes = std::size_t{16} << 20;

// report.json, or null: it is there for people and may be gone or anything.
nlohmann::json report_of(const std::filesystem::path& directory) {
    try {
        return text::parse_strict_json(
            files::read_regular_file(directory / "report.json", kMaxReportBytes),
            kMaxReportBytes);
    } catch (const files::FileError&) {
        return {};
    } catch (const text::JsonError&) {
        return {};
    }
}

// What is stated of the columns is what their values amount to.
void check_energies(const transport::Transport& transport) {
    std::vector<float> steps;
    for (std::size_t column = 0; column < transport.column_count(); ++column) {
        for (std::uint32_t channel = 0; channel < transport.channel_count(); ++channel) {
            steps.push_back(transport.step(column, channel));
        }
    }
    const transport::ColumnSummary summary = transport::summarise_columns(
        transport.manifest(), transport.shards(), steps, transport.tint());
    // Another writer may have summed in another order.
    constexpr float kTolerance = 1e-3F;
    for (std::size_t column = 0; column < transport.column_count(); ++column) {
        for (std::uint32_t colour = 0; colour < transport::kColours; ++colour) {
            const float stated = transport.energy(column, colour);
            const float real = summary.energies[column * transport::kColours + colour];
            if (!(std::abs(stated - real) <= kTolerance * std::max(stated, real))) {
                throw transport::TransportError(fmt::format(
                    "{}: energy of column {} colour {}: found {}, expected {} by its values",
                    (transport.directory() / transport.manifest().columns.file).string(),
                    column, colour, stated, real));
            }
        }
    }
}

template <typename Check>
void collect(std::vector<std::string>& faults, Check check) {
    try {
        check();
    } catch (const transport::TransportError& error) {
        faults.emplace_back(error.what());
    }
}

std::string signal_text(const nlohmann::json& d) {
    const nlohmann::json& basis = d.at("basis");
    if (d.contains("curves")) {
        std::string text = "curves of";
        for (const nlohmann::json& curve : d.at("curves")) {
            text += fmt::format("{} {}.{}", &curve == &d.at("curves").front() ? "" : ",",
                                curve.at("name").get<std::string>(),
                                curve.at("curve").get<std::string>());
        }
        return fmt::format("{} under {}", text, d.at("light").value("environment", "a light"));
    }
    return fmt::format("6×{n}×{n} lights, {}",
                       basis.contains("order") ? fmt::format("spherical harmonics of order {}",
                                                             basis.at("order").get<int>())
                                               : "Haar",
                       fmt::arg("n", basis.at("face_resolution").get<int>()));
}

double pixels_of(const nlohmann::json& d) {
    const auto& image = d.at("image");
    return image.at("width").get<double>() * image.at("height").get<double>();
}

std::string receivers_text(const nlohmann::json& d) {
    if (d.contains("vertices")) {
        return fmt::format("{} vertices, {} triangles, {} blocks in {} clusters",
                           d.at("vertices").get<int>(), d.at("triangles").get<int>(),
                           d.at("blocks").get<int>(), d.at("clusters").get<int>());
    }
    const auto& image = d.at("image");
    return fmt::format("{}×{} pixels", image.at("width").get<int>(),
                       image.at("height").get<int>());
}

std::string megabytes(double bytes) {
    return fmt::format("{:.1f} MB", bytes / 1e6);
}

// Nothing where no visibility is stored.
std::string visibility_text(const nlohmann::json& d) {
    if (!d.contains("visibility")) {
        return {};
    }
    const auto& visibility = d.at("visibility");
    std::string text;
    if (d.contains("editable")) {
        text = "  edited under any light:";
        for (const auto& material : d.at("editable")) {
            text += fmt::format("{} {}", &material == &d.at("editable").front() ? "" : ",",
                                material.at("name").get<std::string>());
        }
        text += "\n";
    }
    const auto bytes = visibility.at("bytes").get<double>();
    const auto points = visibility.at("points").get<std::uint64_t>();
    text += fmt::format("  visibility of {} points, 6×{n}×{n} bits each: {}", points,
                        megabytes(bytes),
                        fmt::arg("n", visibility.at("face_resolution").get<int>()));
    if (points > 0) {
        text += fmt::format(", {:.0f} bytes a point", bytes / static_cast<double>(points));
    }
    // Other writers may not state it.
    const nlohmann::json& measured = d.at("measured");
    if (measured.contains("visibility") && measured.at("visibility").is_object()) {
        const auto open = measured.at("visibility").find("open_share");
        if (open != measured.at("visibility").end() && open->is_number()) {
            text += fmt::format(", {:.1f} % open", 100 * open->get<double>());
        }
    }
    return text + "\n";
}

std::string lines_from_measured(const nlohmann::json& measured) {
    std::string text;
    if (measured.contains("cells")) {
        for (const auto& [name, cells] : measured.at("cells").items()) {
            text += fmt::format("  {:9} {:>12} cells {:>13} non-zeros {:>12}\n", name,
                                cells.at("cells").get<std::uint64_t>(),
                                cells.at("nonzeros").get<std::uint64_t>(),
                                megabytes(cells.at("bytes").get<double>()));
        }
    }
    if (measured.contains("quantisation_error")) {
        for (const auto& [light, error] : measured.at("quantisation_error").items()) {
            text += fmt::format(
                "  quantisation error under {} light: L2 {:.2e}, gradient {:.2e}\n", light,
                error.at("relative_l2").get<double>(), error.at("relative_h1").get<double>());
        }
    }
    if (measured.contains("surface")) {
        const auto& surface = measured.at("surface");
        text += fmt::format(
            "  light between vertices is interpolated with an error of L2 {:.2e}, measured "
            "before the bake\n",
            surface.at("interpolation_error").get<double>());
        for (const auto& brdf : measured.at("brdfs")) {
            text += fmt::format("  BRDF of {}: {} term(s), L2 {:.2e}\n",
                                brdf.at("name").get<std::string>(), brdf.at("terms").get<int>(),
                                brdf.at("error").get<double>());
        }
    }
    if (measured.contains("materials") && measured.at("materials").is_array()) {
        for (const auto& material : measured.at("materials")) {
            if (!material.is_object()) {
                continue;  // of a surface: notes
            }
            if (material.contains("measured")) {
                text += fmt::format("  {} in curves of {}, by {}\n",
                                    material.at("measured").get<std::string>(),
                                    material.at("name").get<std::string>(),
                                    material.at("factors").get<std::string>());
                for (const auto& [method, error] : material.at("errors").items()) {
                    text += fmt::format("    error by {}: L2 {:.2e}, logarithmic {:.2e}\n",
                                        method, error.at("relative_l2").get<double>(),
                                        error.at("logarithmic").get<double>());
                }
            }
            if (const auto unmeasured = material.value("unmeasured", std::uint64_t{0})) {
                text += fmt::format(
                    "    {} of its values are negative: not measured, counted as 0\n",
                    unmeasured);
            }
            if (material.contains("texture_left_out")) {
                text += fmt::format(
                    "  warning: one curve stands for all of {}: its {} by texture is left "
                    "out\n",
                    material.at("name").get<std::string>(),
                    material.at("texture_left_out").get<std::string>());
            }
            if (material.value("has_specular_textures", false)) {
                text += fmt::format(
                    "  warning: edits of {} start from a highlight without its textures\n",
                    material.at("name").get<std::string>());
            }
            if (!material.value("in_view", true)) {
                text += fmt::format("  warning: no pixel sees the edited material {}\n",
                                    material.at("name").get<std::string>());
            }
        }
    }
    if (measured.contains("bytes_of_basis")) {
        for (const auto& [basis, bytes] : measured.at("bytes_of_basis").items()) {
            text += fmt::format("  blocks looked at before the bake take {:.2f} MB in {}\n",
                                1e-6 * bytes.get<double>(), basis);
        }
    }
    if (measured.contains("chroma_residual")) {
        text += fmt::format("  what one channel would lose: L2 {:.2e}\n",
                            measured.at("chroma_residual").get<double>());
    }
    return text;
}

// Other writers may state other things there, which are not told.
std::string text_from_measured(const nlohmann::json& measured) {
    try {
        return lines_from_measured(measured);
    } catch (const nlohmann::json::exception&) {
        return "  what was measured is not stated as relume-bake states it\n";
    }
}

// Of a report.json as bakes write it; nothing of any other.
std::string text_from_report(const nlohmann::json& report) {
    try {
        return fmt::format(
            "  baked in {:.1f} s: {:.1f} Mrays/s of visibility, peak memory {}\n",
            report.at("seconds").at("total").get<double>(),
            report.at("rays_per_second").at("visibility").get<double>() / 1e6,
            megabytes(report.at("peak_memory_bytes").get<double>()));
    } catch (const nlohmann::json::exception&) {
        return {};
    }
}

}  // namespace

nlohmann::json describe(const std::filesystem::path& directory) {
    const auto transport = transport::Transport::open(directory);
    const transport::Manifest& manifest = transport->manifest();
    nlohmann::json description{
        {"directory", directory.string()},
        {"generator", manifest.generator},
        {"kind", transport::kKindNames.name(manifest.kind)},
        {"basis", transport::json_from(manifest.signal_basis)},
        {"columns", transport->column_count()},
        {"colour",
         {{"channels", manifest.colour.channels}, {"matrix", manifest.colour.matrix}}},
        {"shards", manifest.shards.size()},
        {"bytes", transport->total_bytes()},
        {"sampling_error", transport::json_from(manifest.sampling_error)},
        {"bake", manifest.bake},
        {"measured", manifest.measured}};
    const transport::TileGrid& image = manifest.mesh ? manifest.mesh->view : manifest.image();
    description["image"] = {{"width", image.width}, {"height", image.height}};
    if (manifest.curves) {
        description["curves"] = nlohmann::json::array();
        for (const transport::CurveRecord& curve : manifest.curves->curves) {
            description["curves"].push_back({{"id", curve.id},
                                             {"name", curve.name},
                                             {"curve", curve.curve},
                                             {"angle", curve.angle},
                                             {"brdf", curve.brdf}});
        }
        description["light"] = manifest.curves->light;
    }
    if (transport->visibility()) {
        const transport::VisibilityRecord& record =
            manifest.materials ? manifest.materials->visibility : *manifest.visibility;
        description["visibility"] = {
            {"face_resolution", record.face_resolution},
            {"points", transport->visibility()->point_count()},
            {"bytes",
             record.file.bytes + (manifest.materials ? manifest.materials->points.bytes : 0)}};
    }
    if (manifest.materials) {
        description["editable"] = transport::json_from(*manifest.materials).at("editable");
    }
    if (manifest.mesh) {
        description["vertices"] = manifest.layout.clusters().vertex_count();
        description["clusters"] = manifest.layout.clusters().clusters().size();
        description["blocks"] = manifest.block_count();
        description["triangles"] = transport->surface()->mesh.triangles.size();
    }
    std::uint64_t nonzeros = 0;
    for (const transport::ShardReader& shard : transport->shards()) {
        for (const std::uint64_t count : shard.statistics().nonzeros) {
            nonzeros += count;
        }
    }
    description["nonzeros"] = nonzeros;
    const nlohmann::json report = report_of(directory);
    description["report"] = report;
    return description;
}

std::string exactness_text(const nlohmann::json& basis) {
    if (!basis.contains("face_resolution")) {
        return "  exact images are exact for light and interreflection as they are frozen in "
               "it\n";
    }
    return fmt::format(
        "  exact images are exact for the light as filtered onto 6×{n}×{n} texels "
        "(protocol/light.md)\n",
        fmt::arg("n", basis.at("face_resolution").get<int>()));
}

std::string text_from_description(const nlohmann::json& d) {
    const auto bytes = d.at("bytes").get<double>();
    const bool is_mesh = d.contains("vertices");
    const double receivers = is_mesh ? d.at("vertices").get<double>() : pixels_of(d);
    const char* receiver = is_mesh ? "vertex" : "pixel";
    std::string text = fmt::format(
        "{}\n  {}, {signal}; {} channel(s) in {} shard(s)\n"
        "  {}, {:.0f} bytes and {:.0f} non-zeros per {}\n",
        d.at("directory").get<std::string>(), receivers_text(d),
        d.at("colour").at("channels").get<int>(), d.at("shards").get<int>(), megabytes(bytes),
        bytes / receivers, d.at("nonzeros").get<double>() / receivers, receiver,
        fmt::arg("signal", signal_text(d)));
    if (const auto& error = d.at("sampling_error"); !error.is_null()) {
        const char* const of_what =
            d.contains("curves")
                ? "  sampling error: L2 {:.2e} of likely curves, {:.2e} of curves that end "
                  "abruptly\n"
                : "  sampling error: L2 {:.2e} under natural light, {:.2e} under sun\n";
        text += fmt::format(fmt::runtime(of_what), error.at("natural").get<double>(),
                            error.at("sun").get<double>());
    }
    text += visibility_text(d);
    text += text_from_measured(d.at("measured"));
    text += exactness_text(d.at("basis"));
    return text + text_from_report(d.at("report"));
}

std::vector<std::string> find_faults(const std::filesystem::path& directory) {
    std::vector<std::string> faults;
    collect(faults, [&] {
        const auto manifest = transport::read_manifest(directory / "manifest.json");
        for (const transport::ShardRecord& shard : manifest.shards) {
            collect(faults,
                    [&] { const transport::ShardReader reader(directory / shard.file); });
        }
    });
    if (faults.empty()) {
        collect(faults, [&] { check_energies(*transport::Transport::open(directory)); });
    }
    return faults;
}

}  // namespace relume::bake
