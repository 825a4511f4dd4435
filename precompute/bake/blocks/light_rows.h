// Rows that answer to the light of a cubemap: of images and of surfaces.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/bake/blocks/row_source.h"
#include "precompute/bake/rows/light_texels.h"
#include "precompute/bake/rows/path_pool.h"
#include "precompute/bake/rows/path_tracer.h"
#include "precompute/bake/rows/row_baker.h"
#include "precompute/bake/rows/traced_receivers.h"

#include <tbb/enumerable_thread_specific.h>

namespace relume::bake {

class LightRows final : public RowSource {
  public:
    // Keeps references to caster and receivers.
    LightRows(const RayCaster& caster,
              const Receivers& receivers,
              const BakeParameters& parameters);

    [[nodiscard]] const Receivers& receivers() const override { return receivers_; }
    [[nodiscard]] const SignalModel& signals() const override { return signals_; }
    std::uint64_t move_to(std::uint32_t first_cluster, std::uint32_t cluster_count) override;
    bool bake(std::size_t receiver,
              std::vector<CoefficientRow>& rows,
              std::uint64_t& rays) const override;
    bool bake_alone(std::size_t receiver, std::vector<CoefficientRow>& rows) const override;

  private:
    const Receivers& receivers_;
    LightTexels texels_;
    PathTracer tracer_;
    TracedReceivers traced_;
    PathPool pool_;
    RowBaker rows_;
    SignalModel signals_;
    mutable tbb::enumerable_thread_specific<RowBaker::Scratch> scratches_;
};

}  // namespace relume::bake
