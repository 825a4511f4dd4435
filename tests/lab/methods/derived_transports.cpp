#include "tests/lab/methods/derived_transports.h"

#include "tests/lab/geometry/leading_terms.h"

namespace relume::lab {

std::shared_ptr<const served::Scene> DerivedTransports::leading_terms(
    const served::Scene& scene, std::uint32_t terms) {
    std::shared_ptr<const served::Scene>& derived = leading_terms_[terms];
    if (!derived) {
        derived =
            std::make_shared<const served::Scene>(lab::leading_terms(scene.transport(), terms));
    }
    return derived;
}

std::shared_ptr<const ClusteredTransport> DerivedTransports::clustered(
    const served::Scene& scene, const ClusterOptions& options) {
    std::shared_ptr<const ClusteredTransport>& derived =
        clustered_[{options.clusters, options.bases}];
    if (!derived) {
        derived = std::make_shared<const ClusteredTransport>(
            clustered_transport(scene.transport(), options));
    }
    return derived;
}

}  // namespace relume::lab
