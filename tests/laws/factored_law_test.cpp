// What a view shows of a factored BRDF is the sum of its products under the light, and what the
// BRDF itself reflects within the error that the bake states.
#include "precompute/bake/blocks/light_model.h"
#include "protocol/basis/cubemap.h"
#include "protocol/brdf/local_frame.h"
#include "server/view/mesh/pinhole_from_look.h"
#include "server/view/mesh/pixel_rays.h"
#include "tests/stability/mesh/baked_surface.h"
#include "tests/stability/mesh/open_floor.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include <cmath>
#include <iostream>
#include <random>
#include <vector>

namespace relume::test {
namespace {

using Imath::V3d;
using Imath::V3f;
using stability::Lighting;
using stability::RelitImage;

constexpr int kViews = 20;
constexpr std::size_t kLights = 12;
constexpr std::uint32_t kSide = 6;

scene::Material lacquer() {
    return {.name = "lacquer",
            .model = scene::BsdfModel::phong,
            .base_colour = {0.1F, 0.2F, 0.15F},
            .specular = {0.4F, 0.35F, 0.3F},
            .exponent = 12};
}

bake::BakeParameters parameters_of_floor() {
    bake::BakeParameters parameters = stability::surface_parameters(50);
    parameters.terms = 4;
    return parameters;
}

// What texel after texel of the light adds to what is seen, for radiance 1.
struct Responses {
    std::vector<V3d> of_factors;  // g in the middle of the texel, as it is baked
    std::vector<V3d> of_brdf;
};

// A floor of which every point sees the same, so that nothing is interpolated.
class FactoredLaw : public testing::Test {
  protected:
    FactoredLaw() {
        constexpr std::uint32_t kPlaces = 8;  // along a side of a texel
        const std::uint32_t n = surface_.scene()->face_resolution();
        for (std::size_t i = 0; i < basis::texel_count(n); ++i) {
            const basis::Texel texel = basis::texel_from_index(n, i);
            TexelLight light{
                .middle = frame_.local_from_world(basis::direction_from_texel(n, texel))};
            const double area = basis::solid_angle_sr(n, texel.row, texel.column);
            for (std::uint32_t place = 0; place < kPlaces * kPlaces; ++place) {
                const auto at = [](std::uint32_t k) {
                    return (static_cast<float>(k) + 0.5F) / kPlaces;
                };
                const V3f direction = frame_.local_from_world(basis::direction_from_texel(
                    n, texel, at(place % kPlaces), at(place / kPlaces)));
                if (direction.z > 0) {
                    light.places.push_back(direction);
                    light.irradiance += double{direction.z} * area / (kPlaces * kPlaces);
                }
            }
            lights_.push_back(std::move(light));
        }
    }

    [[nodiscard]] Responses responses(const V3f& to_viewer) const {
        const transport::Surface& surface = surface_.transport().surface().value();
        const transport::MaterialRecord& material =
            surface_.transport().manifest().mesh->materials[0];
        const brdf::FactoredBrdf& factored = surface.brdfs[material.brdf];
        std::vector<V3f> colours;
        for (const transport::LobeRecord& lobe : material.lobes) {
            colours.push_back(lobe.colour);
        }
        const scene::Bsdf bsdf = stability::bsdf_of(lacquer());
        const V3f wo = frame_.local_from_world(to_viewer);
        Responses found;
        for (const TexelLight& light : lights_) {
            found.of_factors.push_back(V3d(factored.evaluate(light.middle, wo, colours)) *
                                       light.irradiance);
            V3d sum(0);
            double cosines = 0;
            for (const V3f& place : light.places) {
                sum += V3d(bsdf.evaluate(place, wo)) * double{place.z};
                cosines += double{place.z};
            }
            found.of_brdf.push_back(cosines > 0 ? sum * (light.irradiance / cosines) : V3d(0));
        }
        return found;
    }

    // Of three natural lights for red, green and blue: radiances, [3][texels].
    [[nodiscard]] std::vector<std::vector<float>> natural_radiance(std::uint64_t seed) const {
        const basis::CubemapProjection& projection = surface_.scene()->projection();
        std::vector<std::vector<float>> planes;
        for (std::uint64_t c = 0; c < 3; ++c) {
            planes.emplace_back(lights_.size());
            projection.reconstruct_radiance(
                bake::natural_light(projection.basis(), 3 * seed + c), planes.back());
        }
        return planes;
    }

