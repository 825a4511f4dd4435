// The failures, a file each. Internal to tests/stability; failures.cpp lists them.
#pragma once

#include "tests/stability/failure.h"

namespace relume::stability {

[[nodiscard]] Failure ghosts();
[[nodiscard]] Failure reset_flicker();
[[nodiscard]] Failure popping();
[[nodiscard]] Failure rounding_drift();
[[nodiscard]] Failure repeated_rotation();
[[nodiscard]] Failure face_crossing();
[[nodiscard]] Failure small_lights();
[[nodiscard]] Failure highlight_columns();
[[nodiscard]] Failure bad_texels();
[[nodiscard]] Failure edit_histories();
[[nodiscard]] Failure extreme_lighting();
[[nodiscard]] Failure slow_rest();
[[nodiscard]] Failure sh_ringing();
// Of surfaces under cameras that move: in mesh/.
[[nodiscard]] Failure negative_factors();
[[nodiscard]] Failure grazing_angles();
[[nodiscard]] Failure faded_highlights();
[[nodiscard]] Failure t_junctions();
[[nodiscard]] Failure shadow_leaks();
[[nodiscard]] Failure vertex_in_wall();
[[nodiscard]] Failure creases();
[[nodiscard]] Failure odd_cameras();
[[nodiscard]] Failure moving_view();
// Of curves that are edited: in curves/.
[[nodiscard]] Failure curve_ends();
[[nodiscard]] Failure curve_jumps();
[[nodiscard]] Failure rim_of_pearls();
[[nodiscard]] Failure narrow_highlights();
// Of light times visibility times material: in triple/.
[[nodiscard]] Failure hidden_lamp();
[[nodiscard]] Failure reflection_seams();
[[nodiscard]] Failure viewer_below_horizon();
[[nodiscard]] Failure cubemap_resolutions();

}  // namespace relume::stability
