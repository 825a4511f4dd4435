// relume-lab triple: light times visibility times material at the vertices that a camera sees.
#include "server/engine/kernels/target.h"
#include "tests/lab/charts/picture_sheet.h"
#include "tests/lab/charts/triple_chart.h"
#include "tests/lab/commands/commands.h"
#include "tests/lab/sequences/map_cubemap.h"
#include "tests/lab/triple/moving_scene.h"
#include "tests/lab/triple/triple_experiment.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace relume::lab {
namespace {

using nlohmann::json;

struct Options {
    SeenSurfaceOptions surface;
    std::vector<std::string> materials{"lambert", "phong:exponent=64"};
    std::string environment = "studio";
    std::uint32_t threads = 2;
    std::size_t peer_vertices = 400;
    std::uint32_t images = 24;
    bool is_full = false;
    bool as_json = false;
    std::string pictures;  // a folder
};

double rate_of(const MaterialFindings& findings, const std::string& way) {
    const auto at = std::find(findings.ways.begin(), findings.ways.end(), way);
    return findings.vertices_per_second[static_cast<std::size_t>(at - findings.ways.begin())];
}

json json_of(const MovingFigures& f) {
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

json json_of(const MaterialFindings& f, const TermCurve& curve) {
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

json json_of(const SeenSurface& surface) {
    const auto vertices = static_cast<double>(surface.vertex_count());
    const auto texels =
        static_cast<double>(6 * surface.face_resolution() * surface.face_resolution());
    const auto bits_bytes = static_cast<double>(surface.bits(0).size_bytes());
    return {
        {"vertices", surface.vertex_count()},
        {"triangles", surface.triangle_count()},
        {"seen_vertices", surface.seen().size()},
        {"bytes_per_vertex", static_cast<double>(surface.wavelets().byte_count()) / vertices},
        {"bytes_per_vertex_bits", bits_bytes},
        {"sparsity",
         static_cast<double>(surface.wavelets().nonzero_count()) / vertices / texels},
        {"refine_seconds", surface.refine_seconds()},
        {"bake_seconds", surface.cast_seconds()},
        {"wavelet_seconds", surface.wavelet_seconds()},
        {"rays_per_s", static_cast<double>(surface.rays()) / surface.cast_seconds()}};
}

// The exact image, and what few terms make of it [Ng04 fig. 4].
void draw_pictures(const std::filesystem::path& folder,
                   std::uint32_t side,
                   const SeenSurface& surface,
                   const TabulatedMaterial& material,
                   const TripleLight& light) {
    std::vector<Picture> pictures{
        {.method = "",
         .image = 0,
         .rgb = surface.image(
             integrate_all(surface, bits_way(surface, material, material.texels(), light)))}};
    for (const auto& [of_material, of_light] :
         std::vector<std::pair<std::size_t, std::size_t>>{{0, 0}, {0, 2}, {1, 2}, {2, 3}}) {
        const tripling::SquareSet terms = light.largest(kLightFractions[of_light]);
        const TripleWay way = sublinear_way(surface, material, of_material, light, terms);
        pictures.push_back(
            {.method = fmt::format("L {:g} %, rho {:g} %", 100 * kLightFractions[of_light],
                                   100 * kMaterialFractions[of_material]),
             .image = 0,
             .rgb = surface.image(integrate_all(surface, way))});
    }
    std::filesystem::create_directories(folder);
    const std::string name = material.words().substr(0, material.words().find(':'));
    draw_picture_sheet(folder / ("triple-" + name),
                       "table, " + material.words() + ", exact and by few terms", pictures,
                       side);
}

void print_table(const json& report) {
    const json& surface = report.at("visibility");
    fmt::print(
        "| {} vertices, {} seen | {:.0f} bytes a vertex ({:.0f} as bits) | {:.1f} % of "
        "the coefficients | {:.1f} s |\n",
        surface.at("vertices").get<int>(), surface.at("seen_vertices").get<int>(),
        surface.at("bytes_per_vertex").get<double>(),
        surface.at("bytes_per_vertex_bits").get<double>(),
        100 * surface.at("sparsity").get<double>(), surface.at("bake_seconds").get<double>());
    for (const json& m : report.at("materials")) {
        fmt::print(
            "\n{}: {:.1f} MB in wavelets, {:.1f} MB in runs, {:.2f} %, {:.1f} s; "
            "tabulated L2 {:.2e}\n",
            m.at("material").get<std::string>(), 1e-6 * m.at("bytes_wavelets").get<double>(),
            1e-6 * m.at("bytes_runs").get<double>(), 100 * m.at("sparsity").get<double>(),
            m.at("bake_seconds").get<double>(), m.at("table_error").get<double>());
        fmt::print(
            "| way | vertices/s and core | s an image | L2 error |\n|---|---|---|---|\n");
        for (const auto& [way, rate] : m.at("vertices_per_s_core").items()) {
            const bool is_sublinear = way == "sublinear";
            fmt::print(
                "| {} | {:.0f} | {} | {} |\n", way, rate.get<double>(),
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
    }
}

int run(Options options) {
    if (options.is_full) {
        options.surface.vertices = 300'000;
    }
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    options.threads);
    const std::uint32_t n = options.surface.face_resolution;
    const SeenSurface surface(options.surface);
    const TripleLight light(n, cubemap_of_map(options.environment, n));
    json materials = json::array();
    std::vector<TermCurve> curves;
    for (const std::string& words : options.materials) {
        const TabulatedMaterial material(words, n, kMaterialFractions);
        const MaterialFindings findings =
            measure_material(surface, material, light, options.peer_vertices);
        curves.push_back(time_against_terms(surface, material, light));
        materials.push_back(json_of(findings, curves.back()));
        materials.back()["moving"] =
            json_of(move_scene(surface, words, options.environment, options.images));
        if (!options.pictures.empty()) {
            draw_pictures(options.pictures, options.surface.side, surface, material, light);
        }
    }
    if (!options.pictures.empty()) {
        draw_triple_chart(std::filesystem::path(options.pictures) / "triple-terms",
                          options.materials, curves);
    }
    const json report{{"configuration",
                       {{"scene", options.surface.scene},
                        {"environment", options.environment},
                        {"face_resolution", n},
                        {"side", options.surface.side},
                        {"threads", options.threads},
                        {"target", engine::target_name()},
                        {"material_terms", kMaterialFractions[kPaperMaterial]},
                        {"light_terms", kLightFractions[kPaperLight]}}},
                      {"visibility", json_of(surface)},
                      {"materials", std::move(materials)}};
    if (options.as_json) {
        fmt::print("{}\n", report.dump(2));
    } else {
        print_table(report);
    }
    return 0;
}

}  // namespace

Command add_triple_command(CLI::App& program) {
    auto options = std::make_shared<Options>();
    CLI::App* app = program.add_subcommand(
        "triple", "light times visibility times material: how fast, how exactly, and peers");
    app->add_option("--scene", options->surface.scene, "built-in scene")->capture_default_str();
    app->add_option("--environment", options->environment, "name or file")
        ->capture_default_str();
    app->add_option("--vertices", options->surface.vertices, "at most")->capture_default_str();
    app->add_option("-n,--light-resolution", options->surface.face_resolution,
                    "texels along a face, 4 to 256")
        ->capture_default_str();
    app->add_option("--side", options->surface.side, "of images, in pixels")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    app->add_option("--material", options->materials,
                    "as relume-bake material --model takes it; several with blanks")
        ->take_all();
    app->add_option("--threads", options->threads, "of all but rates a core")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app->add_option("--peer-vertices", options->peer_vertices, "that rates are measured with")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    app->add_option("--images", options->images, "of light and camera that move")
        ->check(CLI::Range(2, 10'000))
        ->capture_default_str();
    app->add_flag("--full", options->is_full, "300,000 vertices, as [Ng04]'s table");
    app->add_option("--pictures", options->pictures, "folder for images and a chart");
    app->add_flag("--json", options->as_json, "one JSON object");
    return {app, [options] { return run(*options); }};
}

}  // namespace relume::lab
