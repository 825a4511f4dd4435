#include "protocol/brdf/factored_brdf.h"

#include "protocol/brdf/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace relume::brdf {

Imath::V3f FactoredBrdf::evaluate(const Imath::V3f& wi,
                                  const Imath::V3f& wo,
                                  std::span<const Imath::V3f> colours) const {
    std::array<float, TableShape::kMostDepth> of_light;
    std::array<float, TableShape::kMostDepth> of_view;
    g.evaluate(wi, of_light);
    h.evaluate(wo, of_view);
    Imath::V3f sum(0, 0, 0);
    for (std::size_t l = 0; l < lobes; ++l) {
        float lobe = 0;
        for (std::size_t k = 0; k < terms; ++k) {
            lobe += of_view[k * lobes + l] * of_light[k];
        }
        sum += colours[l] * lobe;
    }
    return sum;
}

void require_valid(const FactoredBrdf& brdf) {
    if (brdf.name.size() > FactoredBrdf::kMostNameBytes ||
        std::any_of(brdf.name.begin(), brdf.name.end(), [](char c) {
            const auto byte = static_cast<unsigned char>(c);
            return byte < 0x20 || byte == 0x7f;
        })) {
        throw BrdfError(
            fmt::format("the name of a BRDF has {} bytes or a control character, "
                        "expected at most {} bytes without",
                        brdf.name.size(), FactoredBrdf::kMostNameBytes));
    }
    if (brdf.terms < 1 || brdf.terms > FactoredBrdf::kMostTerms || brdf.lobes < 1 ||
        brdf.lobes > FactoredBrdf::kMostLobes) {
        throw BrdfError(fmt::format(
            "BRDF \"{}\" has {} terms and {} lobes, expected 1 … {} and 1 … {}", brdf.name,
            brdf.terms, brdf.lobes, FactoredBrdf::kMostTerms, FactoredBrdf::kMostLobes));
    }
    if (brdf.g.shape().depth != brdf.terms || brdf.h.shape().depth != brdf.terms * brdf.lobes) {
        throw BrdfError(
            fmt::format("the tables of BRDF \"{}\" have depths {} and {}, expected "
                        "{} and {}",
                        brdf.name, brdf.g.shape().depth, brdf.h.shape().depth, brdf.terms,
                        brdf.terms * brdf.lobes));
    }
}

FactoredBrdf factored_lambert(std::string name, const Imath::V3f& mean_albedo) {
    const float mean_square = mean_albedo.dot(mean_albedo) / 3;
    const float scale = mean_square > 0 ? std::sqrt(mean_square) : 1.0F;
    const TableShape constant{.rows = TableShape::kLeastRows, .columns = 1, .depth = 1};
    return {.name = std::move(name),
            .terms = 1,
            .lobes = 1,
            .g = {constant, std::vector<float>(2, scale * std::numbers::inv_pi_v<float>)},
            .h = {constant, std::vector<float>(2, 1 / scale)}};
}

}  // namespace relume::brdf
