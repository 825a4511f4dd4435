// A surface whose light and camera move, as the server's triple products follow them.
#pragma once

#include "tests/lab/triple/seen_surface.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace relume::lab {

struct MovingFigures {
    std::string material;
    std::size_t seen_vertices = 0;
    double field_seconds = 0;  // to bake the material's field
    double load_seconds = 0;   // to bring it back to texels
    double field_bytes = 0;    // as a file has it in memory
    double texel_bytes = 0;    // back in texels
    double surface_bytes = 0;  // of all vertices
    // Exact images a second, with the light's filter where the light moves.
    double images_per_s_light_only = 0;
    double images_per_s_view_only = 0;
    double images_per_s_light_and_view = 0;
    // With 8 ms an image: of the last image of a drag, and of later ones until exact.
    double error_while_moving = 0;
    double stated_error_while_moving = 0;
    std::uint32_t images_to_exact = 0;
};

// All vertices of one material, `words` as materials::model_from_words has them, whose field
// keeps 0.9999 of the energy of every entry. Light and camera turn by 1.5° an image. With the
// threads of the calling arena.
[[nodiscard]] MovingFigures move_scene(const SeenSurface& surface,
                                       const std::string& words,
                                       const std::string& environment,
                                       std::uint32_t images);

}  // namespace relume::lab
