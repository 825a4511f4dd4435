// What a bake is asked for, beside the scene.
#pragma once

#include "precompute/factors/factorise.h"
#include "precompute/scene/up_axis.h"
#include "protocol/basis/cubemap_basis.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>

namespace relume::bake {

// What the bake is of: the pixels of one image, or the vertices of the scene's surface.
enum class ReceiverKind : std::uint8_t { pixels, vertices };

struct BakeParameters {
    ReceiverKind receivers = ReceiverKind::pixels;
    std::uint32_t width = 512;           // pixels; of vertices, where a view begins
    std::uint32_t height = 512;          // pixels
    std::uint32_t face_resolution = 64;  // n of the 6×n×n lighting cubemap
    basis::CubemapBasis::Kind basis = basis::CubemapBasis::Kind::haar;
    std::uint32_t order = 10;          // of spherical harmonics; Haar has none
    std::uint32_t bounces = 1;         // scattering events after the first; 0: direct only
    std::uint32_t samples = 64;        // paths per pixel
    std::uint32_t bits = 8;            // 6, 7 or 8
    std::uint32_t pixel_samples = 16;  // camera sub-positions per pixel
    std::uint32_t edge_samples = 8;    // more visibility rays per texel at shadow edges
    std::uint32_t pool_radius = 4;     // pixels whose paths are shared; 0: none
    float shrinkage = 1.1F;            // standard errors a group of coefficients must pass
    // Of vertices:
    std::uint32_t vertices = 250'000;  // at most
    double target_error = 0.02;       // relative L2 that is asked of interpolation and of terms
    std::uint32_t terms = 0;          // of every material; 0: as few as meet target_error
    factors::Method factor_method = factors::Method::svd;
    std::uint32_t threads = 0;  // 0: one per core; changes no result
    std::uint64_t seed = 0;
    scene::UpAxis up_axis = scene::UpAxis::y;  // of the scene's file
};

// Throws program::UsageError naming the first parameter out of range.
void check_parameters(const BakeParameters& parameters);

// What the transport's columns stand for. The parameters have been checked.
[[nodiscard]] basis::CubemapBasis signal_basis(const BakeParameters& parameters);

// All that changes the result: everything but `threads`.
[[nodiscard]] nlohmann::json json_from_parameters(const BakeParameters& parameters);

}  // namespace relume::bake
