#include "tests/lab/triple/triple_pareto.h"

#include "precompute/bake/bake.h"
#include "precompute/factors/brdf_lobes.h"
#include "precompute/materials/field_baker.h"
#include "precompute/materials/model_words.h"
#include "precompute/scene/builtin.h"
#include "protocol/base/timing/stopwatch.h"
#include "protocol/light/light_cubemap.h"
#include "protocol/tripling/texel_blocks.h"
#include "server/engine/kernels/open_texels.h"
#include "server/engine/operators/stored_operator.h"
#include "server/engine/workspace.h"
#include "server/triple/texel_material.h"
#include "server/triple/triple_session.h"
#include "tests/lab/geometry/orbit.h"
#include "tests/lab/methods/component_image.h"
#include "tests/lab/methods/derived_transports.h"
#include "tests/lab/methods/session_contestant.h"
#include "tests/lab/methods/wavelet_terms.h"
#include "tests/lab/triple/seen_surface.h"
#include "tests/lab/triple/triple_experiment.h"
#include "tests/lab/triple/turning_light.h"
#include "tests/lab/triple/vertex_image.h"
#include "tests/support/scene_cache.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace relume::lab {
namespace {

constexpr float kBase = 0.8F;
constexpr float kMetallic = 0.5F;
constexpr std::uint32_t kStepsBefore = 6;
// Clustered PCA holds eight bytes for every value of the rows, and has these terms.
constexpr std::uint32_t kTermsOfClusters = 4;
constexpr std::size_t kShare = 4;

constexpr relighting::Strategy kPbi{.method = relighting::Method::pbi,
                                    .priority = relighting::Priority::transport};

using Radiances = std::vector<engine::Radiance>;

scene::Scene scene_of_one_material(const TripleParetoOptions& options) {
    scene::Scene scene = scene::build_builtin_scene(options.scene);
    for (scene::Material& material : scene.materials) {
        material = {.name = material.name,
                    .model = scene::BsdfModel::ggx,
                    .base_colour = Imath::V3f(kBase),
                    .metallic = kMetallic,
                    .roughness = options.roughness};
    }
    return scene;
}

// With what its vertices see.
std::shared_ptr<const served::Scene> baked(const TripleParetoOptions& options) {
    const std::filesystem::path directory =
        options.cache / fmt::format("triple-pareto-{}-{}-{}-{}-{}-{}.relume", options.scene,
                                    options.roughness, options.vertices,
                                    options.face_resolution, options.terms, options.side);
    if (auto scene = test::open_if_whole(directory)) {
        return scene;
    }
    const bake::BakeParameters parameters{.receivers = bake::ReceiverKind::vertices,
                                          .width = options.side,
                                          .height = options.side,
                                          .face_resolution = options.face_resolution,
                                          .bounces = 0,
                                          .edge_samples = 0,
                                          .vertices = options.vertices,
                                          .target_error = 1e-6,
                                          .terms = options.terms};
    std::filesystem::create_directories(directory);
    bake::bake(scene_of_one_material(options), parameters, directory, {}, {},
               {.of_vertices = true});
    return std::make_shared<const served::Scene>(transport::Transport::open(directory));
}

// What all methods are given, and are measured against.
struct Image {
    light::LightCubemap radiance;
    std::vector<float> haar;
    std::unique_ptr<TripleLight> light;
    view::Look look;
    std::vector<SeenVertex> seen;
    Radiances exact;
};

// A method, image by image. `show` makes an image of what it was told, and is timed by itself.
class Runner {
  public:
    Runner() = default;
    Runner(const Runner&) = delete;
    Runner& operator=(const Runner&) = delete;
    virtual ~Runner() = default;
    // Seconds it takes; radiances of image.seen.
    virtual double show(const Image& image, Radiances& radiance) = 0;
};

// A session of the engine, by sums of columns.
class SessionRunner final : public Runner {
  public:
    SessionRunner(std::unique_ptr<Contestant> contestant, const VertexImageMaker& vertices)
        : contestant_(std::move(contestant)), vertices_(vertices) {}

    double show(const Image& image, Radiances& radiance) override {
        contestant_->set_light({.radiance = image.radiance, .haar = image.haar});
        contestant_->look(image.look);
        const timing::Stopwatch watch;
        (void)contestant_->step();
        const double seconds = watch.seconds();
        std::vector<float> rgb(3 * image.seen.size());
        contestant_->write_image(rgb);
        for (std::size_t i = 0; i < image.seen.size(); ++i) {
            radiance[i] = {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]};
        }
        return seconds + vertices_.write_seconds();
    }

  private:
    std::unique_ptr<Contestant> contestant_;
    const VertexImageMaker& vertices_;
};

// The server's session: over open texels, every vertex from nothing.
class BitsRunner final : public Runner {
  public:
    BitsRunner(const SeenSurface& surface,
               std::shared_ptr<const triple::TexelMaterial> material)
        : surface_(surface), session_(surface.lit()) {
        session_.set_material(0, std::move(material));
    }

