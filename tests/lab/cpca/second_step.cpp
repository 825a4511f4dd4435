#include "tests/lab/cpca/second_step.h"

#include "protocol/basis/cpu_clones.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

namespace relume::lab {
namespace {

RELUME_CPU_CLONES void add_scaled(const float* __restrict weights,
                                  float factor,
                                  std::size_t count,
                                  float* __restrict sums) {
    for (std::size_t i = 0; i < count; ++i) {
        sums[i] += factor * weights[i];
    }
}

double thread_seconds() {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Each cluster's answers by image, [images][S][planes].
std::vector<std::vector<float>> answers_by_image(std::span<const DraggedCluster> clusters,
                                                 std::size_t lights,
                                                 std::size_t first_light,
                                                 std::size_t images) {
    std::vector<std::vector<float>> all;
    for (const DraggedCluster& cluster : clusters) {
        std::vector<float>& own = all.emplace_back();
        const std::size_t values = cluster.components * cluster.planes;
        for (std::size_t image = 0; image < images; ++image) {
            for (std::size_t i = 0; i < values; ++i) {
                own.push_back(cluster.answers[i * lights + first_light + image]);
            }
        }
    }
    return all;
}

struct Drag {
    double full_seconds = 0;
    double incremental_seconds = 0;
    double error = 0;
    double worst = 0;
};

Drag drag(std::span<const DraggedCluster> clusters,
          const std::vector<std::vector<float>>& answers,
          std::size_t images,
          std::size_t share) {
    std::vector<SecondStep> full;
    std::vector<SecondStep> incremental;
    for (const DraggedCluster& cluster : clusters) {
        full.emplace_back(
            cluster.weights->leftCols(static_cast<Eigen::Index>(cluster.components)),
            cluster.planes);
        incremental.push_back(full.back());
    }
    Drag result;
    for (std::size_t image = 0; image < images; ++image) {
        const auto answers_of = [&](std::size_t c) {
            const std::size_t values = clusters[c].components * clusters[c].planes;
            return std::span(answers[c]).subspan(image * values, values);
        };
        const double start = thread_seconds();
        for (std::size_t c = 0; c < clusters.size(); ++c) {
            full[c].compute_all(answers_of(c));
        }
        const double middle = thread_seconds();
        for (std::size_t c = 0; c < clusters.size() && image > 0; ++c) {
            const std::size_t count = incremental[c].components() / share;
            incremental[c].add_largest(answers_of(c), std::max<std::size_t>(count, 1));
        }
        const double end = thread_seconds();
        if (image == 0) {
            incremental = full;
            continue;
        }
        result.full_seconds += middle - start;
        result.incremental_seconds += end - middle;
        double error = 0;
        double energy = 0;
        for (std::size_t c = 0; c < clusters.size(); ++c) {
            const std::span<const float> exact = full[c].vertices();
            const std::span<const float> shown = incremental[c].vertices();
            for (std::size_t i = 0; i < exact.size(); ++i) {
                const double off = double{shown[i]} - double{exact[i]};
                error += off * off;
                energy += double{exact[i]} * exact[i];
            }
        }
        const double relative = energy > 0 ? std::sqrt(error / energy) : 0;
        result.error += relative / static_cast<double>(images - 1);
        result.worst = std::max(result.worst, relative);
    }
    return result;
}

}  // namespace

SecondStep::SecondStep(const Eigen::MatrixXf& weights, std::size_t planes)
    : count_(static_cast<std::size_t>(weights.rows())),
      components_(static_cast<std::size_t>(weights.cols())),
      planes_(planes),
      weights_(weights.data(), weights.data() + weights.size()),
      shown_(components_ * planes),
      vertices_(count_ * planes),
      changes_(components_),
      change_(planes) {}

void SecondStep::add(std::size_t component, std::span<const float> change) {
    for (std::size_t plane = 0; plane < planes_; ++plane) {
        add_scaled(&weights_[component * count_], change[plane], count_,
                   &vertices_[plane * count_]);
    }
}

void SecondStep::compute_all(std::span<const float> answers) {
    std::fill(vertices_.begin(), vertices_.end(), 0.0F);
    for (std::size_t i = 0; i < components_; ++i) {
        add(i, answers.subspan(i * planes_, planes_));
    }
    std::copy(answers.begin(), answers.end(), shown_.begin());
}

void SecondStep::add_largest(std::span<const float> answers, std::size_t count) {
    for (std::size_t i = 0; i < components_; ++i) {
        float energy = 0;
        for (std::size_t k = i * planes_; k < (i + 1) * planes_; ++k) {
            const float change = answers[k] - shown_[k];
            energy += change * change;
        }
        changes_[i] = {.energy = energy, .component = static_cast<std::uint32_t>(i)};
    }
    count = std::min(count, components_);
    std::nth_element(changes_.begin(), changes_.begin() + static_cast<std::ptrdiff_t>(count),
                     changes_.end(), [](const Change& a, const Change& b) {
                         return a.energy != b.energy ? a.energy > b.energy
                                                     : a.component < b.component;
                     });
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t first = changes_[n].component * planes_;
        for (std::size_t k = 0; k < planes_; ++k) {
            change_[k] = answers[first + k] - shown_[first + k];
            shown_[first + k] = answers[first + k];
        }
        add(changes_[n].component, change_);
    }
}

SecondStepFigures measure_second_step(std::span<const DraggedCluster> clusters,
                                      std::size_t lights,
                                      std::size_t first_light,
                                      std::size_t images,
                                      std::size_t share) {
    constexpr int kRuns = 3;
    const auto answers = answers_by_image(clusters, lights, first_light, images);
    SecondStepFigures figures{.full_seconds = std::numeric_limits<double>::infinity(),
                              .incremental_seconds = std::numeric_limits<double>::infinity()};
    for (int run = 0; run < kRuns; ++run) {
        const Drag one = drag(clusters, answers, images, share);
        figures.full_seconds = std::min(figures.full_seconds, one.full_seconds);
        figures.incremental_seconds =
            std::min(figures.incremental_seconds, one.incremental_seconds);
        figures.added_error = one.error;
        figures.worst_error = one.worst;
    }
    return figures;
}

}  // namespace relume::lab
