#include "precompute/bake/blocks/light_rows.h"

#include "precompute/bake/blocks/light_model.h"

namespace relume::bake {

LightRows::LightRows(const RayCaster& caster,
                     const Receivers& receivers,
                     const BakeParameters& parameters)
    : receivers_(receivers),
      texels_(parameters.face_resolution, parameters.seed),
      tracer_(caster, parameters),
      traced_(receivers, tracer_, parameters),
      pool_(traced_),
      rows_(caster, texels_, parameters),
      signals_(light_signals(rows_.projection())) {}

std::uint64_t LightRows::move_to(std::uint32_t first_cluster, std::uint32_t cluster_count) {
    return traced_.move_to(first_cluster, cluster_count);
}

bool LightRows::bake(std::size_t receiver,
                     std::vector<CoefficientRow>& rows,
                     std::uint64_t& rays) const {
    const TracedReceiver& traced = traced_.at(receiver);
    if (traced.receiver.surfaces.empty()) {
        return false;
    }
    RowBaker::Scratch& scratch = scratches_.local();
    const std::uint64_t before = scratch.direct.visibility.rays;
    rows_.bake(traced, &pool_, rows, scratch);
    rays += scratch.direct.visibility.rays - before;
    return true;
}

bool LightRows::bake_alone(std::size_t receiver, std::vector<CoefficientRow>& rows) const {
    const TracedReceiver traced = tracer_.trace(receivers_.look(receiver));
    if (traced.receiver.surfaces.empty()) {
        return false;
    }
    rows_.bake(traced, nullptr, rows, scratches_.local());
    return true;
}

}  // namespace relume::bake
