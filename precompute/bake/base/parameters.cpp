#include "precompute/bake/base/parameters.h"

#include "protocol/base/program/usage.h"
#include "protocol/basis/cubemap.h"
#include "protocol/transport/format.h"
#include "protocol/transport/manifest.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string_view>

namespace relume::bake {
namespace {

template <typename T>
void require_range(std::string_view name, T value, T low, T high) {
    if (!(value >= low && value <= high)) {
        throw program::UsageError(
            fmt::format("{} is {}, expected {} to {}", name, value, low, high));
    }
}

}  // namespace

void check_parameters(const BakeParameters& p) {
    constexpr std::uint32_t kMaxSamples = 1U << 20U;
    constexpr std::uint32_t kMostVertices = 1'000'000;
    constexpr std::uint32_t kMostTerms = 10;
    require_range("image width", p.width, 1U, transport::kMaxImageSide);
    require_range("image height", p.height, 1U, transport::kMaxImageSide);
    if (!basis::is_face_resolution(p.face_resolution)) {
        throw program::UsageError(fmt::format(
            "light resolution is {}, expected a power of two from {} to {}", p.face_resolution,
            basis::kMinFaceResolution, basis::kMaxFaceResolution));
    }
    if (p.basis == basis::CubemapBasis::Kind::spherical_harmonics) {
        require_range("order", p.order, 1U, basis::kMaxShOrder);
    }
    require_range("bounces", p.bounces, 0U, 1000U);
    require_range("samples", p.samples, 1U, kMaxSamples);
    require_range("bits", p.bits, 6U, 8U);
    require_range("pixel samples", p.pixel_samples, 1U, 64U);
    require_range("edge samples", p.edge_samples, 0U, 256U);
    require_range("pool radius", p.pool_radius, 0U, 16U);
    require_range("shrinkage", p.shrinkage, 0.0F, 10.0F);
    require_range("threads", p.threads, 0U, 1024U);
    require_range("vertices", p.vertices, 3U, kMostVertices);
    require_range("target error", p.target_error, 1e-6, 1.0);
    require_range("terms", p.terms, 0U, kMostTerms);
}

basis::CubemapBasis signal_basis(const BakeParameters& p) {
    return p.basis == basis::CubemapBasis::Kind::haar
               ? basis::CubemapBasis::haar(p.face_resolution)
               : basis::CubemapBasis::spherical_harmonics(p.order, p.face_resolution);
}

nlohmann::json json_from_parameters(const BakeParameters& p) {
    nlohmann::json object{{"width", p.width},
                          {"height", p.height},
                          {"light_resolution", p.face_resolution},
                          {"bounces", p.bounces},
                          {"samples", p.samples},
                          {"bits", p.bits},
                          {"pixel_samples", p.pixel_samples},
                          {"edge_samples", p.edge_samples},
                          {"pool_radius", p.pool_radius},
                          {"shrinkage", p.shrinkage},
                          {"seed", p.seed}};
    // What other bakes are hashed by has no such keys.
    if (p.up_axis == scene::UpAxis::z) {
        object["up_axis"] = "z";
    }
    if (p.basis == basis::CubemapBasis::Kind::spherical_harmonics) {
        object["basis"] = transport::name_of(signal_basis(p));
        object["order"] = p.order;
    }
    if (p.receivers == ReceiverKind::vertices) {
        object["receivers"] = "vertices";
        object["vertices"] = p.vertices;
        object["target_error"] = p.target_error;
        object["terms"] = p.terms;
        object["factors"] = factors::kMethodNames.name(p.factor_method);
    }
    return object;
}

}  // namespace relume::bake
