#include "tests/lab/triple/moving_scene.h"

#include "precompute/materials/field_baker.h"
#include "precompute/materials/model_words.h"
#include "protocol/base/timing/stopwatch.h"
#include "server/triple/triple_session.h"
#include "tests/lab/geometry/orbit.h"
#include "tests/lab/triple/turning_light.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace relume::lab {
namespace {

constexpr double kBudgetMilliseconds = 8;

// Edits as a room makes them.
class Mover {
  public:
    Mover(const SeenSurface& surface,
          triple::TripleSession session,
          const std::string& environment,
          std::uint32_t images)
        : session_(std::move(session)), light_(environment, surface.face_resolution()) {
        for (std::uint32_t image = 0; image < images; ++image) {
            const view::Look look = orbited(surface.scene()->beginning(), image * kTurnDegrees);
            eyes_.push_back(surface.eye_in_frame(look));
            std::vector<std::uint32_t>& seen = seen_.emplace_back();
            for (const SeenVertex& vertex : surface.seen_from(look)) {
                seen.push_back(vertex.vertex);
            }
        }
        turn_light(0);
        move_camera(0);
    }

    void turn_light(std::uint32_t image) { session_.set_light(light_.turned(image)); }
    void move_camera(std::uint32_t image) { session_.set_view(eyes_[image], seen_[image]); }
    triple::TripleSession& session() { return session_; }
    [[nodiscard]] const std::vector<std::uint32_t>& seen(std::uint32_t image) const {
        return seen_[image];
    }

  private:
    triple::TripleSession session_;
    TurningLight light_;
    std::vector<Imath::V3f> eyes_;
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
    figures.surface_bytes = static_cast<double>(surface.lit()->byte_count());
    triple::TripleSession session(surface.lit());
    session.set_material(0, triple::Finish(material));
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
