#include "tests/stability/relit_image.h"

#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"

#include <cmath>
#include <limits>

namespace relume::stability {
namespace {

template <typename Value>
double root_of_squares(std::size_t count, Value value) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        sum += value(i) * value(i);
    }
    return std::sqrt(sum);
}

}  // namespace

RelitImage image_of(const served::Scene& scene, const engine::Session& session) {
    const auto& size = scene.image();
    RelitImage image{size.width, size.height, {}};
    image.rgb.resize(std::size_t{3} * size.width * size.height);
    scene.write_image(session.sums(), image.rgb);
    return image;
}

double norm(const RelitImage& image) {
    return root_of_squares(image.rgb.size(),
                           [&](std::size_t i) { return double{image.rgb[i]}; });
}

double distance(const RelitImage& a, const RelitImage& b) {
    return root_of_squares(a.rgb.size(),
                           [&](std::size_t i) { return double{a.rgb[i]} - double{b.rgb[i]}; });
}

double error_change(const RelitImage& a0,
                    const RelitImage& b0,
                    const RelitImage& a1,
                    const RelitImage& b1) {
    return root_of_squares(a0.rgb.size(), [&](std::size_t i) {
        return (double{a1.rgb[i]} - double{b1.rgb[i]}) -
               (double{a0.rgb[i]} - double{b0.rgb[i]});
    });
}

RelitImage absolute_difference(const RelitImage& a, const RelitImage& b, float gain) {
    RelitImage difference = a;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        difference.rgb[i] = gain * std::abs(a.rgb[i] - b.rgb[i]);
    }
    return difference;
}

RelitRun relight_in_turn(const std::shared_ptr<const served::Scene>& scene,
                         relighting::Strategy strategy,
                         std::uint32_t columns,
                         std::span<const Lighting> lightings) {
    engine::Session session(scene->workspace(), strategy);
    RelitRun run;
    for (const Lighting& lighting : lightings) {
        session.set_target(lighting);
        run.steps.push_back(session.advance_incrementally(
            {.columns = columns, .bytes = std::numeric_limits<std::uint64_t>::max()}));
        run.images.push_back(image_of(*scene, session));
        run.approximations.emplace_back(session.approximation().begin(),
                                        session.approximation().end());
    }
    return run;
}

std::vector<RelitImage> exact_images(const std::shared_ptr<const served::Scene>& scene,
                                     std::span<const Lighting> lightings) {
    engine::Session session(scene->workspace(), {});
    std::vector<RelitImage> images;
    for (const Lighting& lighting : lightings) {
        session.set_target(lighting);
        run_until_exact(session);
        images.push_back(image_of(*scene, session));
    }
    return images;
}

void run_until_exact(engine::Session& session) {
    constexpr relighting::Budget kAllAtOnce{
        .milliseconds = 1e6, .coefficients = std::nullopt, .target_error = 0};
    while (!session.exact()) {
        session.advance(kAllAtOnce);
    }
}

}  // namespace relume::stability
