// What a session could keep of its vertices while light or view rests, in place of integrating
// every vertex from nothing: bytes, seconds until it is kept, and what an image takes then.
#pragma once

#include "tests/lab/triple/seen_surface.h"
#include "tests/lab/triple/tabulated_material.h"
#include "tests/lab/triple/triple_light.h"

#include <cstdint>
#include <string>
#include <vector>

namespace relume::lab {

// Of one thing that is kept of every seen vertex.
struct KeptFigures {
    double bytes_per_vertex = 0;
    double fill_seconds = 0;  // of all seen vertices, with the threads of the arena
    double milliseconds = 0;  // an image of all seen vertices, likewise
    double error = 0;         // relative L2 of such an image, of the exact integrals
};

// A light that turns by 1.5° an image, followed by so many coefficients an image.
struct FollowedLight {
    std::uint32_t coefficients = 0;
    double milliseconds = 0;  // an image, the choice of coefficients in it
    double error = 0;         // relative L2, in the mean over images but the first
};

struct KeptProducts {
    double bits_milliseconds = 0;  // an image from bits, from nothing
    // The view rests: V·ρ̃ by the runs of texels in which it is not zero.
    KeptFigures texels;
    // The same as columns of an operator in Haar wavelets, values below kLeftOut of their row's
    // length left out, 8 bytes a value.
    KeptFigures columns;
    std::vector<FollowedLight> followed;
    // The light rests: L·V, three colours by the runs of texels that are open in part. Of
    // kMostLit vertices at most, scaled to all.
    KeptFigures lit;
};

inline constexpr float kLeftOut = 1e-3F;
inline constexpr std::size_t kMostLit = 2000;

// Parallel. Needs memory for the rows of all seen vertices in single precision by columns, and
// 12·6·n² bytes for each of kMostLit.
[[nodiscard]] KeptProducts measure_kept_products(const SeenSurface& surface,
                                                 const TabulatedMaterial& material,
                                                 const std::string& environment,
                                                 std::uint32_t images);

}  // namespace relume::lab