    [[nodiscard]] Lighting lighting(const std::vector<std::vector<float>>& planes) const {
        const basis::CubemapProjection& projection = surface_.scene()->projection();
        const std::size_t columns = projection.basis().coefficient_count();
        Lighting coefficients(3 * columns);
        for (std::size_t c = 0; c < 3; ++c) {
            projection.project_radiance(planes[c],
                                        std::span(coefficients).subspan(c * columns, columns));
        }
        return coefficients;
    }

    stability::BakedSurface surface_{stability::open_floor(lacquer()), parameters_of_floor()};

  private:
    struct TexelLight {
        V3f middle{0, 0, 0};
        std::vector<V3f> places{};  // above the horizon
        double irradiance = 0;
    };

    brdf::Frame frame_ = brdf::local_frame({0, 1, 0});
    std::vector<TexelLight> lights_;
};

view::Look some_look(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    const double height = 0.15 + 0.8 * unit(random);
    const double turn = 2 * M_PI * unit(random);
    const double across = std::sqrt(1 - height * height);
    return {.eye = {across * std::cos(turn), height, across * std::sin(turn)},
            .look_at = {0, 0, 0},
            .up = {0, 1, 0},
            .fov_degrees = 10,
            .width = kSide,
            .height = kSide};
}

TEST_F(FactoredLaw, AnImageIsTheSumOfTheFactorsAndTheBrdfWithinTheStatedError) {
    std::vector<std::vector<std::vector<float>>> lights;
    std::vector<std::vector<float>> sums;
    for (std::size_t light = 0; light < kLights; ++light) {
        lights.push_back(natural_radiance(light));
        sums.push_back(surface_.exact_sums(lighting(lights.back())));
    }
    std::mt19937 random(9);
    double norm = 0;
    double from_factors = 0;
    double from_brdf = 0;
    for (int i = 0; i < kViews; ++i) {
        const view::Look look = some_look(random);
        const view::PixelRays rays(
            view::pinhole_from_look(look, {.origin = {0, 0, 0}, .unit = 1}), kSide, kSide);
        std::vector<Responses> of_pixel(std::size_t{kSide} * kSide);
        tbb::parallel_for(std::uint32_t{0}, kSide * kSide, [&](std::uint32_t pixel) {
            of_pixel[pixel] = responses(
                -rays.direction(pixel % kSide + 0.5, pixel / kSide + 0.5).normalized());
        });
        for (std::size_t light = 0; light < kLights; ++light) {
            const RelitImage image = surface_.image_of_sums(look, sums[light]);
            for (std::uint32_t pixel = 0; pixel < kSide * kSide; ++pixel) {
                V3d factors(0);
                V3d brdf(0);
                for (std::size_t t = 0; t < lights[light][0].size(); ++t) {
                    for (int c = 0; c < 3; ++c) {
                        const double radiance = lights[light][static_cast<std::size_t>(c)][t];
                        factors[c] += radiance * of_pixel[pixel].of_factors[t][c];
                        brdf[c] += radiance * of_pixel[pixel].of_brdf[t][c];
                    }
                }
                const V3d shown(image.rgb[3 * pixel], image.rgb[3 * pixel + 1],
                                image.rgb[3 * pixel + 2]);
                norm += brdf.length2();
                from_factors += (shown - factors).length2();
                from_brdf += (shown - brdf).length2();
            }
        }
    }
    const nlohmann::json stated = surface_.transport().manifest().measured;
    const double of_factors = stated.at("brdfs").at(0).at("error").get<double>();
    std::cout << "  relative L2 from the factors " << std::sqrt(from_factors / norm)
              << ", from the BRDF " << std::sqrt(from_brdf / norm) << ", stated " << of_factors
              << "; " << stated.at("quantisation_error").dump() << '\n';
    EXPECT_GT(of_factors, 0.005);
    // 8 bits a value, which leave 2e-3.
    EXPECT_LT(std::sqrt(from_factors / norm), 4e-3);
    EXPECT_LT(std::sqrt(from_brdf / norm), 1.1 * of_factors);
    // Texels are wider than the finest light that the statement has in mind.
    EXPECT_GT(std::sqrt(from_brdf / norm), 0.25 * of_factors);
}

}  // namespace
}  // namespace relume::test
