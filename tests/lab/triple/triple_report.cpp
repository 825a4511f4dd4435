#include "tests/lab/triple/triple_report.h"

#include "protocol/base/files/regular_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace relume::lab {
namespace {

using nlohmann::json;

double rate_of(const MaterialFindings& findings, const std::string& way) {
    const auto at = std::find(findings.ways.begin(), findings.ways.end(), way);
    return findings.vertices_per_second[static_cast<std::size_t>(at - findings.ways.begin())];
}

json json_of(const KeptFigures& f) {
    return {{"bytes_per_vertex", f.bytes_per_vertex},
            {"fill_seconds", f.fill_seconds},
            {"milliseconds", f.milliseconds},
            {"error", f.error}};
}

json bake_report(const SeenSurface& surface) {
    constexpr std::uintmax_t kMostBytes = 1 << 20;
    return json::parse(files::read_regular_file(
        surface.scene()->transport().directory() / "report.json", kMostBytes));
}

}  // namespace

json json_from(const SeenSurface& surface) {
    const auto vertices = static_cast<double>(surface.vertex_count());
    const auto texels =
        static_cast<double>(6 * surface.face_resolution() * surface.face_resolution());
    const json report = bake_report(surface);
    // An interrupted bake reports the points that it made since it went on.
    const double points = report.at("points").at("count").get<double>();
    const double made = points - report.at("points").at("resumed").get<double>();
    const double seconds =
        report.at("seconds").at("visibility_of_points").get<double>() * points / made;
    const double rays =
        report.at("rays").at("visibility_of_points").get<double>() * points / made;
    return {
        {"vertices", surface.vertex_count()},
        {"triangles", surface.triangle_count()},
        {"scene_triangles", report.at("scene").at("triangles")},
        {"seen_vertices", surface.seen().size()},
        {"bytes_per_vertex", static_cast<double>(surface.wavelets().byte_count()) / vertices},
        {"bytes_per_vertex_bits", surface.bits_in_blocks(0).size_bytes()},
        {"bytes_per_vertex_stored", static_cast<double>(surface.stored_bytes()) / vertices},
        {"sparsity",
         static_cast<double>(surface.wavelets().nonzero_count()) / vertices / texels},
        {"bake_seconds", seconds},
        {"bake_threads", report.at("threads")},
        {"bake_peak_memory_bytes", report.at("peak_memory_bytes")},
        {"wavelet_seconds", surface.wavelet_seconds()},
        {"rays_per_s", rays / seconds}};
}

json json_from(const MovingFigures& f) {
    return {{"seen_vertices", f.seen_vertices},
            {"field_seconds", f.field_seconds},
            {"load_seconds", f.load_seconds},
            {"field_bytes", f.field_bytes},
            {"texel_bytes", f.texel_bytes},
            {"surface_bytes", f.surface_bytes},
            {"images_per_s_light_only", f.images_per_s_light_only},
            {"images_per_s_view_only", f.images_per_s_view_only},
            {"images_per_s_light_and_view", f.images_per_s_light_and_view},
            {"error_while_moving", f.error_while_moving},
            {"stated_error_while_moving", f.stated_error_while_moving},
            {"images_to_exact", f.images_to_exact}};
}

json json_from(const MaterialFindings& f, const TermCurve& curve) {
    json rates;
    for (std::size_t i = 0; i < f.ways.size(); ++i) {
        rates[f.ways[i]] = f.vertices_per_second[i];
    }
    json grid = json::array();
    for (const GridPoint& point : f.grid) {
        grid.push_back({{"light", point.light},
                        {"material", point.material},
                        {"error", point.error},
                        {"seconds", point.seconds}});
    }
    json points = json::array();
    for (const TermPoint& point : curve.points) {
        points.push_back({{"terms", point.terms},
                          {"microseconds", point.microseconds},
                          {"error", point.error}});
    }
    const double sublinear = rate_of(f, "sublinear");
    return {{"material", f.material},
            {"bake_seconds", f.entries_seconds},
            {"bytes_wavelets", f.wavelet_bytes},
            {"bytes_runs", f.run_bytes},
            {"sparsity", f.sparsity},
            {"seconds_per_image", f.seconds_sublinear},
            {"seconds_per_image_bits", f.seconds_bits},
            {"error", f.error_sublinear},
            {"error_bits", f.error_bits},
            {"table_error", f.table_error},
            {"vertices_per_s_core", std::move(rates)},
            {"ratio_to_bits", sublinear / rate_of(f, "bits")},
            {"ratio_to_decompressed", sublinear / rate_of(f, "decompressed")},
            {"ratio_to_published", sublinear / rate_of(f, "published")},
            {"ratio_to_pixels", sublinear / rate_of(f, "pixels")},
            {"grid", std::move(grid)},
            {"terms", std::move(points)},
            {"slope", curve.slope},
            {"microseconds_bits", curve.microseconds_bits}};
}

json json_from(const KeptProducts& kept) {
    json followed = json::array();
    for (const FollowedLight& one : kept.followed) {
        followed.push_back({{"coefficients", one.coefficients},
                            {"milliseconds", one.milliseconds},
                            {"error", one.error}});
    }
    return {{"bits_milliseconds", kept.bits_milliseconds},
            {"product_texels", json_of(kept.texels)},
            {"product_columns", json_of(kept.columns)},
            {"followed", std::move(followed)},
            {"lit_texels", json_of(kept.lit)}};
}

