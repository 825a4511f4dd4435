// relume-lab curves: curves of materials that are edited, how fast and how exactly.
#include "protocol/base/timing/stopwatch.h"
#include "protocol/light/light_rig.h"
#include "tests/lab/commands/commands.h"
#include "tests/lab/commands/markdown_table.h"
#include "tests/lab/curves/curve_bases.h"
#include "tests/lab/curves/curve_convergence.h"
#include "tests/lab/curves/curve_room.h"
#include "tests/lab/curves/lit_materials.h"
#include "tests/lab/curves/measured_curves.h"
#include "tests/lab/scenes/lab_scenes.h"
#include "tests/lab/sequences/environment_source.h"
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
    std::string editable = "pearl,cloth,post";
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

// The same view lit, whose materials are edited beside the light.
std::shared_ptr<const served::Scene> lit_scene_of(const Options& options) {
    test::SceneCache cache(options.cache);
    return cache.baked(fmt::format("lit-{}-{}", options.scene, options.side),
                       {"--builtin", options.scene, "--editable", options.editable, "--size",
                        fmt::format("{0}x{0}", options.side)});
}

json lit_materials_of(const Options& options) {
    const auto scene = lit_scene_of(options);
    light::LightRig rig;
    rig.environment = load_environment(options.environment, scene->face_resolution());
    light::LightCubemap light;
    light::evaluate(rig, scene->face_resolution(), light);
    json rows = json::array();
    for (const LitMaterial& found : take_up_curves(scene, light, options.images)) {
        rows.push_back({{"material", found.id},
                        {"points", found.points},
                        {"first_look_s", found.first_look_s},
                        {"seconds_to_take_up", found.columns_s},
                        {"whole_s", found.whole_s},
                        {"first_look_error", found.first_look_error},
                        {"taken_up_error", found.columns_error},
                        {"images_per_s", found.images_per_s},
                        {"bytes", found.bytes}});
    }
    return rows;
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

json figures_of(const std::shared_ptr<const served::Scene>& scene, const Options& options) {
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
    const auto bytes = static_cast<double>(scene->transport().total_bytes());
    const auto curves = static_cast<double>(scene->curves().size());
    const auto pixels = static_cast<double>(scene->image().width) * scene->image().height;
    figures["bytes"] = bytes;
    figures["bytes_a_material"] = bytes / curves;
    figures["bytes_gain_over_dense"] =
        pixels * 3 * sizeof(float) * curve::kCurveSamples * curves / bytes;
    return figures;
}

void print_tables(const json& all) {
    for (const auto& [key, value] : all["configuration"].items()) {
        fmt::print("{:28} {}\n", key, value.dump());
    }
    for (const auto& [key, value] : all["figures"].items()) {
        fmt::print("| `{}` | {:.4g} |\n", key, value.get<double>());
    }
    print_markdown_table({{"change", "change"},
                          {"columns", "columns"},
                          {"NWA", "nwa/error"},
                          {"to exact", "nwa/images_to_exact"},
                          {"BI", "bi/error"},
                          {"to exact", "bi/images_to_exact"}},
                         all["convergence"]);
    print_markdown_table({{"change", "change"},
                          {"terms", "terms"},
                          {"Daubechies-4", "daubechies4"},
                          {"Haar", "haar"},
                          {"B-splines", "splines"}},
                         all["bases"]);
    print_markdown_table({{"measured", "material"},
                          {"method", "method"},
                          {"relative L2", "relative_l2"},
                          {"logarithmic", "logarithmic"}},
                         all["measured"]);
    print_markdown_table({{"beside light", "material"},
                          {"points", "points"},
                          {"first look, s", "first_look_s"},
                          {"error", "first_look_error"},
                          {"taken up, s", "seconds_to_take_up"},
                          {"error", "taken_up_error"},
                          {"whole, s", "whole_s"},
                          {"images/s", "images_per_s"},
                          {"bytes", "bytes"}},
                         all["lit"]);
}

int run(const Options& options) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    options.threads);
    const auto scene = scene_of(options);
    const json all{{"configuration",
                    {{"scene", options.scene},
                     {"edit", options.edit},
                     {"editable", options.editable},
                     {"environment", options.environment},
                     {"side", options.side},
                     {"threads", options.threads},
                     {"columns", options.columns},
                     {"curves", scene->curves().size()}}},
                   {"figures", figures_of(scene, options)},
                   {"convergence", convergence_of(scene)},
                   {"bases", bases_of(scene->transport())},
                   {"measured", factors_of_measured()},
                   {"lit", lit_materials_of(options)}};
    if (options.as_json) {
        fmt::print("{}\n", all.dump(2));
    } else {
        print_tables(all);
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
    app->add_option("--editable", options->editable,
                    "its materials that are edited beside the light, likewise")
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
