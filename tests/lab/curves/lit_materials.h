// Materials that are edited beside a light that changes: how soon a curve can be dragged, how
// far the image is off until then, and how fast it follows.
#pragma once

#include "protocol/light/light_cubemap.h"
#include "server/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace relume::lab {

struct LitMaterial {
    std::string id;
    std::size_t points = 0;
    // From a new light to the first look, to columns by which the curve can be dragged, and to
    // whole ones; the whole of the machine works on them.
    double first_look_s = 0;
    double columns_s = 0;
    double whole_s = 0;
    // Of the change that the edit makes, relative L2 against that of whole columns.
    double first_look_error = 0;
    double columns_error = 0;
    double images_per_s = 0;  // of a drag, each with its JPEG
    std::size_t bytes = 0;    // of the columns
};

// Of each material's first curve, which is half as high and then dragged over `images` images.
[[nodiscard]] std::vector<LitMaterial> take_up_curves(
    const std::shared_ptr<const served::Scene>& scene,
    const light::LightCubemap& light,
    std::uint32_t images);

}  // namespace relume::lab
