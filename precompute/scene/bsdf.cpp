#include "precompute/scene/bsdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::scene {
namespace {

using lobes::kInversePi;

constexpr float kTwoPi = 2.0F * std::numbers::pi_v<float>;
constexpr float kMaxExponent = 1e5F;

Imath::V3f clamped(const Imath::V3f& colour) {
    const auto unit = [](float v) {
        return std::isfinite(v) ? std::clamp(v, 0.0F, 1.0F) : 0.0F;
    };
    return {unit(colour.x), unit(colour.y), unit(colour.z)};
}

float largest(const Imath::V3f& colour) {
    return std::max({colour.x, colour.y, colour.z});
}

Imath::V3f mirrored(const Imath::V3f& w) {
    return {-w.x, -w.y, w.z};
}

Imath::V3f cosine_direction(const Imath::V2f& u) {
    const float radius = std::sqrt(u.x);
    const float phi = kTwoPi * u.y;
    return {radius * std::cos(phi), radius * std::sin(phi),
            std::sqrt(std::max(0.0F, 1.0F - u.x))};
}

// Around `axis`, density (e+1)/(2π) cos^e α.
Imath::V3f power_cosine_direction(const Imath::V3f& axis, float exponent, const Imath::V2f& u) {
    const float cosine = std::pow(u.x, 1.0F / (exponent + 1.0F));
    const float sine = std::sqrt(std::max(0.0F, 1.0F - cosine * cosine));
    const float phi = kTwoPi * u.y;
    // axis.z ≥ 0, so [Duff17]'s frame needs no sign.
    const float a = -1.0F / (1.0F + axis.z);
    const float b = axis.x * axis.y * a;
    const Imath::V3f s{1.0F + axis.x * axis.x * a, b, -axis.x};
    const Imath::V3f t{b, 1.0F + axis.y * axis.y * a, -axis.y};
    return s * (sine * std::cos(phi)) + t * (sine * std::sin(phi)) + axis * cosine;
}

// A normal of those that wo sees [Heitz18 listing 1].
Imath::V3f visible_normal(const Imath::V3f& wo, float alpha, const Imath::V2f& u) {
    const Imath::V3f v = Imath::V3f(alpha * wo.x, alpha * wo.y, wo.z).normalized();
    const float length2 = v.x * v.x + v.y * v.y;
    const Imath::V3f t1 =
        length2 > 0 ? Imath::V3f(-v.y, v.x, 0) / std::sqrt(length2) : Imath::V3f(1, 0, 0);
    const Imath::V3f t2 = v.cross(t1);
    const float radius = std::sqrt(u.x);
    const float phi = kTwoPi * u.y;
    const float p1 = radius * std::cos(phi);
    const float blend = 0.5F * (1.0F + v.z);
    const float p2 = (1.0F - blend) * std::sqrt(std::max(0.0F, 1.0F - p1 * p1)) +
                     blend * radius * std::sin(phi);
    const float p3 = std::sqrt(std::max(0.0F, 1.0F - p1 * p1 - p2 * p2));
    const Imath::V3f n = t1 * p1 + t2 * p2 + v * p3;
    return Imath::V3f(alpha * n.x, alpha * n.y, std::max(1e-6F, n.z)).normalized();
}

}  // namespace

Bsdf Bsdf::lambert(const Imath::V3f& albedo) {
    Bsdf bsdf;
    bsdf.model_ = BsdfModel::lambert;
    bsdf.diffuse_ = clamped(albedo);
    return bsdf;
}

Bsdf Bsdf::phong(const Imath::V3f& diffuse, const Imath::V3f& specular, float exponent) {
    Bsdf bsdf;
    bsdf.model_ = BsdfModel::phong;
    bsdf.diffuse_ = clamped(diffuse);
    bsdf.specular_ = clamped(specular);
    const float sum = largest(bsdf.diffuse_ + bsdf.specular_);
    if (sum > 1.0F) {
        bsdf.diffuse_ /= sum;
        bsdf.specular_ /= sum;
    }
    const float bounded = exponent >= 0 ? std::min(exponent, kMaxExponent) : 0.0F;
    bsdf.exponent_ = std::round(bounded * lobes::kExponentSteps) / lobes::kExponentSteps;
    return bsdf;
}

