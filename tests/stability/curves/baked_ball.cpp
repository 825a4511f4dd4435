#include "tests/stability/curves/baked_ball.h"

#include "precompute/bake/bake.h"
#include "precompute/scene/builtin/mesh_builder.h"
#include "precompute/scene/camera.h"
#include "precompute/scene/surface_point.h"
#include "protocol/basis/cubemap.h"
#include "protocol/basis/curve_projection.h"
#include "protocol/basis/daubechies4.h"
#include "protocol/curve/curve_angle.h"
#include "tests/support/scratch_directory.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace relume::stability {
namespace {

using Imath::V3d;
using Imath::V3f;

constexpr std::uint32_t kAllColumns = std::numeric_limits<std::uint32_t>::max();

engine::StepReport advance(engine::Session& session, std::uint32_t columns) {
    return session.advance_incrementally(
        {.columns = columns, .bytes = std::numeric_limits<std::uint64_t>::max()});
}

// Planar [3][N].
std::vector<float> signal_of(const served::Scene& scene, const curve::Curve& curve) {
    const basis::CurveBasis& basis = scene.transport().manifest().signal_basis.curves();
    const std::size_t count = basis.coefficient_count();
    std::vector<float> signal(3 * count);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const std::span<float> plane = std::span(signal).subspan(channel * count, count);
        basis::project_rest(plane);
        basis::project_curve(basis, 0, 1, curve.rgb[channel], plane);
    }
    return signal;
}

scene::Scene ball_scene() {
    scene::Scene scene;
    scene.name = "ball";
    scene.materials.push_back({.name = "ball", .base_colour = V3f(0)});
    scene::MeshBuilder ball("ball", 0);
    ball.add_sphere({0, 0, 0}, 1, 256);
    scene.meshes.push_back(ball.take());
    scene.camera = {.name = "before",
                    .eye = {0, 0, 6},
                    .look_at = {0, 0, 0},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 20};
    finish_scene(scene);
    return scene;
}

// Where a ray from the camera meets the ball.
std::optional<V3d> normal_along(const V3d& eye, const V3d& direction) {
    const double middle = -eye.dot(direction);
    const double inside = middle * middle - eye.length2() + 1;
    if (inside < 0) {
        return std::nullopt;
    }
    return eye + direction * (middle - std::sqrt(inside));
}

V3f radiance_from(const light::LightCubemap& light, const V3f& direction) {
    const std::uint32_t n = light.face_resolution;
    const std::size_t i = basis::index_from_texel(n, basis::texel_from_direction(n, direction));
    const auto planes = light.planes();
    return {planes[0][i], planes[1][i], planes[2][i]};
}

// How a pixel is looked at: so many places along each of its sides, and from each so many half
// vectors. At the rim, places differ more than half vectors do.
struct Grid {
    int places = 0;
    int angles = 0;
    int azimuths = 0;
};
constexpr Grid kInside{.places = 2, .angles = 160, .azimuths = 20};
constexpr Grid kRim{.places = 6, .angles = 64, .azimuths = 12};
constexpr double kRimCosine = 0.6;

// ∫ L f cos θi dωi, by half vectors: dωi = 4 (ωo·h) dω_h. `jitter` in [0, 1).
V3d reflected_to(const V3f& normal,
                 const V3f& to_viewer,
                 const curve::CurveBrdf& brdf,
                 const light::LightCubemap& light,
                 const Grid& grid,
                 double jitter) {
    const scene::Frame frame = scene::Frame::from_normal(normal);
    const V3f wo = frame.to_local(to_viewer);
    V3d sum(0, 0, 0);
    for (int a = 0; a < grid.angles; ++a) {
        const double u = (a + std::fmod(jitter + a * 0.618034, 1.0)) / grid.angles;
        const double theta = u * u * std::numbers::pi / 2;
        const double of_theta = std::sin(theta) * std::numbers::pi * u / grid.angles * 2 *
                                std::numbers::pi / grid.azimuths;
        for (int p = 0; p < grid.azimuths; ++p) {
            const double phi = 2 * std::numbers::pi *
                               (p + std::fmod(jitter + a * 0.754878, 1.0)) / grid.azimuths;
            const V3f half(V3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                               std::cos(theta)));
            const float along = half.dot(wo);
            const V3f wi = half * (2 * along) - wo;
            if (along > 0 && wi.z > 0) {
                sum += V3d(brdf.evaluate(wi, wo) * radiance_from(light, frame.to_world(wi))) *
                       (double{wi.z} * 4 * double{along} * of_theta);
            }
        }
    }
    return sum;
}

}  // namespace

