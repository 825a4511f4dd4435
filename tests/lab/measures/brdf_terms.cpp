#include "tests/lab/measures/brdf_terms.h"

#include "precompute/factors/merl_brdf.h"
#include "precompute/scene/bsdf.h"
#include "tests/support/merl_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace relume::lab {
namespace {

using Imath::V3f;

constexpr std::uint32_t kShownTerms = 5;

LabBrdf tabulated_plastic() {
    const scene::Bsdf plastic = scene::Bsdf::ggx({0.5F, 0.15F, 0.05F}, 0, 0.4F);
    const auto bytes =
        test::merl_file([&](const V3f& wi, const V3f& wo) { return plastic.evaluate(wi, wo); });
    return {"plastic, roughness 0.4, as MERL's tables",
            factors::lobes_of(factors::MerlBrdf("plastic", bytes))};
}

}  // namespace

std::vector<LabBrdf> lab_brdfs() {
    std::vector<LabBrdf> brdfs;
    for (const float exponent : {10.0F, 50.0F, 200.0F}) {
        brdfs.push_back({fmt::format("Phong, exponent {}", exponent),
                         factors::lobes_of(scene::Bsdf::phong(V3f(0), V3f(1), exponent))});
    }
    for (const float roughness : {0.6F, 0.3F, 0.1F}) {
        brdfs.push_back({fmt::format("GGX metal, roughness {}", roughness),
                         factors::lobes_of(scene::Bsdf::ggx(V3f(1), 1, roughness))});
    }
    brdfs.push_back(tabulated_plastic());
    return brdfs;
}

LabBrdf measured_brdf(const std::filesystem::path& file) {
    return {file.stem().string(), factors::lobes_of(factors::MerlBrdf::read(file))};
}

std::vector<BrdfTerms> measure_brdf_terms(const LabBrdf& brdf) {
    using factors::LightModel;
    using factors::Method;
    std::vector<BrdfTerms> rows;
    const auto add = [&](Method method, LightModel light) {
        const factors::Factorisation result = factors::factorise(
            brdf.name, brdf.lobes, {.method = method, .light = light, .terms = kShownTerms});
        rows.push_back({.brdf = brdf.name,
                        .method = method == Method::svd ? "svd" : "nmf",
                        .light = light == LightModel::natural ? "natural" : "uncorrelated",
                        .errors = result.errors,
                        .largest_negative_of_5 = result.largest_negative,
                        .negative_norm_of_5 = result.negative_norm,
                        .rows = result.brdf.g.shape().rows,
                        .columns = result.brdf.g.shape().columns});
    };
    add(Method::svd, LightModel::natural);
    add(Method::svd, LightModel::uncorrelated);
    add(Method::nmf, LightModel::uncorrelated);
    return rows;
}

std::size_t terms_for(const BrdfTerms& measured, double error) {
    const auto first = std::find_if(measured.errors.begin(), measured.errors.end(),
                                    [&](double value) { return value <= error; });
    return first == measured.errors.end()
               ? 0
               : static_cast<std::size_t>(first - measured.errors.begin()) + 1;
}

}  // namespace relume::lab
