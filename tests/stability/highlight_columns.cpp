// A mirror-like ball on a matte floor: of a texel's light, one pixel sees hundreds of times
// what the others see.
#include "precompute/bake/bake.h"
#include "precompute/scene/builtin/mesh_builder.h"
#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"
#include "protocol/transport/quantise.h"
#include "tests/laws/bake_estimate.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"
#include "tests/support/dense_product.h"
#include "tests/support/scratch_directory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace relume::stability {
namespace {

constexpr float kLevels = 127;  // of 8 bits and a sign

scene::Scene mirror_ball() {
    scene::Scene scene;
    scene.name = "mirror-ball";
    scene.materials.push_back({.name = "matte", .base_colour = Imath::V3f(0.5F)});
    scene.materials.push_back({.name = "mirror",
                               .model = scene::BsdfModel::ggx,
                               .base_colour = Imath::V3f(0.95F),
                               .metallic = 1,
                               .roughness = 0.06F});
    scene::MeshBuilder floor("floor", 0);
    floor.add_quad({-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, {-3, 0, -3});
    scene::MeshBuilder ball("ball", 1);
    // Of a large ball the top, so that a highlight is some pixels wide.
    ball.add_sphere({0, -1.7F, 0}, 2, 128);
    scene.meshes.push_back(floor.take());
    scene.meshes.push_back(ball.take());
    scene.camera = {.name = "above",
                    .eye = {0, 2.2F, 2.2F},
                    .look_at = {0, 0.3F, 0},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 45};
    finish_scene(scene);
    return scene;
}

using Light = std::vector<Imath::V3f>;  // radiance of the 6·n² texels

// The floor, which has one brightness: the pixels within a factor of two of the median.
struct Matte {
    std::vector<std::size_t> pixels;
    double rms = 0;
    double brightest = 0;  // of all pixels

    explicit Matte(const test::LinearImage& exact) {
        std::vector<double> values;
        for (const auto& pixel : exact.pixels) {
            values.push_back(pixel.x);
            brightest = std::max(brightest, pixel.x);
        }
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        for (std::size_t p = 0; p < exact.pixels.size(); ++p) {
            const double value = exact.pixels[p].x;
            if (value > *middle / 2 && value < *middle * 2) {
                pixels.push_back(p);
                rms += value * value;
            }
        }
        rms = std::sqrt(rms / static_cast<double>(pixels.size()));
    }

    [[nodiscard]] double relative_error(const test::LinearImage& image,
                                        const test::LinearImage& exact) const {
        double sum = 0;
        for (const std::size_t p : pixels) {
            sum += std::pow(image.pixels[p].x - exact.pixels[p].x, 2);
        }
        return std::sqrt(sum / static_cast<double>(pixels.size())) / rms;
    }
};

// [Ng03 §5]: the columns of the light that is lit, 8 bits over the range of each.
test::LinearImage by_column_range(const scene::Scene& scene,
                                  const bake::BakeParameters& parameters,
                                  const Light& light) {
    std::vector<float> coefficients;
    for (const Imath::V3f& texel : light) {
        coefficients.push_back(texel.x);
    }
    basis::haar_forward_cubemap(parameters.face_resolution, coefficients);
    test::LinearImage image{parameters.width, parameters.height, {}};
    image.pixels.resize(std::size_t{parameters.width} * parameters.height, Imath::V3d(0));
    for (std::size_t j = 0; j < coefficients.size(); ++j) {
        if (coefficients[j] == 0) {
            continue;
        }
        std::vector<float> wavelet(coefficients.size());
        wavelet[j] = 1;
        basis::haar_inverse_cubemap(parameters.face_resolution, wavelet);
        Light lit;
        for (const float value : wavelet) {
            lit.emplace_back(value);
        }
        const test::LinearImage column = test::relit_from_rows(scene, parameters, lit);
        double range = 0;
        for (const auto& pixel : column.pixels) {
            range = std::max(range, std::abs(pixel.x));
        }
        for (std::size_t p = 0; range > 0 && p < column.pixels.size(); ++p) {
            const double step = range / double{kLevels};
            image.pixels[p] += Imath::V3d(std::round(column.pixels[p].x / step) * step *
                                          double{coefficients[j]});
        }
    }
    return image;
}

// Σ_j zone·step_j·|L_j|, the dead zone being the largest error of one value: by the triangle
// inequality the largest RMS error of the image, before tint.
double storage_bound(const transport::Transport& transport, const Light& light) {
    std::vector<float> coefficients;
    for (const Imath::V3f& texel : light) {
        coefficients.push_back(texel.x);
    }
    basis::haar_forward_cubemap(transport.manifest().signal_basis.cubemap().face_resolution(),
                                coefficients);
    double sum = 0;
    for (std::size_t j = 0; j < coefficients.size(); ++j) {
        for (std::uint32_t k = 0; k < transport.channel_count(); ++k) {
            sum += double{transport::kDeadZone} * double{transport.step(j, k)} *
                   std::abs(double{transport.manifest().colour.matrix[0][k]} *
                            double{coefficients[j]});
        }
    }
    const auto tint = transport.tint();
    return sum * double{*std::max_element(tint.begin(), tint.end())};
}

RelitImage picture(const test::LinearImage& linear) {
    RelitImage image{linear.width, linear.height, {}};
    for (const auto& pixel : linear.pixels) {
        for (int c = 0; c < 3; ++c) {
            image.rgb.push_back(static_cast<float>(pixel[c]));
        }
    }
    return image;
}

Outcome provoke(Workbench& workbench) {
    const scene::Scene scene = mirror_ball();
    bake::BakeParameters parameters;
    parameters.width = 32;
    parameters.height = 32;
    parameters.face_resolution = 16;
    parameters.bounces = 0;
    const test::ScratchDirectory scratch;
    const auto directory = scratch.path() / "mirror-ball.relume";
    bake::bake(scene, parameters, directory);
    const auto transport = transport::Transport::open(directory);
    workbench.progress("highlight_columns", 0.2);

    // One texel of light beyond the ball, above.
    Light light(transport->column_count(), Imath::V3f(0));
    const std::uint32_t n = parameters.face_resolution;
    const auto texel = basis::texel_from_direction(n, Imath::V3f(0.1F, 0.8F, -0.4F));
    light[basis::index_from_texel(n, texel)] = Imath::V3f(1000);

    const test::LinearImage exact = test::relit_from_rows(scene, parameters, light);
    const test::LinearImage stored = test::dense_product(*transport, light);
    const test::LinearImage ng03 = by_column_range(scene, parameters, light);
    const Matte matte(exact);
    double squares = 0;
    for (std::size_t p = 0; p < exact.pixels.size(); ++p) {
        squares += std::pow(stored.pixels[p].x - exact.pixels[p].x, 2);
    }
    const double rms = std::sqrt(squares / static_cast<double>(exact.pixels.size()));

    Outcome outcome;
    const double ng03_error = matte.relative_error(ng03, exact);
    outcome.findings = {
        {"brightest pixel over the RMS of the matte ones", Sense::at_least, kLevels / 2,
         matte.brightest / matte.rms,
         "half of 8 bits: the matte pixels lie within a step or two"},
        {"8 bits over each column's range: relative error of the matte pixels", Sense::at_least,
         0.02, ng03_error, "more than the eye lets pass: the highlight takes the range"},
        {"as stored: the same", Sense::at_most, ng03_error, matte.relative_error(stored, exact),
         "measured beside it: no worse than [Ng03]"},
        {"as stored: RMS error of the image, of Σ zone·step·|L|", Sense::at_most, 1,
         rms / storage_bound(*transport, light),
         "a value is off by the dead zone at most, whatever the largest in its column"},
    };
    const float exposure = static_cast<float>(-std::log2(3 * matte.rms));
    const auto tile = [&](const test::LinearImage& image, const std::string& name) {
        return Tile{picture(image), name, exposure};
    };
    outcome.tiles = {tile(exact, "before storing"),
                     tile(ng03, fmt::format("column's range: {:.3f} off", ng03_error)),
                     tile(stored, fmt::format("as stored: {:.3f} off",
                                              matte.relative_error(stored, exact)))};
    return outcome;
}

}  // namespace

Failure highlight_columns() {
    return {.name = "highlight_columns",
            .what = "one huge entry of a column takes the precision from all others",
            .scene =
                "a mirror-like ball (GGX, roughness 0.06) on a matte floor, 32x32, n = 16, "
                "one texel lit",
            .provoke = provoke};
}

}  // namespace relume::stability
