#include "precompute/bake/shown_materials.h"

#include "precompute/bake/image_file.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace relume::bake {

ShownMaterials shown_materials(const PixelReceivers& pixels,
                               const std::vector<std::uint32_t>& materials,
                               std::size_t scene_material_count) {
    ShownMaterials shown{.width = pixels.image().width,
                         .height = pixels.image().height,
                         .most = std::vector<std::uint8_t>(pixels.receiver_count()),
                         .in_view = {}};
    std::vector<std::atomic<bool>> is_seen(materials.size());
    tbb::parallel_for(std::size_t{0}, pixels.receiver_count(), [&](std::size_t pixel) {
        std::vector<float> share(scene_material_count);
        float open = 1;
        for (const ReceiverSurface& surface : pixels.look(pixel).surfaces) {
            share[surface.material] += surface.share;
            open -= surface.share;
        }
        const float most = std::max(open, *std::max_element(share.begin(), share.end()));
        for (std::size_t m = 0; m < materials.size(); ++m) {
            const float of_material = share[materials[m]];
            if (of_material > 0) {
                is_seen[m] = true;
            }
            if (of_material > 0 && of_material == most) {
                shown.most[pixel] = static_cast<std::uint8_t>(m + 1);
            }
        }
    });
    shown.in_view.assign(is_seen.begin(), is_seen.end());
    return shown;
}

void write_shown_materials(const std::filesystem::path& directory,
                           const ShownMaterials& shown) {
    FloatImage image{shown.width, shown.height, 1, {}};
    for (const std::uint8_t most : shown.most) {
        image.values.push_back(static_cast<float>(most) / 255);
    }
    write_png(directory / "view" / "materials.png", image);
}

}  // namespace relume::bake
