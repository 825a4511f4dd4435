// The image of a surface from the components of its clusters: the second step of clustered PCA.
#pragma once

#include "tests/lab/cpca/clustered_transport.h"
#include "tests/lab/cpca/second_step.h"
#include "tests/lab/methods/image_maker.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace relume::lab {

// In each image a part of every cluster's components is brought to its vertices, those that
// have changed most [Overbeck06T §7.3].
class ComponentImageMaker final : public ImageMaker {
  public:
    // `share` is 4 for a quarter of the components, at least one. `surface` makes images of the
    // scene's own sums.
    ComponentImageMaker(std::shared_ptr<const served::Scene> scene,
                        std::shared_ptr<const ClusteredTransport> clustered,
                        std::size_t share,
                        std::unique_ptr<ImageMaker> surface);

    bool look(const view::Look& look) override;
    // A cluster counts for as much as its vertices do on average.
    [[nodiscard]] std::vector<float> block_weights() const override { return weights_; }
    // Sums are of components. Clusters that count for nothing are left as they are. Of the
    // others the weights of the components that are brought on are read, as they would be
    // stored (stored_weight_bytes).
    std::uint64_t take(std::span<const float> sums) override;
    void write(std::span<float> rgb) override;

  private:
    void weigh_blocks();
    std::uint64_t take_cluster(std::size_t c, std::span<const float> sums);

    std::shared_ptr<const served::Scene> scene_;
    std::shared_ptr<const ClusteredTransport> clustered_;
    std::size_t share_;
    std::unique_ptr<ImageMaker> surface_;
    std::vector<float> weights_;               // of the blocks of components
    std::vector<SecondStep> steps_;            // of each cluster
    std::vector<std::vector<float>> answers_;  // of each cluster, [S][terms][3]
    std::vector<float> sums_;                  // of the surface, in the basis of its blocks
};

}  // namespace relume::lab