    double show(const Image& image, Radiances& radiance) override {
        std::vector<std::uint32_t> seen;
        for (const SeenVertex& vertex : image.seen) {
            seen.push_back(vertex.vertex);
        }
        const auto planes = image.radiance.planes();
        session_.set_light({planes[0], planes[1], planes[2]});
        session_.set_view(surface_.eye_in_frame(image.look), seen);
        const timing::Stopwatch watch;
        while (session_.advance_by(session_.stale_count())) {
        }
        const double seconds = watch.seconds();
        for (std::size_t i = 0; i < seen.size(); ++i) {
            radiance[i] = session_.radiance()[seen[i]];
        }
        return seconds;
    }

  private:
    const SeenSurface& surface_;
    triple::TripleSession session_;
};

// The sublinear integral of a part of the wavelets.
class WaveletRunner final : public Runner {
  public:
    WaveletRunner(const SeenSurface& surface,
                  const TabulatedMaterial& material,
                  std::size_t fraction,
                  double of_light)
        : surface_(surface), material_(material), fraction_(fraction), of_light_(of_light) {}

    double show(const Image& image, Radiances& radiance) override {
        const tripling::SquareSet terms = image.light->largest(of_light_);
        const TripleWay way =
            sublinear_way_at(surface_, image.seen, material_, fraction_, *image.light, terms);
        const timing::Stopwatch watch;
        radiance = integrate_all(image.seen.size(), way);
        return watch.seconds();
    }

  private:
    const SeenSurface& surface_;
    const TabulatedMaterial& material_;
    std::size_t fraction_;
    double of_light_;
};

struct Entrant {
    std::string series;
    std::string setting;
    std::function<std::unique_ptr<Runner>()> enter;
};

class Comparison {
  public:
    explicit Comparison(const TripleParetoOptions& options)
        : options_(options),
          scene_(baked(options)),
          surface_(scene_, options.side),
          words_(fmt::format(
              "ggx:roughness={},base={},metallic={}", options.roughness, kBase, kMetallic)),
          tabulated_(words_, options.face_resolution, kMaterialFractions),
          turning_(options.environment, options.face_resolution) {
        const materials::FieldModel model = materials::model_from_words(words_);
        materials::FieldParameters parameters =
            materials::usual_parameters(model, options.face_resolution);
        parameters.energy_fraction = 0.9999;
        materials::FieldReport report;
        texels_ = std::make_shared<triple::TexelMaterial>(
            materials::bake_field(model, parameters, report));
        add_entrants();
    }

    [[nodiscard]] TriplePareto measure() {
        TriplePareto found{
            .vertices = surface_.vertex_count(),
            .seen = surface_.seen().size(),
            .panels = {},
            .visibility_bytes = static_cast<double>(surface_.vertex_count() *
                                                    surface_.bits_in_blocks(0).size_bytes()),
            .material_bytes = static_cast<double>(texels_->byte_count()),
            .factored_bytes = static_cast<double>(scene_->transport().total_bytes())};
        for (const auto& [moving, light, view] :
             {std::tuple("light", true, false), std::tuple("view", false, true),
              std::tuple("light and view", true, true)}) {
            found.panels.push_back(panel(moving, light, view));
        }
        return found;
    }

  private:
    [[nodiscard]] std::vector<Imath::V3f> lobe_colours() const {
        return factors::lobe_colours(
            scene::Bsdf::ggx(Imath::V3f(kBase), kMetallic, options_.roughness));
    }

    [[nodiscard]] std::unique_ptr<VertexImageMaker> vertices_of(
        const std::shared_ptr<const served::Scene>& scene) const {
        return std::make_unique<VertexImageMaker>(surface_, scene, lobe_colours());
    }

    // Without columns an image is the whole product.
    [[nodiscard]] std::unique_ptr<Runner> factored(std::uint32_t terms, std::uint32_t columns) {
        const auto fewer = derived_.leading_terms(*scene_, terms);
        auto vertices = vertices_of(fewer);
        const VertexImageMaker& own = *vertices;
        return std::make_unique<SessionRunner>(
            std::make_unique<SessionContestant>(SessionParts{.scene = fewer,
                                                             .workspace = fewer->workspace(),
                                                             .image = std::move(vertices)},
                                                kPbi, budget_of(columns),
                                                fewer->columns().count()),
            own);
    }

    [[nodiscard]] std::unique_ptr<Runner> clustered(std::size_t bases, std::uint32_t columns) {
        constexpr std::size_t kClusters = 128;
        const auto fewer = derived_.leading_terms(*scene_, kTermsOfClusters);
        const auto clusters =
            derived_of_fewer_.clustered(*fewer, {.clusters = kClusters, .bases = bases});
        auto vertices = vertices_of(fewer);
        const VertexImageMaker& own = *vertices;
        return std::make_unique<SessionRunner>(
            std::make_unique<SessionContestant>(
                SessionParts{
                    .scene = fewer,
                    .workspace = std::make_shared<const engine::Workspace>(
                        std::make_shared<const engine::StoredOperator>(clusters->components)),
                    .image = std::make_unique<ComponentImageMaker>(fewer, clusters, kShare,
                                                                   std::move(vertices))},
                kPbi, budget_of(columns), fewer->columns().count()),
            own);
    }

