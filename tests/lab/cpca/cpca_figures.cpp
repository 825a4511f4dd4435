#include "tests/lab/cpca/cpca_figures.h"

#include <algorithm>
#include <utility>

namespace relume::lab {
namespace {

using nlohmann::json;

json json_of(const LightErrors& errors) {
    return {{"natural", errors.natural}, {"sun", errors.sun}};
}

json json_of(const SeamFigures& seams) {
    return {{"added", seams.added},
            {"shown", seams.shown},
            {"border_edges", seams.border_edges},
            {"inner_edges", seams.inner_edges}};
}

json json_of(const CodedFigures& figures) {
    return {{"name", figures.name},
            {"asked", json_of(figures.asked)},
            {"expected_error", json_of(figures.expected)},
            {"measured_error", json_of(figures.measured)},
            {"bytes", figures.bytes.total()},
            {"cell_bytes", figures.bytes.cells},
            {"head_bytes", figures.bytes.heads},
            {"basis_bytes", figures.bytes.bases},
            {"median_components", figures.median_components},
            {"most_components", figures.most_components},
            {"cell_bytes_of_band", figures.bytes_of_band},
            {"nonzeros_of_band", figures.nonzeros_of_band},
            {"seams_natural", json_of(figures.natural_seams)},
            {"seams_sun", json_of(figures.sun_seams)}};
}

}  // namespace

json cpca_figures(const CpcaFindings& findings) {
    const CodedFigures& best = findings.best_cpca();
    return {{"cpca_bytes_over_plain", static_cast<double>(best.bytes.total()) /
                                          static_cast<double>(findings.plain().bytes.total())},
            {"cpca_added_error", std::max(best.expected.natural, best.expected.sun)},
            {"cpca_step2_gain", findings.second_step.gain()},
            {"cpca_step2_added_error", findings.second_step.added_error},
            {"cpca_step2_worst_error", findings.second_step.worst_error},
            {"seam_ratio", std::max(best.natural_seams.added, best.sun_seams.added)},
            {"seam_ratio_shown", std::max(best.natural_seams.shown, best.sun_seams.shown)}};
}

json json_from_cpca(const CpcaFindings& findings) {
    json coded = json::array();
    for (const CodedFigures& figures : findings.coded) {
        coded.push_back(json_of(figures));
    }
    json all{{"vertices", findings.vertices},
             {"surface_vertices", findings.surface_vertices},
             {"clusters", findings.clusters},
             {"blocks", findings.blocks},
             {"channels", findings.channels},
             {"columns", findings.columns},
             {"baked_error", json_of(findings.baked)},
             {"baked_basis", transport::kBlockBasisNames.name(findings.baked_basis)},
             {"median_rank", findings.median_rank},
             {"reassignment_errors", findings.reassignment_errors},
             {"coded", std::move(coded)}};
    all.update(cpca_figures(findings));
    return all;
}

}  // namespace relume::lab
