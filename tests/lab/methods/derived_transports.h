// What methods make of a scene's transport before they begin, made once for all of them.
#pragma once

#include "server/scene/scene.h"
#include "tests/lab/cpca/clustered_transport.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

namespace relume::lab {

// Of one transport of kind mesh. Not thread-safe.
class DerivedTransports {
  public:
    // Its first `terms` terms (geometry/leading_terms.h); throws as that.
    [[nodiscard]] std::shared_ptr<const served::Scene> leading_terms(const served::Scene& scene,
                                                                     std::uint32_t terms);
    // Throws as clustered_transport.
    [[nodiscard]] std::shared_ptr<const ClusteredTransport> clustered(
        const served::Scene& scene, const ClusterOptions& options);

  private:
    std::map<std::uint32_t, std::shared_ptr<const served::Scene>> leading_terms_;
    std::map<std::pair<std::size_t, std::size_t>, std::shared_ptr<const ClusteredTransport>>
        clustered_;
};

}  // namespace relume::lab
