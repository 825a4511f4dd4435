#include "precompute/factors/brdf_lobes.h"

#include "precompute/factors/merl_brdf.h"

#include <algorithm>
#include <cmath>

namespace relume::factors {
namespace {

// Phong's cos^e α falls as a Gauss function of this standard deviation, GGX to a quarter where
// the half vector is α off its peak, which moves the direction twice as far.
double width_of(const scene::Bsdf& bsdf) {
    switch (bsdf.model()) {
        case scene::BsdfModel::phong:
            return 1 / std::sqrt(std::max(1.0, static_cast<double>(bsdf.exponent())));
        case scene::BsdfModel::ggx:
            return std::min(1.0, 2.0 * static_cast<double>(bsdf.alpha()));
        case scene::BsdfModel::lambert:
            break;
    }
    return 1;
}

void evaluate(const scene::Bsdf& bsdf,
              std::size_t lobes,
              const Imath::V3f& wo,
              const brdf::Directions& wi,
              std::span<float> out) {
    const std::size_t count = wi.size();
    std::vector<float> unused(lobes < 3 ? count : 0);
    const auto plane = [&](std::size_t lobe) {
        return lobe < lobes ? out.subspan(lobe * count, count) : std::span<float>(unused);
    };
    bsdf.evaluate_lobes_times_cosine(
        wo, {wi.x, wi.y, wi.z},
        {.diffuse = plane(0), .specular = plane(1), .grazing = plane(2)});
    for (std::size_t lobe = 0; lobe < lobes; ++lobe) {
        for (std::size_t i = 0; i < count; ++i) {
            out[lobe * count + i] /= wi.z[i];
        }
    }
}

}  // namespace

std::vector<double> BrdfLobes::weights() const {
    std::vector<double> weights;
    for (const Imath::V3f& colour : mean_colours) {
        weights.push_back(std::sqrt(Imath::V3d(colour).length2() / 3));
    }
    if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; })) {
        std::fill(weights.begin(), weights.end(), 1.0);
    }
    return weights;
}

std::vector<Imath::V3f> lobe_colours(const scene::Bsdf& bsdf) {
    switch (bsdf.model()) {
        case scene::BsdfModel::lambert:
            return {bsdf.diffuse_colour()};
        case scene::BsdfModel::phong:
            return {bsdf.diffuse_colour(), bsdf.specular_colour()};
        case scene::BsdfModel::ggx:
            break;
    }
    return {bsdf.diffuse_colour(), bsdf.specular_colour(), Imath::V3f(bsdf.grazing())};
}

BrdfLobes lobes_of(const scene::Bsdf& mean) {
    std::vector<Imath::V3f> colours = lobe_colours(mean);
    const std::size_t count = colours.size();
    return {std::move(colours), width_of(mean),
            [mean, count](const Imath::V3f& wo, const brdf::Directions& wi,
                          std::span<float> out) { evaluate(mean, count, wo, wi, out); }};
}

BrdfLobes lobes_of(const MerlBrdf& measured) {
    return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
            measured.width_rad(),
            [measured](const Imath::V3f& wo, const brdf::Directions& wi, std::span<float> out) {
                const std::size_t count = wi.size();
                for (std::size_t i = 0; i < count; ++i) {
                    const Imath::V3f value = measured.evaluate({wi.x[i], wi.y[i], wi.z[i]}, wo);
                    out[i] = value.x;
                    out[count + i] = value.y;
                    out[2 * count + i] = value.z;
                }
            }};
}

}  // namespace relume::factors
