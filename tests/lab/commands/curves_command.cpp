// relume-lab curves: curves of materials that are edited, how fast and how exactly.
#include "protocol/base/timing/stopwatch.h"
#include "tests/lab/commands/commands.h"
#include "tests/lab/curves/curve_bases.h"
#include "tests/lab/curves/curve_convergence.h"
#include "tests/lab/curves/curve_room.h"
#include "tests/lab/curves/measured_curves.h"
#include "tests/lab/scenes/lab_scenes.h"
#include "tests/support/scene_cache.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <optional>
#include <string>
#include <vector>

namespace relume::lab {
namespace {

using nlohmann::json;

struct Options {
    std::string scene = "earrings";
    std::string edit = "pearl,cloth,post.fresnel";
    std::string environment = "studio-softboxes";
    std::uint32_t side = 512;
    std::uint32_t threads = 2;
    std::uint32_t images = 120;
    std::uint32_t columns = 30;
    std::string cache = default_scene_cache();
    bool as_json = false;
};

std::shared_ptr<const served::Scene> scene_of(const Options& options) {
    test::SceneCache cache(options.cache);
    return cache.baked(fmt::format("curves-{}-{}", options.scene, options.side),
                       {"--builtin", options.scene, "--edit", options.edit, "--environment",
                        options.environment, "--size", fmt::format("{0}x{0}", options.side)});
}

// Images per second, each with its JPEG, of a curve that changes with every image.
double images_per_second(CurveRoom& room,
                         CurveChange change,
                         const relighting::Budget& budget,
                         std::uint32_t images) {
    constexpr std::uint32_t kFirst = 10;  // until caches and cost models have settled
    std::optional<timing::Stopwatch> watch;
    for (std::uint32_t image = 0; image < kFirst + images; ++image) {
        if (image == kFirst) {
            watch.emplace();
        }
        room.set_curve(changed_curve(room.baked(), change, image));
        room.relight(budget);
        room.show();
    }
    room.finish();
    return images / watch->seconds();
}

// The whole product, every column, alone.
double whole_product_ms(CurveRoom& room, std::uint32_t images) {
    constexpr double kAmple = 1000;
    const relighting::Budget ample{
        .milliseconds = kAmple, .coefficients = {}, .target_error = 0};
    double total = 0;
    for (std::uint32_t image = 0; image < images; ++image) {
        room.set_curve(changed_curve(room.baked(), CurveChange::random, image));
        const timing::Stopwatch watch;
        while (!room.session().exact()) {
            room.relight(ample);
        }
        total += watch.milliseconds();
    }
    return total / images;
}

json convergence_of(const std::shared_ptr<const served::Scene>& scene) {
    constexpr std::array kColumns{10U, 20U, 30U};
    constexpr std::uint32_t kDrag = 60;
    json rows = json::array();
    for (const CurveChange change : kCurveChanges) {
        for (const std::uint32_t columns : kColumns) {
            json row{{"change", name_of(change)}, {"columns", columns}};
            for (const auto method : {relighting::Method::nwa, relighting::Method::bi}) {
                const CurveConvergence found =
                    curve_convergence(scene, 0, method, change, columns, kDrag);
                row[std::string(relighting::name_from(method))] = {
                    {"error", found.mean_error},
                    {"largest_error", found.largest_error},
                    {"images_to_exact", found.images_to_exact}};
            }
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

json bases_of(const transport::Transport& transport) {
    constexpr std::array kTerms{10U, 20U, 30U, 60U};
    constexpr std::uint32_t kEvery = 6;
    constexpr std::uint32_t kDrag = 60;
    const CurveGram gram = curve_gram(transport, 0);
    const curve::Curve baked{transport.manifest().curves->curves[0].baked};
    json rows = json::array();
    for (const CurveChange change : kCurveChanges) {
        for (const std::uint32_t terms : kTerms) {
            json row{{"change", name_of(change)}, {"terms", terms}};
            for (const CurveTerms basis : kCurveTerms) {
                double sum = 0;
                std::uint32_t count = 0;
                for (std::uint32_t image = 1; image < kDrag; image += kEvery, ++count) {
                    const curve::Curve edited = changed_curve(baked, change, image);
                    std::array<Eigen::VectorXd, 3> difference;
                    for (std::size_t c = 0; c < 3; ++c) {
                        difference[c].resize(curve::kCurveSamples);
                        for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
                            difference[c][static_cast<Eigen::Index>(k)] =
                                double{edited.rgb[c][k]} - double{baked.rgb[c][k]};
                        }
                    }
                    sum += error_of_terms(gram, difference, basis, terms);
                }
                row[std::string(name_of(basis))] = sum / count;
            }
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

json factors_of_measured() {
    json rows = json::array();
    for (const MeasuredCurves& found : measured_curves()) {
        rows.push_back({{"material", found.material},
                        {"method", factors::kCurveMethodNames.name(found.method)},
                        {"relative_l2", found.errors.relative_l2},
                        {"logarithmic", found.errors.logarithmic}});
    }
    return rows;
}

int run(const Options& options) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    options.threads);
    const auto scene = scene_of(options);
    const transport::Transport& transport = scene->transport();
    const auto curves = static_cast<std::uint32_t>(scene->curves().size());
    const relighting::Budget terms{
        .milliseconds = {}, .coefficients = options.columns, .target_error = 0};
    const relighting::Strategy incremental{.method = relighting::Method::bi,
                                           .priority = relighting::Strategy{}.priority};
    json figures;
    {
        CurveRoom room(scene, incremental, 0);
        figures["images_per_s"] =
            images_per_second(room, CurveChange::local, terms, options.images);
        figures["images_per_s_global"] =
            images_per_second(room, CurveChange::global, terms, options.images);
    }
    {
        constexpr std::uint32_t kProducts = 10;
        CurveRoom room(scene, incremental, 0);
        figures["whole_product_ms"] = whole_product_ms(room, kProducts);
    }
    constexpr std::uint32_t kChanges = 20;
    for (const CurveChange change : kCurveChanges) {
        figures[fmt::format("images_to_exact_{}", name_of(change))] =
            images_to_exact_after_one_change(scene, 0, change, options.columns, kChanges);
    }
    const auto pixels = static_cast<double>(scene->image().width) * scene->image().height;
    figures["bytes"] = transport.total_bytes();
    figures["bytes_a_material"] = static_cast<double>(transport.total_bytes()) / curves;
    figures["bytes_gain_over_dense"] = pixels * 3 * sizeof(float) * curve::kCurveSamples *
                                       curves / static_cast<double>(transport.total_bytes());
    const json configuration{{"scene", options.scene},
                             {"edit", options.edit},
                             {"environment", options.environment},
                             {"side", options.side},
                             {"threads", options.threads},
                             {"columns", options.columns},
                             {"curves", curves}};
    const json convergence = convergence_of(scene);
    const json bases = bases_of(transport);
    const json measured = factors_of_measured();
    if (options.as_json) {
        fmt::print("{}\n", json{{"configuration", configuration},
                                {"figures", figures},
                                {"convergence", convergence},
                                {"bases", bases},
                                {"measured", measured}}
                               .dump(2));
        return 0;
    }
    for (const auto& [key, value] : configuration.items()) {
        fmt::print("{:28} {}\n", key, value.dump());
    }
    for (const auto& [key, value] : figures.items()) {
        fmt::print("| `{}` | {:.4g} |\n", key, value.get<double>());
    }
    fmt::print(
        "\n| change | columns | NWA | to exact | BI | to exact |\n|---|---|---|---|---|---|\n");
    for (const json& row : convergence) {
        fmt::print("| {} | {} | {:.3g} | {} | {:.3g} | {} |\n",
                   row["change"].get<std::string>(), row["columns"].get<int>(),
                   row["nwa"]["error"].get<double>(), row["nwa"]["images_to_exact"].get<int>(),
                   row["bi"]["error"].get<double>(), row["bi"]["images_to_exact"].get<int>());
    }
    fmt::print(
        "\n| change | terms | Daubechies-4 | Haar | B-splines |\n|---|---|---|---|---|\n");
    for (const json& row : bases) {
        fmt::print("| {} | {} | {:.3g} | {:.3g} | {:.3g} |\n", row["change"].get<std::string>(),
                   row["terms"].get<int>(), row["daubechies4"].get<double>(),
                   row["haar"].get<double>(), row["splines"].get<double>());
    }
    fmt::print("\n| measured | method | relative L2 | logarithmic |\n|---|---|---|---|\n");
    for (const json& row : measured) {
        fmt::print("| {} | {} | {:.3g} | {:.3g} |\n", row["material"].get<std::string>(),
                   row["method"].get<std::string>(), row["relative_l2"].get<double>(),
                   row["logarithmic"].get<double>());
    }
    return 0;
}

}  // namespace

Command add_curves_command(CLI::App& program) {
    auto options = std::make_shared<Options>();
    CLI::App* app =
        program.add_subcommand("curves", "speed and errors of curves that are edited");
    app->add_option("--scene", options->scene, "built-in scene")->capture_default_str();
    app->add_option("--edit", options->edit, "its materials, as relume-bake takes them")
        ->capture_default_str();
    app->add_option("--environment", options->environment,
                    "file, or name of one made by formula")
        ->capture_default_str();
    app->add_option("--side", options->side, "of images, in pixels")->capture_default_str();
    app->add_option("--threads", options->threads, "of all that is timed")
        ->capture_default_str();
    app->add_option("--images", options->images, "that are timed")->capture_default_str();
    app->add_option("--columns", options->columns, "added for an image")->capture_default_str();
    app->add_option("--cache", options->cache, "folder of baked scenes")->capture_default_str();
    app->add_flag("--json", options->as_json, "one JSON object");
    return {app, [options] { return run(*options); }};
}

}  // namespace relume::lab