namespace {

void print_visibility(const json& surface) {
    fmt::print(
        "| {} vertices of {} triangles, {} seen | bytes a vertex: {:.0f} in wavelets, {} as "
        "bits, {:.0f} stored | {:.1f} % of the coefficients | {:.1f} s of rays, {:.1f} s of "
        "wavelets; {:.2f} GB at the peak of the bake |\n",
        surface.at("vertices").get<int>(), surface.at("scene_triangles").get<int>(),
        surface.at("seen_vertices").get<int>(), surface.at("bytes_per_vertex").get<double>(),
        surface.at("bytes_per_vertex_bits").get<int>(),
        surface.at("bytes_per_vertex_stored").get<double>(),
        100 * surface.at("sparsity").get<double>(), surface.at("bake_seconds").get<double>(),
        surface.at("wavelet_seconds").get<double>(),
        1e-9 * surface.at("bake_peak_memory_bytes").get<double>());
}

void print_kept(const json& kept) {
    fmt::print(
        "\n| kept | bytes a vertex | s to fill | ms an image | L2 error "
        "|\n|---|---|---|---|---|\n"
        "| nothing: bits | – | – | {:.1f} | – |\n",
        kept.at("bits_milliseconds").get<double>());
    for (const auto& [name, key] : {std::pair("V·ρ̃ by texels", "product_texels"),
                                    std::pair("V·ρ̃ by columns, all of them", "product_columns"),
                                    std::pair("L·V by texels", "lit_texels")}) {
        const json& one = kept.at(key);
        fmt::print("| {} | {:.0f} | {:.2f} | {:.1f} | {:.2f} % |\n", name,
                   one.at("bytes_per_vertex").get<double>(),
                   one.at("fill_seconds").get<double>(), one.at("milliseconds").get<double>(),
                   100 * one.at("error").get<double>());
    }
    for (const json& one : kept.at("followed")) {
        fmt::print("| V·ρ̃, {} columns an image | | | {:.1f} | {:.1f} % |\n",
                   one.at("coefficients").get<int>(), one.at("milliseconds").get<double>(),
                   100 * one.at("error").get<double>());
    }
}

void print_material(const json& m) {
    fmt::print(
        "\n{}: {:.1f} MB in wavelets, {:.1f} MB in runs, {:.2f} %, {:.1f} s; "
        "tabulated L2 {:.2e}\n",
        m.at("material").get<std::string>(), 1e-6 * m.at("bytes_wavelets").get<double>(),
        1e-6 * m.at("bytes_runs").get<double>(), 100 * m.at("sparsity").get<double>(),
        m.at("bake_seconds").get<double>(), m.at("table_error").get<double>());
    fmt::print("| way | vertices/s and core | s an image | L2 error |\n|---|---|---|---|\n");
    for (const auto& [way, rate] : m.at("vertices_per_s_core").items()) {
        const bool is_sublinear = way == "sublinear";
        fmt::print("| {} | {:.0f} | {} | {} |\n", way, rate.get<double>(),
                   is_sublinear || way == "bits"
                       ? fmt::format("{:.4f}", m.at(is_sublinear ? "seconds_per_image"
                                                                 : "seconds_per_image_bits")
                                                   .get<double>())
                       : "",
                   is_sublinear || way == "bits"
                       ? fmt::format("{:.2e}",
                                     m.at(is_sublinear ? "error" : "error_bits").get<double>())
                       : "");
    }
    fmt::print("\n| ρ \\ L |");
    for (const double of_light : kLightFractions) {
        fmt::print(" {:g} % |", 100 * of_light);
    }
    fmt::print("\n|---|---|---|---|---|---|\n");
    std::size_t i = 0;
    for (const double of_material : kMaterialFractions) {
        fmt::print("| {:g} % |", 100 * of_material);
        for (std::size_t l = 0; l < kLightFractions.size(); ++l, ++i) {
            const json& point = m.at("grid")[i];
            fmt::print(" {:.1f} %, {:.3f} s |", 100 * point.at("error").get<double>(),
                       point.at("seconds").get<double>());
        }
        fmt::print("\n");
    }
    const json& moving = m.at("moving");
    fmt::print(
        "exact images/s: light {:.1f}, view {:.1f}, both {:.1f}; 8 ms an image: off "
        "by {:.1f} %, stated {:.1f} %, {} images to exact\n",
        moving.at("images_per_s_light_only").get<double>(),
        moving.at("images_per_s_view_only").get<double>(),
        moving.at("images_per_s_light_and_view").get<double>(),
        100 * moving.at("error_while_moving").get<double>(),
        100 * moving.at("stated_error_while_moving").get<double>(),
        moving.at("images_to_exact").get<int>());
    fmt::print("time against terms: slope {:.2f}; over open texels {:.2f} µs a vertex\n",
               m.at("slope").get<double>(), m.at("microseconds_bits").get<double>());
    if (m.contains("kept")) {
        print_kept(m.at("kept"));
    }
}

}  // namespace

void print_triple_tables(const json& surface) {
    print_visibility(surface.at("visibility"));
    for (const json& m : surface.at("materials")) {
        print_material(m);
    }
}

}  // namespace relume::lab
