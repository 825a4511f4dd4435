#include "tests/lab/cpca/cpca_experiment.h"

#include "precompute/bake/blocks/model_signals.h"
#include "precompute/bake/blocks/step_chooser.h"
#include "protocol/basis/cubemap_projection.h"
#include "tests/lab/cpca/reassignment.h"
#include "tests/lab/cpca/row_sketch.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace relume::lab {
namespace {

// The bake's model lights, natural ones first, then a colourless one for each image of the
// sequence, [N][lights].
RowVectors all_lights(const basis::CubemapBasis& basis, const CpcaOptions& options) {
    const auto projection = basis::CubemapProjection::onto(basis);
    std::vector<std::vector<float>> lights;
    for (std::uint64_t i = 0; i < bake::kSignalsPerKind; ++i) {
        lights.push_back(bake::natural_light(basis, i));
    }
    for (std::uint64_t i = 0; i < bake::kSignalsPerKind; ++i) {
        lights.push_back(bake::sun_light(*projection, i));
    }
    light::LightCubemap radiance(basis.face_resolution());
    for (std::uint32_t image = 0; image < options.sequence.images; ++image) {
        light::evaluate(rig_of_image(options.sequence, options.environments, image),
                        basis.face_resolution(), radiance);
        const auto planes = std::as_const(radiance).planes();
        std::vector<float> grey(radiance.plane_size());
        for (std::size_t i = 0; i < grey.size(); ++i) {
            grey[i] = (planes[0][i] + planes[1][i] + planes[2][i]) / 3;
        }
        projection->project_radiance(grey, lights.emplace_back(basis.coefficient_count()));
    }
    RowVectors matrix(static_cast<Eigen::Index>(basis.coefficient_count()),
                      static_cast<Eigen::Index>(lights.size()));
    for (std::size_t light = 0; light < lights.size(); ++light) {
        matrix.col(static_cast<Eigen::Index>(light)) = Eigen::Map<const Eigen::VectorXf>(
            lights[light].data(), static_cast<Eigen::Index>(lights[light].size()));
    }
    return matrix;
}

// By vertex, [planes][lights].
std::vector<float> exact_answers(const VertexRows& rows, const RowVectors& lights) {
    const auto count = static_cast<std::size_t>(lights.cols());
    std::vector<float> answers(rows.first.back() * count);
    tbb::parallel_for(std::size_t{0}, rows.vertex_count(), [&](std::size_t v) {
        const auto planes = static_cast<Eigen::Index>(rows.planes[v]);
        Eigen::Map<RowVectors>(&answers[rows.first[v] * count], planes, lights.cols()) =
            Eigen::Map<const RowVectors>(rows.row(v).data(), planes, lights.rows()) * lights;
    });
    return answers;
}

double relative_error(std::span<const float> exact,
                      std::span<const float> coded,
                      std::size_t lights,
                      std::size_t first,
                      std::size_t last) {
    double error = 0;
    double energy = 0;
    for (std::size_t row = 0; row < exact.size(); row += lights) {
        for (std::size_t i = row + first; i < row + last; ++i) {
            const double off = double{coded[i]} - double{exact[i]};
            error += off * off;
            energy += double{exact[i]} * exact[i];
        }
    }
    return energy > 0 ? std::sqrt(error / energy) : 0;
}

std::size_t median(std::vector<std::size_t> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[values.size() / 2];
}

// Components that leave a relative error of 1 % of the weighted rows.
std::size_t rank_of(const Eigen::VectorXd& energies) {
    constexpr double kLeft = 1e-4;
    double left = energies.sum();
    const double bound = kLeft * left;
    std::size_t rank = 0;
    while (rank < static_cast<std::size_t>(energies.size()) && left > bound) {
        left -= energies[static_cast<Eigen::Index>(rank++)];
    }
    return rank;
}

const CodedFigures& plain_of(const CodedFigures& haar_line, const CodedFigures& identity) {
    constexpr double kMost = 1 - bake::StepChooser::kWorthwhile;
    return static_cast<double>(identity.bytes.total()) <
                   kMost * static_cast<double>(haar_line.bytes.total())
               ? identity
               : haar_line;
}

class Experiment {
  public:
    Experiment(const scene::Scene& scene, const CpcaOptions& options)
        : options_(options),
          rows_(bake_vertex_rows(scene, options.bake, options.most_runs)),
          weights_(rows_.basis),
          lights_(all_lights(rows_.basis, options)),
          exact_(exact_answers(rows_, lights_)),
          cluster_of_(rows_.cluster_of) {
        findings_.vertices = rows_.vertex_count();
        findings_.surface_vertices = rows_.surface_vertices;
        findings_.clusters = rows_.clusters;
        for (const auto& members : members_of(cluster_of_, rows_.clusters)) {
            findings_.blocks += rows_.planes[members.front()] / rows_.channels;
        }
        findings_.channels = rows_.channels;
        findings_.columns = rows_.columns();
        findings_.baked_basis = rows_.baked_basis;
    }

