#include "tests/lab/triple/moving_scene.h"

#include "precompute/materials/field_baker.h"
#include "precompute/materials/model_words.h"
#include "protocol/base/timing/stopwatch.h"
#include "protocol/light/light_cubemap.h"
#include "protocol/light/light_rig.h"
#include "protocol/transport/visibility_field.h"
#include "server/triple/triple_session.h"
#include "tests/lab/sequences/environment_source.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace relume::lab {
namespace {

constexpr double kStepDegrees = 1.5;
constexpr double kBudgetMilliseconds = 8;

double step_radians(std::uint32_t image) {
    return image * kStepDegrees * std::numbers::pi / 180;
}

// Around the vertical through what the camera looks at.
scene::CameraPlacement turned(scene::CameraPlacement camera, double radians) {
    const Imath::V3f arm = camera.eye - camera.look_at;
    const auto c = static_cast<float>(std::cos(radians));
    const auto s = static_cast<float>(std::sin(radians));
    camera.eye =
        camera.look_at + Imath::V3f(c * arm.x + s * arm.z, arm.y, c * arm.z - s * arm.x);
    return camera;
}

std::shared_ptr<const triple::LitSurface> lit_surface_of(const SeenSurface& surface) {
    const bake::RefinedSurface& refined = surface.surface();
    transport::VisibilityFieldBuilder builder(
        surface.face_resolution(), static_cast<std::uint32_t>(refined.clusters.size()));
    for (std::uint32_t i = 0; i < refined.clusters.size(); ++i) {
        std::vector<std::uint64_t> block;
        const bake::VertexCluster& cluster = refined.clusters[i];
        for (std::uint32_t vertex = cluster.first; vertex < cluster.first + cluster.count;
             ++vertex) {
            const auto bits = surface.bits(vertex);
            block.insert(block.end(), bits.begin(), bits.end());
        }
        builder.set_block(i, block);
    }
    const std::vector<std::byte> bytes = builder.bytes();
    return std::make_shared<triple::LitSurface>(
        refined.mesh, std::vector<std::uint32_t>(surface.vertex_count(), 0),
        transport::VisibilityField(bytes, "visibility.bin"));
}

// Edits as a room makes them.
class Mover {
  public:
    Mover(const SeenSurface& surface,
          triple::TripleSession session,
          const std::string& environment,
          std::uint32_t images)
        : n_(surface.face_resolution()), session_(std::move(session)) {
        rig_.environment = load_environment(environment, n_);
        for (std::uint32_t image = 0; image < images; ++image) {
            cameras_.push_back(turned(surface.scene().camera, step_radians(image)));
            seen_.push_back(surface.seen_from(cameras_.back(), surface.side()));
        }
        turn_light(0);
        move_camera(0);
    }

    void turn_light(std::uint32_t image) {
        rig_.rotation.setAxisAngle({0, 1, 0}, static_cast<float>(step_radians(image)));
        light::evaluate(rig_, n_, cubemap_);
        const auto planes = std::as_const(cubemap_).planes();
        session_.set_light({planes[0], planes[1], planes[2]});
    }
    void move_camera(std::uint32_t image) {
        session_.set_view(cameras_[image].eye, seen_[image]);
    }
    triple::TripleSession& session() { return session_; }
    [[nodiscard]] const std::vector<std::uint32_t>& seen(std::uint32_t image) const {
        return seen_[image];
    }

  private:
    std::uint32_t n_;
    triple::TripleSession session_;
    light::LightRig rig_;
    light::LightCubemap cubemap_;
    std::vector<scene::CameraPlacement> cameras_;
    std::vector<std::vector<std::uint32_t>> seen_;
};

void finish(triple::TripleSession& session) {
    while (session.advance_by(session.stale_count())) {
    }
}

template <typename Edit>
double exact_images_per_second(Mover& mover, std::uint32_t images, const Edit& edit) {
    finish(mover.session());
    const timing::Stopwatch watch;
    for (std::uint32_t image = 0; image < images; ++image) {
        edit(image);
        finish(mover.session());
    }
    return images / watch.seconds();
}

double error_of(const triple::TripleSession& session, const std::vector<std::uint32_t>& seen) {
    triple::TripleSession truth = session;
    finish(truth);
    double difference = 0;
    double norm = 0;
    for (const std::uint32_t vertex : seen) {
        for (std::size_t c = 0; c < 3; ++c) {
            const double is = truth.radiance()[vertex][c];
            difference += std::pow(double{session.radiance()[vertex][c]} - is, 2);
            norm += is * is;
        }
    }
    return norm > 0 ? std::sqrt(difference / norm) : 0;
}

}  // namespace

MovingFigures move_scene(const SeenSurface& surface,
                         const std::string& words,
                         const std::string& environment,
                         std::uint32_t images) {
    MovingFigures figures;
    figures.material = words;
    figures.seen_vertices = surface.seen().size();
    const materials::FieldModel model = materials::model_from_words(words);
    materials::FieldParameters parameters =
        materials::usual_parameters(model, surface.face_resolution());
    parameters.energy_fraction = 0.9999;
    materials::FieldReport report;
    const timing::Stopwatch baking;
    const tripling::MaterialField field = materials::bake_field(model, parameters, report);
    figures.field_seconds = baking.seconds();
    figures.field_bytes = static_cast<double>(field.byte_count());
    const timing::Stopwatch loading;
    const auto material = std::make_shared<triple::TexelMaterial>(field);
    figures.load_seconds = loading.seconds();
    figures.texel_bytes = static_cast<double>(material->byte_count());
    const auto lit = lit_surface_of(surface);
    figures.surface_bytes = static_cast<double>(lit->byte_count());
    triple::TripleSession session(lit);
    session.set_material(0, material);
    Mover mover(surface, std::move(session), environment, images);
    figures.images_per_s_light_only = exact_images_per_second(
        mover, images, [&](std::uint32_t image) { mover.turn_light(image); });
    figures.images_per_s_view_only = exact_images_per_second(
        mover, images, [&](std::uint32_t image) { mover.move_camera(image); });
    figures.images_per_s_light_and_view =
        exact_images_per_second(mover, images, [&](std::uint32_t image) {
            mover.turn_light(image);
            mover.move_camera(image);
        });
    for (std::uint32_t image = 0; image < images; ++image) {
        mover.turn_light(image);
        mover.move_camera(image);
        mover.session().advance(kBudgetMilliseconds);
    }
    figures.stated_error_while_moving = mover.session().stated_error();
    figures.error_while_moving = error_of(mover.session(), mover.seen(images - 1));
    while (!mover.session().exact()) {
        mover.session().advance(kBudgetMilliseconds);
        ++figures.images_to_exact;
    }
    return figures;
}

}  // namespace relume::lab
