#include "tests/lab/experiment.h"

#include "server/engine/session.h"

#include <chrono>

namespace relume::lab {
namespace {

// The exact image of a light, from a session that is given time until it is at rest.
class Reference {
  public:
    explicit Reference(const std::shared_ptr<const engine::Scene>& scene)
        : session_(scene, {}) {}

    void write_image(std::span<const float> lighting, std::span<float> rgb) {
        session_.set_lighting(lighting);
        while (!session_.exact()) {
            session_.advance(kAllAtOnce);
        }
        session_.write_image(rgb);
    }

  private:
    static constexpr wire::Budget kAllAtOnce{
        .milliseconds = 1e6, .coefficients = std::nullopt, .target_error = 0};
    engine::Session session_;
};

struct Contestant {
    Method method;
    engine::Session session;
};

Record measure(Contestant& contestant,
               std::span<const float> lighting,
               std::span<const float> reference,
               std::span<float> image) {
    const auto start = std::chrono::steady_clock::now();
    contestant.session.set_lighting(lighting);
    const engine::StepReport step =
        contestant.session.advance_incrementally(contestant.method.budget);
    const auto end = std::chrono::steady_clock::now();
    contestant.session.write_image(image);
    const auto width = contestant.session.scene().image().width;
    return {.method = contestant.method.label(),
            .image = 0,
            .error = image_error(image, reference, width),
            .stated_error = step.stated_error,
            .applied = step.applied,
            .bands_reset = step.bands_reset,
            .bytes_touched = step.bytes_touched,
            .microseconds = std::chrono::duration<double, std::micro>(end - start).count()};
}

}  // namespace

std::vector<Record> run_experiment(const std::shared_ptr<const engine::Scene>& scene,
                                   const LightingSequence& sequence,
                                   const std::vector<Method>& methods,
                                   const std::function<void(std::uint32_t)>& progress) {
    const std::size_t values = std::size_t{3} * scene->image().width * scene->image().height;
    std::vector<float> reference_image(values);
    std::vector<float> image(values);
    std::vector<float> lighting;
    light::LightCubemap cubemap(scene->face_resolution());
    Reference reference(scene);
    std::vector<Contestant> contestants;
    for (const Method& method : methods) {
        contestants.push_back({method, engine::Session(scene, method.strategy)});
    }
    std::vector<Record> records;
    for (std::uint32_t i = 0; i < sequence.images; ++i) {
        light::evaluate(sequence.rig(i), scene->face_resolution(), cubemap);
        light::lighting_coefficients(cubemap, scene->projection(), lighting);
        reference.write_image(lighting, reference_image);
        for (Contestant& contestant : contestants) {
            records.push_back(measure(contestant, lighting, reference_image, image));
            records.back().image = i;
        }
        progress(i);
    }
    return records;
}

}  // namespace relume::lab
