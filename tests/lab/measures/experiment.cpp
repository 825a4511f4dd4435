#include "tests/lab/measures/experiment.h"

#include "protocol/basis/cubemap.h"
#include "protocol/relighting/budget.h"
#include "server/engine/session.h"
#include "tests/lab/measures/lighting_error.h"
#include "tests/lab/measures/perceptual_difference.h"
#include "tests/lab/methods/image_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <optional>
#include <stdexcept>
#include <utility>

namespace relume::lab {
namespace {

using transport::kColours;

// The exact image of a light, from a session that is given time until it is at rest.
class Reference {
  public:
    explicit Reference(const served::Scene& scene)
        : session_(scene.workspace(), {}), image_(scene) {}

    void write_image(std::span<const float> lighting,
                     const view::Look& look,
                     std::span<float> rgb) {
        session_.set_target(lighting);
        while (!session_.exact()) {
            session_.advance(kAllAtOnce);
        }
        image_.look(look);
        image_.take(session_.sums());
        image_.write(rgb);
    }

  private:
    static constexpr relighting::Budget kAllAtOnce{
        .milliseconds = 1e6, .coefficients = std::nullopt, .target_error = 0};
    engine::Session session_;
    ViewImageMaker image_;
};

// Throws std::invalid_argument where the camera of an image is asked to move.
void require_movable(const served::Scene& scene, const LightingSequence& sequence) {
    if (!scene.view_can_move() && sequence.moves_camera()) {
        throw std::invalid_argument(
            fmt::format("sequence '{}' moves the camera, and {} is of kind image: expected a "
                        "transport of kind mesh",
                        sequence.name, scene.transport().directory().string()));
    }
}

double square(double x) {
    return x * x;
}

// What is known of one image before any method has seen it.
struct Truth {
    ImageLight light;
    view::Look look;
    std::span<const float> image;
    std::uint32_t width;
};

// A method at work, and what its measures remember of the image before.
class Entrant {
  public:
    Entrant(const Method& method, const LabScene& scene, std::size_t values)
        : label_(method.label),
          contestant_(method.enter(scene)),
          lighting_error_(scene.haar->face_resolution()),
          image_(values),
          previous_error_(values) {
        const LightingView lighting = contestant_->lighting();
        previous_target_.resize(lighting.approximation.size());
        previous_approximation_.assign(lighting.approximation.begin(),
                                       lighting.approximation.end());
        covered_.resize(lighting.bands.size());
    }

    Record measure(const Truth& truth) {
        contestant_->set_light(truth.light);
        contestant_->look(truth.look);
        const auto start = std::chrono::steady_clock::now();
        const Step step = contestant_->step();
        const auto end = std::chrono::steady_clock::now();
        contestant_->write_image(image_);
        contestant_->write_radiance(shown_);
        Record record{
            .method = label_,
            .image = 0,
            .error = image_error(image_, truth.image, truth.width),
            .lighting_l1 = lighting_error_.relative_l1(shown_, truth.light.radiance),
            .flicker = error_change(image_, truth.image, previous_error_),
            .delta_e = mean_delta_e(image_, truth.image),
            .stated_error = step.stated_error,
            .applied = step.applied,
            .bands_reset = step.bands_reset,
            .covered = 0,
            .bytes = step.bytes,
            .band_bytes = step.band_bytes,
            .microseconds = std::chrono::duration<double, std::micro>(end - start).count(),
            .bands = {}};
        record_bands(step.bands_reset, record);
        return record;
    }

    // Nothing for a method that is not in wavelets.
    [[nodiscard]] std::optional<Coverage> coverage(std::uint32_t face_resolution) const {
        if (covered_.size() != basis::texel_count(face_resolution)) {
            return std::nullopt;
        }
        std::vector<bool> together(covered_.size());
        for (const std::vector<bool>& updated : recent_) {
            for (std::size_t j = 0; j < updated.size(); ++j) {
                together[j] = together[j] || updated[j];
            }
        }
        return Coverage{.method = label_,
                        .image = 0,
                        .levels = covered_levels(face_resolution, recent_.back()),
                        .cumulative = covered_levels(face_resolution, together)};
    }

    [[nodiscard]] const std::string& label() const { return label_; }
    [[nodiscard]] const std::vector<float>& image() const { return image_; }