BakedBall::BakedBall(const light::LightCubemap& light, const BallOptions& options)
    : light_(light), brdf_(curve::CurveBrdf::phong(V3f(0), 1)), side_(options.side) {
    const scene::Scene scene = ball_scene();
    bake::BakeParameters parameters;
    parameters.width = parameters.height = side_;
    parameters.face_resolution = light.face_resolution;
    parameters.bounces = 0;
    parameters.samples = options.samples;
    bake::CurveEdits edits{
        .light = {},
        .materials = bake::edited_materials(
            scene, {.edits = {"ball." + options.curve}, .models = {"ball=" + options.model}})};
    edits.light.cubemap = light;
    brdf_ = edits.materials.front().brdf;
    edited_ = edits.materials.front().curve;
    // What has been opened is mapped and outlives its folder.
    const test::ScratchDirectory scratch;
    const auto directory = scratch.path() / "ball.relume";
    bake::bake_curves(scene, parameters, edits, directory);
    scene_ = std::make_shared<const served::Scene>(transport::Transport::open(directory));
}

RelitImage BakedBall::image(const curve::Curve& curve) const {
    return follow(curve, curve, kAllColumns, 0).image;
}

BakedBall::Followed BakedBall::follow(const curve::Curve& from,
                                      const curve::Curve& to,
                                      std::uint32_t columns,
                                      std::uint32_t images) const {
    engine::Session session(scene_->workspace(), {.method = relighting::Method::bi,
                                                  .priority = relighting::Strategy{}.priority});
    session.set_target(signal_of(*scene_, from));
    advance(session, kAllColumns);
    session.set_target(signal_of(*scene_, to));
    Followed followed;
    for (std::uint32_t image = 0; image < images; ++image) {
        followed.is_exact = advance(session, columns).remaining == 0;
    }
    followed.image = image_of(*scene_, session);
    const std::span<const float> shown = session.approximation();
    const std::size_t count = shown.size() / 3;
    constexpr std::size_t kFirst = 2;  // after what nobody edits and the diffuse colour
    for (std::size_t c = 0; c < 3; ++c) {
        basis::daubechies4_inverse(
            shown.subspan(c * count + kFirst).first<basis::kDaubechies4Size>(),
            followed.curve.rgb[c]);
    }
    return followed;
}

RelitImage BakedBall::reflected(const curve::Curve& curve) const {
    const curve::CurveBrdf brdf = brdf_.with_curve(edited_, curve);
    const scene::Camera camera(ball_scene().camera, side_, side_);
    const V3d eye(camera.eye());
    RelitImage image{side_, side_, std::vector<float>(std::size_t{3} * side_ * side_)};
    tbb::parallel_for(std::uint32_t{0}, side_ * side_, [&](std::uint32_t pixel) {
        const std::uint32_t x = pixel % side_;
        const std::uint32_t y = pixel / side_;
        const Grid& grid = cosine_to_viewer(x, y) < kRimCosine ? kRim : kInside;
        const int places = grid.places * grid.places;
        V3d sum(0, 0, 0);
        for (int place = 0; place < places; ++place) {
            const auto at = [&](std::uint32_t corner, int along) {
                return static_cast<float>(corner + (along + 0.5) / grid.places);
            };
            const V3d direction(camera.direction_from_pixel(at(x, place % grid.places),
                                                            at(y, place / grid.places)));
            if (const auto normal = normal_along(eye, direction.normalized())) {
                const double jitter = std::fmod(0.381966 * pixel + 0.618034 * place, 1.0);
                sum += reflected_to(V3f(*normal), V3f((eye - *normal).normalized()), brdf,
                                    light_, grid, jitter);
            }
        }
        for (int c = 0; c < 3; ++c) {
            image.rgb[3 * std::size_t{pixel} + static_cast<std::size_t>(c)] =
                static_cast<float>(sum[c] / places);
        }
    });
    return image;
}

double BakedBall::cosine_to_viewer(std::uint32_t x, std::uint32_t y) const {
    const scene::Camera camera(ball_scene().camera, side_, side_);
    const V3d eye(camera.eye());
    const auto normal =
        normal_along(eye, V3d(camera.direction_from_pixel(static_cast<float>(x) + 0.5F,
                                                          static_cast<float>(y) + 0.5F))
                              .normalized());
    return normal ? normal->dot((eye - *normal).normalized()) : 0;
}

}  // namespace relume::stability
