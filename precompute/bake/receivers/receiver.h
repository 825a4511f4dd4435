// What a receiver is to those who bake its row: the surfaces it stands for, and numbers of its
// own.
#pragma once

#include "precompute/bake/rays/ray_caster.h"
#include "precompute/scene/surface_point.h"
#include "protocol/brdf/factored_brdf.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::bake {

// A surface that a receiver stands for, at the place that stands for it.
struct ReceiverSurface {
    scene::SurfacePoint
        point;            // with the colours that the surface has in the receiver on average
    float share = 0;      // of the receiver, in (0, 1]
    float footprint = 0;  // of the receiver at the point, in world units
    std::uint32_t material = 0;
    std::uint32_t number = 0;  // among the receiver's: it chooses the surface's random numbers
    // Where rays leave the surface, spread over what the receiver holds of it: just off it, as
    // offset_origin says. Any aligned run of 2^k of them is spread evenly.
    std::array<Imath::V3f, kPacketSize> origins{};
    // Points whose reflections are averaged, where the surface turns so far within the receiver
    // that its highlight does, in the colours of `point`; none where `point` stands for all.
    std::vector<scene::SurfacePoint> turns;
    // Where it is not null, the receiver is a vertex: it has this surface alone, and a row for
    // each term of the BRDF, which is the response to light weighted by g_k and the cosine, for
    // viewers in any direction. `point` then has a white Lambert BSDF, the normal of the vertex
    // as both its normals, and brdf::local_frame of it. Outlives the receiver.
    const brdf::FactoredBrdf* brdf = nullptr;
    // Of such a surface: what its rows are multiplied with, beside the colours of the lobes.
    Imath::V3f colour{1, 1, 1};
};

// Where a receiver's random numbers lie in the sequences that all receivers share. Receivers
// that are close to each other get numbers that are spread evenly over all of them.
struct SequencePlace {
    // Of its paths: `samples` numbers from run · samples on. Close receivers have close runs.
    std::uint32_t run = 0;
    // Of its rays in the texels of the light: ≥ 0, and the fractional parts count.
    double along = 0;
    double across = 0;
};

struct Receiver {
    std::size_t index = 0;
    SequencePlace place;
    std::vector<ReceiverSurface> surfaces;  // none where it sees nothing; shares sum up to ≤ 1

    // How many rows it has.
    [[nodiscard]] std::size_t terms() const {
        return surfaces.size() == 1 && surfaces[0].brdf != nullptr ? surfaces[0].brdf->terms
                                                                   : 1;
    }
};

}  // namespace relume::bake