    [[nodiscard]] static std::optional<engine::SelectionBudget> budget_of(
        std::uint32_t columns) {
        return columns == 0
                   ? std::nullopt
                   : std::optional(wavelet_terms_from_text(std::to_string(columns)).budget);
    }

    void add_entrants() {
        entrants_.push_back({.series = "triple, bits", .setting = "all of it", .enter = [this] {
                                 return std::make_unique<BitsRunner>(surface_, texels_);
                             }});
        for (std::size_t f = 1; f < kMaterialFractions.size(); ++f) {
            for (const double of_light : {1e-3, 5e-3, 2e-2, 1.0}) {
                entrants_.push_back(
                    {.series = fmt::format("triple, {:g} % of ρ", 100 * kMaterialFractions[f]),
                     .setting = fmt::format("{:g} % of L", 100 * of_light),
                     .enter = [this, f, of_light] {
                         return std::make_unique<WaveletRunner>(surface_, tabulated_, f,
                                                                of_light);
                     }});
            }
        }
        const auto add = [&](const std::string& series, const auto& enter) {
            for (const std::uint32_t columns : {30U, 100U, 300U, 1000U, 0U}) {
                entrants_.push_back(
                    {.series = series,
                     .setting = columns == 0 ? "all columns"
                                             : fmt::format("{} columns an image", columns),
                     .enter = [enter, columns] { return enter(columns); }});
            }
        };
        for (const std::uint32_t terms : {1U, kTermsOfClusters, options_.terms}) {
            add(fmt::format("factored, K = {}", terms),
                [this, terms](std::uint32_t columns) { return factored(terms, columns); });
        }
        for (const std::size_t bases : {12UL, 48UL}) {
            add(fmt::format("CPCA, K = {}, S = {}", kTermsOfClusters, bases),
                [this, bases](std::uint32_t columns) { return clustered(bases, columns); });
        }
    }

    void make_image(std::uint32_t of_light, std::uint32_t of_view, Image& image) {
        const auto planes = turning_.turned(of_light);
        image.radiance.reset(options_.face_resolution);
        std::array<std::vector<float>, 3> copy;
        const auto own = image.radiance.planes();
        for (std::size_t c = 0; c < copy.size(); ++c) {
            copy[c].assign(planes[c].begin(), planes[c].end());
            std::copy(planes[c].begin(), planes[c].end(), own[c].begin());
        }
        light::lighting_coefficients(image.radiance, scene_->projection(), image.haar);
        image.light = std::make_unique<TripleLight>(options_.face_resolution, std::move(copy));
        image.look = orbited(scene_->beginning(), of_view * kTurnDegrees);
        image.seen = surface_.seen_from(image.look);
        image.exact.resize(image.seen.size());
        tbb::parallel_for(std::size_t{0}, image.seen.size(), [&](std::size_t i) {
            const SeenVertex& seen = image.seen[i];
            const std::vector<float> texels = tripling::values_in_blocks(
                options_.face_resolution, tabulated_.at(seen.normal, seen.reflection));
            image.exact[i] =
                engine::sum_open_products(surface_.bits_in_blocks(seen.vertex),
                                          image.light->block_planes(), texels.data());
        });
    }

    TripleParetoPanel panel(const std::string& moving, bool light, bool view) {
        std::vector<Image> images(options_.images + 1);
        for (std::uint32_t i = 0; i < images.size(); ++i) {
            make_image(light ? i : 0, view ? i : 0, images[i]);
        }
        TripleParetoPanel panel{.moving = moving, .points = {}};
        for (const Entrant& entrant : entrants_) {
            const std::unique_ptr<Runner> runner = entrant.enter();
            Radiances radiance(images.front().seen.size());
            for (std::uint32_t step = 0; step < kStepsBefore; ++step) {
                (void)runner->show(images.front(), radiance);
            }
            std::vector<double> milliseconds;
            double error = 0;
            for (std::uint32_t i = 1; i < images.size(); ++i) {
                radiance.assign(images[i].seen.size(), {});
                milliseconds.push_back(1e3 * runner->show(images[i], radiance));
                error += relative_l2(radiance, images[i].exact) / options_.images;
            }
            std::sort(milliseconds.begin(), milliseconds.end());
            panel.points.push_back({.series = entrant.series,
                                    .setting = entrant.setting,
                                    .milliseconds = milliseconds[milliseconds.size() / 2],
                                    .error = error});
        }
        return panel;
    }

    const TripleParetoOptions& options_;
    std::shared_ptr<const served::Scene> scene_;
    SeenSurface surface_;
    std::string words_;
    TabulatedMaterial tabulated_;
    std::shared_ptr<const triple::TexelMaterial> texels_;
    TurningLight turning_;
    DerivedTransports derived_;
    DerivedTransports derived_of_fewer_;
    std::vector<Entrant> entrants_;
};

}  // namespace

TriplePareto measure_triple_pareto(const TripleParetoOptions& options) {
    return Comparison(options).measure();
}

}  // namespace relume::lab
