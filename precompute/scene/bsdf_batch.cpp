// Bsdf for many directions: plain loops over planes, compiled so that they vectorise (see
// CMakeLists.txt). Chunks keep the temporaries in L1.
#include "precompute/scene/bsdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace relume::scene {
namespace {

constexpr std::size_t kChunk = 64;

using Chunk = std::array<float, kChunk>;

// What a chunk of directions reflects, in three shares that colours are multiplied onto.
struct Shares {
    Chunk diffuse;
    Chunk specular;
    Chunk grazing;
};

struct ChunkOfDirections {
    const float* x;
    const float* y;
    const float* z;
    std::size_t count;

    ChunkOfDirections(const Directions& of, std::size_t start)
        : x(of.x.data() + start),
          y(of.y.data() + start),
          z(of.z.data() + start),
          count(std::min(kChunk, of.x.size() - start)) {}
};

void lambert_shares(const ChunkOfDirections& wi, Shares& shares) {
    for (std::size_t i = 0; i < wi.count; ++i)
        shares.diffuse[i] = lobes::kInversePi * std::max(wi.z[i], 0.0F);
}

void phong_shares(float exponent,
                  const Imath::V3f& wo,
                  const ChunkOfDirections& wi,
                  Shares& shares) {
    lambert_shares(wi, shares);
    Chunk lobe;
    for (std::size_t i = 0; i < wi.count; ++i) {
        const float cosine = wo.z * wi.z[i] - wo.x * wi.x[i] - wo.y * wi.y[i];
        lobe[i] = std::min(std::max(cosine, 0.0F), 1.0F);
    }
    lobes::power(lobe.data(), wi.count,
                 static_cast<std::uint32_t>(exponent * lobes::kExponentSteps));
    const float norm = (exponent + 2.0F) * 0.5F * lobes::kInversePi;
    for (std::size_t i = 0; i < wi.count; ++i)
        shares.specular[i] = norm * lobe[i] * std::max(wi.z[i], 0.0F);
}

void ggx_shares(float alpha,
                const lobes::Coat& coat,
                const Imath::V3f& wo,
                const ChunkOfDirections& wi,
                Shares& shares) {
    const float alpha2 = alpha * alpha;
    const float root_o = lobes::smith_root(alpha2, wo.z);
    const float layer = coat.diffuse_share() * coat.transmission(wo.z);
    for (std::size_t i = 0; i < wi.count; ++i) {
        const float cos_i = std::max(wi.z[i], 0.0F);
        const float x = wi.x[i] + wo.x;
        const float y = wi.y[i] + wo.y;
        const float z = cos_i + wo.z;
        const float length2 = std::max(x * x + y * y + z * z, 1e-12F);
        const float inverse2 = 1.0F / length2;
        const float cos_h = 0.5F * std::sqrt(length2);  // wo·h
        const float d = lobes::ggx_distribution(alpha2, (x * x + y * y) * inverse2,
                                                z * std::sqrt(inverse2));
        const float root_i = lobes::smith_root(alpha2, cos_i);
        const float v = lobes::smith_visibility(cos_i, root_i, wo.z, root_o);
        const float lobe = d * v * cos_i;
        const float fresnel = lobes::schlick_weight(std::min(cos_h, 1.0F));
        shares.diffuse[i] = layer * coat.transmission(cos_i) * cos_i;
        shares.specular[i] = lobe * (1.0F - fresnel);
        shares.grazing[i] = lobe * fresnel;
    }
}

// A share that the model does not have is left as it is. `wo` is above the horizon.
void find_shares(const Bsdf& bsdf,
                 const Imath::V3f& wo,
                 const ChunkOfDirections& wi,
                 Shares& shares) {
    switch (bsdf.model()) {
        case BsdfModel::lambert:
            lambert_shares(wi, shares);
            break;
        case BsdfModel::phong:
            phong_shares(bsdf.exponent(), wo, wi, shares);
            break;
        case BsdfModel::ggx:
            ggx_shares(bsdf.alpha(), bsdf.coat(), wo, wi, shares);
            break;
    }
}

}  // namespace

void Bsdf::evaluate_times_cosine(const Imath::V3f& wo,
                                 const Directions& wi,
                                 const RgbPlanes& out) const {
    const std::size_t count = wi.x.size();
    const std::array<float*, 3> planes{out.r.data(), out.g.data(), out.b.data()};
    if (wo.z <= 0) {
        for (float* plane : planes)
            std::fill_n(plane, count, 0.0F);
        return;
    }
    Shares shares;
    for (std::size_t start = 0; start < count; start += kChunk) {
        const ChunkOfDirections chunk(wi, start);
        find_shares(*this, wo, chunk, shares);
        for (int c = 0; c < 3; ++c) {
            float* plane = planes[static_cast<std::size_t>(c)] + start;
            const float diffuse = diffuse_[c];
            const float specular = specular_[c];
            if (model_ == BsdfModel::lambert) {
                for (std::size_t i = 0; i < chunk.count; ++i)
                    plane[i] = diffuse * shares.diffuse[i];
            } else if (model_ == BsdfModel::phong) {
                for (std::size_t i = 0; i < chunk.count; ++i)
                    plane[i] = diffuse * shares.diffuse[i] + specular * shares.specular[i];
            } else {
                for (std::size_t i = 0; i < chunk.count; ++i)
                    plane[i] = diffuse * shares.diffuse[i] + specular * shares.specular[i] +
                               grazing_ * shares.grazing[i];
            }
        }
    }
}

void Bsdf::evaluate_lobes_times_cosine(const Imath::V3f& wo,
                                       const Directions& wi,
                                       const LobePlanes& out) const {
    Shares shares{};
    const bool is_seen = wo.z > 0;
    for (std::size_t start = 0; start < wi.x.size(); start += kChunk) {
        const ChunkOfDirections chunk(wi, start);
        if (is_seen)
            find_shares(*this, wo, chunk, shares);
        std::copy_n(shares.diffuse.begin(), chunk.count, out.diffuse.data() + start);
        std::copy_n(shares.specular.begin(), chunk.count, out.specular.data() + start);
        std::copy_n(shares.grazing.begin(), chunk.count, out.grazing.data() + start);
    }
}

}  // namespace relume::scene
