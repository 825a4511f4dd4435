#include "tests/stability/failures.h"

#include "tests/stability/provocations.h"

#include <array>

namespace relume::stability {

std::span<const Failure> failures() {
    static const std::array all{ghosts(),
                                reset_flicker(),
                                popping(),
                                rounding_drift(),
                                repeated_rotation(),
                                face_crossing(),
                                small_lights(),
                                highlight_columns(),
                                bad_texels(),
                                edit_histories(),
                                extreme_lighting(),
                                slow_rest(),
                                sh_ringing(),
                                negative_factors(),
                                grazing_angles(),
                                faded_highlights(),
                                t_junctions(),
                                shadow_leaks(),
                                vertex_in_wall(),
                                creases(),
                                odd_cameras(),
                                moving_view(),
                                curve_ends(),
                                curve_jumps(),
                                rim_of_pearls(),
                                narrow_highlights(),
                                hidden_lamp(),
                                reflection_seams(),
                                viewer_below_horizon(),
                                cubemap_resolutions()};
    return all;
}

}  // namespace relume::stability