  private:
    void record_bands(std::uint32_t bands_reset, Record& record) {
        const LightingView lighting = contestant_->lighting();
        const std::size_t count = lighting.bands.size();
        recent_.emplace_back(count);
        if (recent_.size() > kCoverageImages) {
            recent_.pop_front();
        }
        for (std::size_t j = 0; j < count; ++j) {
            const std::uint32_t b = lighting.bands[j];
            record.bands.resize(std::max<std::size_t>(record.bands.size(), b + 1));
            BandRecord& band = record.bands[b];
            const bool reset = ((bands_reset >> b) & 1U) != 0;
            bool updated = false;
            for (std::size_t c = 0; c < kColours; ++c) {
                const std::size_t i = c * count + j;
                const float target = lighting.target[i];
                const float shown = lighting.approximation[i];
                updated = updated || shown != (reset ? 0 : previous_approximation_[i]);
                band.residual_energy += square(double{target} - double{shown});
                band.residual_l1 += std::abs(double{target} - double{shown});
                band.light_l1 += std::abs(double{target});
                band.change_energy += square(double{target} - double{previous_target_[i]});
            }
            band.updated += updated ? 1 : 0;
            covered_[j] = covered_[j] || updated;
            recent_.back()[j] = updated;
        }
        record.covered =
            static_cast<std::uint32_t>(std::count(covered_.begin(), covered_.end(), true));
        std::copy(lighting.target.begin(), lighting.target.end(), previous_target_.begin());
        std::copy(lighting.approximation.begin(), lighting.approximation.end(),
                  previous_approximation_.begin());
    }

    std::string label_;
    std::unique_ptr<Contestant> contestant_;
    LightingError lighting_error_;
    std::vector<float> image_;
    std::vector<float> previous_error_;
    light::LightCubemap shown_;
    std::vector<float> previous_target_;
    std::vector<float> previous_approximation_;
    std::vector<bool> covered_;
    std::deque<std::vector<bool>> recent_;  // updated in the last images, the newest last
};

}  // namespace

Findings run_experiment(const Experiment& experiment) {
    const served::Scene& scene = *experiment.scene.haar;
    require_movable(scene, experiment.sequence);
    const std::size_t values =
        kColours * std::size_t{scene.image().width} * scene.image().height;
    std::vector<float> reference_image(values);
    std::vector<float> lighting;
    light::LightCubemap radiance(scene.face_resolution());
    Reference reference(scene);
    std::vector<Entrant> entrants;
    for (const Method& method : experiment.methods) {
        entrants.emplace_back(method, experiment.scene, values);
    }
    TemporalBands temporal_bands(scene.columns().bands());
    Findings findings;
    for (std::uint32_t i = 0; i < experiment.sequence.images; ++i) {
        light::evaluate(rig_of_image(experiment.sequence, experiment.environments, i),
                        scene.face_resolution(), radiance);
        light::lighting_coefficients(radiance, scene.projection(), lighting);
        temporal_bands.add(lighting);
        const view::Look look = look_of_image(experiment.sequence, scene.beginning(), i);
        reference.write_image(lighting, look, reference_image);
        const Truth truth{.light = {.radiance = radiance, .haar = lighting},
                          .look = look,
                          .image = reference_image,
                          .width = scene.image().width};
        const bool keep = std::find(experiment.pictures.begin(), experiment.pictures.end(),
                                    i) != experiment.pictures.end();
        if (keep) {
            findings.pictures.push_back({.method = "", .image = i, .rgb = reference_image});
        }
        for (Entrant& entrant : entrants) {
            findings.records.push_back(entrant.measure(truth));
            findings.records.back().image = i;
            if (keep) {
                findings.pictures.push_back(
                    {.method = entrant.label(), .image = i, .rgb = entrant.image()});
                if (auto coverage = entrant.coverage(scene.face_resolution())) {
                    coverage->image = i;
                    findings.coverages.push_back(std::move(*coverage));
                }
            }
        }
        findings.images_done = i + 1;
        if (!experiment.go_on(findings.images_done)) {
            break;
        }
    }
    findings.spectrum = temporal_bands.spectrum();
    findings.complete = findings.images_done == experiment.sequence.images;
    return findings;
}

}  // namespace relume::lab
