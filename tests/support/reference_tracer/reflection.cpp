#include "tests/support/reference_tracer/reflection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::reference {
namespace {

using Imath::V3d;

constexpr double kPi = std::numbers::pi;

V3d mirror(const V3d& w, const V3d& n) {
    return n * (2.0 * w.dot(n)) - w;
}

// Spherical coordinates about an axis, by Gram-Schmidt on a coordinate axis.
V3d about(const V3d& axis, double cosine, double phi) {
    const V3d helper = std::abs(axis.x) < 0.6 ? V3d(1, 0, 0) : V3d(0, 1, 0);
    const V3d s = helper.cross(axis).normalized();
    const V3d t = axis.cross(s);
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return s * (sine * std::cos(phi)) + t * (sine * std::sin(phi)) + axis * cosine;
}

double schlick(double f0, double f90, double cosine) {
    return f0 + (f90 - f0) * std::pow(1.0 - cosine, 5.0);
}

// [Walter07 eq. 33], by tan θ.
double ggx_d(double cos_h, double alpha) {
    if (cos_h <= 0)
        return 0;
    const double cos2 = cos_h * cos_h;
    const double tan2 = (1.0 - cos2) / cos2;
    const double sum = alpha * alpha + tan2;
    return alpha * alpha / (kPi * cos2 * cos2 * sum * sum);
}

// Smith's Λ for GGX [Heitz14 eq. 72].
double smith_lambda(double cosine, double alpha) {
    const double tan2 = (1.0 - cosine * cosine) / (cosine * cosine);
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * tan2) - 1.0);
}

}  // namespace

V3d Reflection::value(const V3d& wi, const V3d& wo) const {
    const double ci = wi.dot(normal);
    const double co = wo.dot(normal);
    if (ci <= 0 || co <= 0)
        return {0, 0, 0};
    if (model == Model::lambert)
        return diffuse / kPi;
    if (model == Model::phong) {
        const double cosine = std::max(0.0, mirror(wo, normal).dot(wi));
        return diffuse / kPi +
               specular * ((exponent + 2.0) / (2.0 * kPi) * std::pow(cosine, exponent));
    }
    const V3d h = (wi + wo).normalized();
    const double g2 = 1.0 / (1.0 + smith_lambda(ci, alpha) + smith_lambda(co, alpha));
    const double lobe = ggx_d(h.dot(normal), alpha) * g2 / (4.0 * ci * co);
    // A dielectric coat over a diffuse base [Shirley97]: what enters on the way in and out,
    // over the hemispherical mean 1 − (F0 + (F90 − F0)/21).
    const double through = 1.0 - (coat_f0 + (coat_f90 - coat_f0) / 21.0);
    const double layer = through < 1e-4
                             ? 0.0
                             : (1.0 - schlick(coat_f0, coat_f90, ci)) *
                                   (1.0 - schlick(coat_f0, coat_f90, co)) / (kPi * through);
    V3d f;
    for (int c = 0; c < 3; ++c)
        f[c] = diffuse[c] * layer + schlick(specular[c], grazing, wo.dot(h)) * lobe;
    return f;
}

double Reflection::diffuse_share() const {
    const double d = std::max({diffuse.x, diffuse.y, diffuse.z});
    const double s = std::max({specular.x, specular.y, specular.z});
    if (model == Model::lambert || d + s <= 0)
        return 1;
    if (d <= 0)
        return 0;
    return std::clamp(d / (d + 2.0 * s), 0.2, 0.8);
}

// Half vectors are drawn from D cos θ [Walter07 eq. 35, 36], not from the visible normals that
// the bake draws from.
V3d Reflection::sampled(const V3d& wo, Random& random) const {
    const double lobe = random.uniform();
    const double u = random.uniform();
    const double phi = 2.0 * kPi * random.uniform();
    if (lobe < diffuse_share())
        return about(normal, std::sqrt(1.0 - u), phi);
    if (model == Model::phong)
        return about(mirror(wo, normal), std::pow(u, 1.0 / (exponent + 1.0)), phi);
    const double cosine = std::sqrt((1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u));
    const V3d h = about(normal, cosine, phi);
    return mirror(wo, h);
}

double Reflection::density(const V3d& wi, const V3d& wo) const {
    const double share = diffuse_share();
    const double diffuse_density = std::max(0.0, wi.dot(normal)) / kPi;
    if (model == Model::lambert)
        return diffuse_density;
    double lobe = 0;
    if (model == Model::phong) {
        const double cosine = std::max(0.0, mirror(wo, normal).dot(wi));
        lobe = (exponent + 1.0) / (2.0 * kPi) * std::pow(cosine, exponent);
    } else {
        const V3d h = (wi + wo).normalized();
        const double cos_h = h.dot(normal);
        lobe = ggx_d(cos_h, alpha) * cos_h / (4.0 * std::max(1e-9, wo.dot(h)));
    }
    return share * diffuse_density + (1.0 - share) * lobe;
}

}  // namespace relume::reference
