#include "tests/lab/curves/curve_convergence.h"

#include "tests/lab/curves/curve_room.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relume::lab {
namespace {

constexpr std::uint32_t kAllColumns = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kMostImages = 1000;

// Images until nothing differs any more. NWA never gets there with fewer columns than differ
// from zero.
std::uint32_t images_until_exact(CurveRoom& room, std::uint32_t columns) {
    std::uint32_t images = 0;
    while (images < kMostImages) {
        const engine::StepReport step = room.relight_incrementally(columns);
        if (step.applied == 0) {
            return step.remaining == 0 ? images : kMostImages;
        }
        ++images;
        if (step.remaining == 0) {
            return images;
        }
    }
    return images;
}

}  // namespace

CurveConvergence curve_convergence(std::shared_ptr<const served::Scene> scene,
                                   std::uint32_t material,
                                   relighting::Method method,
                                   CurveChange change,
                                   std::uint32_t columns,
                                   std::uint32_t images) {
    CurveRoom room(scene, {.method = method, .priority = relighting::Strategy{}.priority},
                   material);
    CurveRoom truth(
        scene, {.method = relighting::Method::bi, .priority = relighting::Strategy{}.priority},
        material);
    images_until_exact(room, kAllColumns);
    CurveConvergence found;
    double squares = 0;
    for (std::uint32_t image = 0; image < images; ++image) {
        const curve::Curve curve = changed_curve(room.baked(), change, image);
        room.set_curve(curve);
        truth.set_curve(curve);
        room.relight_incrementally(columns);
        truth.relight_incrementally(kAllColumns);
        const double error = relative_error(room.session().sums(), truth.session().sums());
        squares += error * error;
        found.largest_error = std::max(found.largest_error, error);
    }
    found.mean_error = std::sqrt(squares / images);
    found.images_to_exact = images_until_exact(room, columns);
    return found;
}

std::uint32_t images_to_exact_after_one_change(std::shared_ptr<const served::Scene> scene,
                                               std::uint32_t material,
                                               CurveChange change,
                                               std::uint32_t columns,
                                               std::uint32_t changes) {
    CurveRoom room(
        scene, {.method = relighting::Method::bi, .priority = relighting::Strategy{}.priority},
        material);
    images_until_exact(room, kAllColumns);
    std::uint32_t most = 0;
    for (std::uint32_t i = 0; i < changes; ++i) {
        room.set_curve(changed_curve(room.baked(), change, i));
        most = std::max(most, images_until_exact(room, columns));
    }
    return most;
}

}  // namespace relume::lab