    CpcaFindings run() {
        const LightErrors asked{.natural = options_.error, .sun = options_.error};
        findings_.baked = baked_error();
        targets_ = {asked, findings_.baked};
        code("haar_line", ClusterBasis::haar_line, [](const CodedRows&) {});
        code("identity", ClusterBasis::identity, [](const CodedRows&) {});
        code("pca", ClusterBasis::learned, [&](const CodedRows& coded) {
            std::vector<std::size_t> ranks;
            for (const CodedCluster& cluster : coded.clusters()) {
                ranks.push_back(rank_of(cluster.energies()));
            }
            findings_.median_rank = median(ranks);
        });
        reassign_clusters(
            findings_.coded[findings_.coded.size() - targets_.size()].median_components);
        code("pca, reassigned", ClusterBasis::learned, [](const CodedRows&) {});
        // By error, then by way of storing.
        std::stable_sort(findings_.coded.begin(), findings_.coded.end(),
                         [&](const CodedFigures& a, const CodedFigures& b) {
                             return is_asked(a) && !is_asked(b);
                         });
        return std::move(findings_);
    }

  private:
    [[nodiscard]] LightErrors baked_error() const {
        const bool is_line = rows_.baked_basis == transport::BlockBasis::haar_line;
        const CodedRows coded(
            rows_, members_of(cluster_of_, findings_.clusters), weights_,
            {.basis = is_line ? ClusterBasis::haar_line : ClusterBasis::identity});
        return coded.error(rows_.baked_steps);
    }
    [[nodiscard]] bool is_asked(const CodedFigures& figures) const {
        return figures.asked.natural == targets_[0].natural &&
               figures.asked.sun == targets_[0].sun;
    }

    void reassign_clusters(std::size_t components) {
        const RowVectors sketches =
            sketch_rows(rows_, options_.falloff, options_.sketch_numbers, options_.bake.seed);
        Reassignment found = reassign(sketches, rows_.edges, cluster_of_, findings_.clusters,
                                      {.axes = std::max<std::size_t>(components, 1)});
        cluster_of_ = std::move(found.cluster_of);
        findings_.reassignment_errors = std::move(found.errors);
    }

    template <typename Look>
    void code(const std::string& name, ClusterBasis basis, Look look) {
        const CodedRows coded(rows_, members_of(cluster_of_, findings_.clusters), weights_,
                              {.basis = basis,
                               .falloff = options_.falloff,
                               .most_components = options_.most_components});
        look(coded);
        for (std::size_t target = 0; target < targets_.size(); ++target) {
            const StepRule rule = coded.rule_for(targets_[target]);
            const StoredRows stored = coded.store(steps_of_rule(rows_.basis, rule), lights_);
            findings_.coded.push_back(figures_of(name, targets_[target], stored));
            if (basis == ClusterBasis::learned && target == 0) {
                findings_.second_step = second_step(coded, stored);
            }
        }
    }

    [[nodiscard]] CodedFigures figures_of(const std::string& name,
                                          const LightErrors& asked,
                                          const StoredRows& stored) const {
        constexpr std::size_t kNaturalEnd = bake::kSignalsPerKind;
        constexpr std::size_t kSunEnd = bake::kModelSignals;
        const auto lights = static_cast<std::size_t>(lights_.cols());
        const auto seams = [&](std::size_t first, std::size_t last) {
            return measure_seams(rows_, cluster_of_, exact_, stored.answers, lights, first,
                                 last);
        };
        return {.name = name,
                .asked = asked,
                .bytes = stored.bytes,
                .expected = stored.expected,
                .measured = {.natural =
                                 relative_error(exact_, stored.answers, lights, 0, kNaturalEnd),
                             .sun = relative_error(exact_, stored.answers, lights, kNaturalEnd,
                                                   kSunEnd)},
                .median_components = median(stored.components),
                .most_components =
                    *std::max_element(stored.components.begin(), stored.components.end()),
                .natural_seams = seams(0, kNaturalEnd),
                .sun_seams = seams(kNaturalEnd, kSunEnd),
                .bytes_of_band = stored.bytes_of_band,
                .nonzeros_of_band = stored.nonzeros_of_band};
    }

    [[nodiscard]] SecondStepFigures second_step(const CodedRows& coded,
                                                const StoredRows& stored) const {
        std::vector<DraggedCluster> dragged;
        for (std::size_t c = 0; c < coded.clusters().size(); ++c) {
            const CodedCluster& cluster = coded.clusters()[c];
            dragged.push_back({.weights = &cluster.weights(),
                               .components = stored.components[c],
                               .planes = cluster.planes(),
                               .answers = stored.component_answers[c]});
        }
        return measure_second_step(dragged, static_cast<std::size_t>(lights_.cols()),
                                   bake::kModelSignals, options_.sequence.rests_from(),
                                   options_.share);
    }

    const CpcaOptions& options_;
    VertexRows rows_;
    LightWeights weights_;
    RowVectors lights_;
    std::vector<float> exact_;
    std::vector<std::uint32_t> cluster_of_;
    std::vector<LightErrors> targets_;
    CpcaFindings findings_;
};

}  // namespace

const CodedFigures& CpcaFindings::plain() const {
    return plain_of(coded[0], coded[1]);
}

const CodedFigures& CpcaFindings::plain_as_baked() const {
    return plain_of(coded[coded.size() / 2], coded[coded.size() / 2 + 1]);
}

const CodedFigures& CpcaFindings::best_cpca() const {
    return coded[3].bytes.total() < coded[2].bytes.total() ? coded[3] : coded[2];
}

CpcaFindings run_cpca_experiment(const scene::Scene& scene, const CpcaOptions& options) {
    return Experiment(scene, options).run();
}

}  // namespace relume::lab
