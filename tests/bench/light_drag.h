// An artist turns the environment: the lighting of every image, and what changes from one to
// the next.
#pragma once

#include "protocol/light/light_rig.h"
#include "server/engine/columns/column_change.h"
#include "server/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace relume::bench {

// A clear afternoon with a bare sun, turned by 1.5 degrees an image as `relume load` does.
class LightDrag {
  public:
    explicit LightDrag(std::uint32_t face_resolution);

    [[nodiscard]] light::LightRig rig(std::size_t image) const;
    // Coefficients in the Haar basis, planar [3][N].
    [[nodiscard]] std::vector<float> lighting(std::size_t image) const;

  private:
    std::shared_ptr<const basis::CubemapProjection> projection_;
    std::shared_ptr<const light::PrefilteredEnvironment> environment_;
};

// Images of a drag, incremental: of each the `terms` columns whose change matters most,
// Σ_c (ΔL(c,j)·‖T(c,j)‖)², ordered by band and index as the engine takes them.
using ChangesOfImage = std::vector<engine::ColumnChange>;
[[nodiscard]] std::vector<ChangesOfImage> drag_changes(const served::Scene& scene,
                                                       std::size_t terms,
                                                       std::size_t images);

// The columns that occur, ascending.
[[nodiscard]] std::vector<std::uint32_t> columns_of(std::span<const ChangesOfImage> images);

// Bytes of all columns of one image.
[[nodiscard]] std::uint64_t bytes_of(const served::Scene& scene, const ChangesOfImage& image);

}  // namespace relume::bench