Bsdf Bsdf::ggx(const Imath::V3f& base,
               float metallic,
               float roughness,
               const Dielectric& dielectric) {
    Bsdf bsdf;
    bsdf.model_ = BsdfModel::ggx;
    const Imath::V3f colour = clamped(base);
    const float metal = std::clamp(metallic, 0.0F, 1.0F);
    const float rough = std::clamp(roughness, kMinRoughness, 1.0F);
    bsdf.diffuse_ = colour * (1.0F - metal);
    const float f90 = std::clamp(dielectric.f90, 0.0F, 1.0F);
    Imath::V3f f0 = clamped(dielectric.f0);
    for (int c = 0; c < 3; ++c)
        f0[c] = std::min(f0[c], f90);
    bsdf.specular_ = f0 * (1.0F - metal) + colour * metal;
    bsdf.grazing_ = f90 * (1.0F - metal) + metal;
    bsdf.coat_ = {.f0 = largest(f0), .f90 = f90};
    bsdf.alpha_ = rough * rough;
    return bsdf;
}

Bsdf Bsdf::with_mean_colours(std::span<const Bsdf> places) const {
    Bsdf mean = *this;
    mean.diffuse_ = {0, 0, 0};
    mean.specular_ = {0, 0, 0};
    mean.grazing_ = 0;
    const float each = 1.0F / static_cast<float>(places.size());
    for (const Bsdf& place : places) {
        mean.diffuse_ += place.diffuse_ * each;
        mean.specular_ += place.specular_ * each;
        mean.grazing_ += place.grazing_ * each;
    }
    return mean;
}

Imath::V3f Bsdf::evaluate(const Imath::V3f& wi, const Imath::V3f& wo) const {
    if (wi.z <= 0 || wo.z <= 0)
        return {0, 0, 0};
    if (model_ == BsdfModel::lambert)
        return diffuse_ * kInversePi;
    Imath::V3f value;
    evaluate_times_cosine(wo, {{&wi.x, 1}, {&wi.y, 1}, {&wi.z, 1}},
                          {{&value.x, 1}, {&value.y, 1}, {&value.z, 1}});
    return value / wi.z;
}

float Bsdf::diffuse_chance(const Imath::V3f& wo) const {
    if (model_ == BsdfModel::lambert)
        return 1;
    float diffuse = largest(diffuse_);
    float specular = largest(specular_);
    if (model_ == BsdfModel::ggx) {
        diffuse *= coat_.transmission(wo.z);
        specular += (grazing_ - specular) * lobes::schlick_weight(wo.z);
    }
    const float sum = diffuse + specular;
    return sum > 0 ? diffuse / sum : 1.0F;
}

BsdfSample Bsdf::sample(const Imath::V3f& wo, float u_lobe, const Imath::V2f& u) const {
    BsdfSample sample;
    if (wo.z <= 0)
        return sample;
    if (u_lobe < diffuse_chance(wo)) {
        sample.wi = cosine_direction(u);
    } else if (model_ == BsdfModel::phong) {
        sample.wi = power_cosine_direction(mirrored(wo), exponent_, u);
    } else {
        const Imath::V3f h = visible_normal(wo, alpha_, u);
        sample.wi = h * (2.0F * wo.dot(h)) - wo;
    }
    sample.pdf = pdf(sample.wi, wo);
    if (sample.pdf > 0)
        sample.weight = evaluate(sample.wi, wo) * (sample.wi.z / sample.pdf);
    return sample;
}

float Bsdf::pdf(const Imath::V3f& wi, const Imath::V3f& wo) const {
    if (wi.z <= 0 || wo.z <= 0)
        return 0;
    const float chance = diffuse_chance(wo);
    const float diffuse = wi.z * kInversePi;
    if (model_ == BsdfModel::lambert)
        return diffuse;
    float specular = 0;
    if (model_ == BsdfModel::phong) {
        const float cosine = std::clamp(mirrored(wo).dot(wi), 0.0F, 1.0F);
        specular = (exponent_ + 1.0F) / kTwoPi * std::pow(cosine, exponent_);
    } else {
        const Imath::V3f h = (wi + wo).normalized();
        const float alpha2 = alpha_ * alpha_;
        const float root = lobes::smith_root(alpha2, wo.z);
        // D_visible(h) / (4 wo·h), where D_visible = G1 D wo·h / cos θo.
        specular = 0.5F * lobes::smith_masking(wo.z, root) *
                   lobes::ggx_distribution(alpha2, h.x * h.x + h.y * h.y, h.z);
    }
    return chance * diffuse + (1.0F - chance) * specular;
}

}  // namespace relume::scene
