// A sun in an empty sky, in spherical harmonics: it becomes a lobe with rings around it, every
// other one of them negative.
#include "protocol/basis/cubemap.h"
#include "tests/stability/harmonic_kernel.h"
#include "tests/stability/provocations.h"
#include "tests/stability/relighter.h"
#include "tests/stability/test_light.h"
#include "tests/support/dense_product.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace relume::stability {
namespace {

constexpr std::array<std::uint32_t, 3> kOrders{5, 10, 20};
constexpr float kSunRadiusDegrees = 1;
constexpr float kSunRadiance = 1000;

double mean_of(std::span<const float> values) {
    double sum = 0;
    for (const float value : values) {
        sum += double{value};
    }
    return sum / static_cast<double>(values.size());
}

double part_below(double limit, std::span<const float> values) {
    const auto below = std::count_if(values.begin(), values.end(),
                                     [&](float value) { return double{value} < limit; });
    return static_cast<double>(below) / static_cast<double>(values.size());
}

// ∫ max(−L, 0) dω of one colour; the lights here are grey.
double energy_below_zero(const light::LightCubemap& light) {
    const auto plane = light.planes()[0];
    double energy = 0;
    for (std::size_t i = 0; i < plane.size(); ++i) {
        const auto texel = basis::texel_from_index(light.face_resolution, i);
        energy += double{std::max(-plane[i], 0.0F)} *
                  double{basis::solid_angle_sr(light.face_resolution, texel.row, texel.column)};
    }
    return energy;
}

// The least and the most over some suns.
class Range {
  public:
    void add(double value) {
        least_ = any_ ? std::min(least_, value) : value;
        most_ = any_ ? std::max(most_, value) : value;
        any_ = true;
    }
    [[nodiscard]] double least() const { return least_; }
    [[nodiscard]] double most() const { return most_; }

  private:
    bool any_ = false;
    double least_ = 0;
    double most_ = 0;
};

struct Ringing {
    Range texels_below_zero;  // of all
    Range energy_below_zero;  // of the sun's
    Range lowest;             // of what K allows
    Range highest;            // the same
    Range energy_off;         // relative
    Range values_below_zero;  // of the image's, by more than 2 % of its mean
    Range lowest_value;       // of what K allows
    Range error;              // of the image, relative L2
    double overshoot = 0;     // of a wide light, over its radiance
};

// The lowest value of the image, of what the kernel allows: by so much at most can every
// direction be below zero, so that a pixel loses at most that times what it shows under a sky
// of radiance 1. To that comes what storing it lost, 1 % of the mean.
double lowest_value(const RelitImage& image,
                    const RelitImage& white_sky,
                    double lowest_radiance) {
    constexpr double kStorage = 0.01;
    const double storage = kStorage * mean_of(white_sky.rgb);
    double lowest = 0;
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        const double allowed = lowest_radiance * (double{white_sky.rgb[i]} + storage);
        lowest = std::max(lowest, double{image.rgb[i]} / allowed);
    }
    return lowest;
}

void add(const Relit& relit,
         const RelitImage& white_sky,
         const RelitImage& exact,
         const light::LightCubemap& sun,
         const HarmonicKernel& kernel,
         Ringing& ringing) {
    constexpr double kPlain = 0.02;  // storing loses less
    const double energy = light::total_energy(sun).x;
    const auto [lowest, highest] =
        std::minmax_element(relit.light.radiance.begin(), relit.light.radiance.end());
    ringing.texels_below_zero.add(part_below(0, relit.light.radiance));
    ringing.energy_below_zero.add(energy_below_zero(relit.light) / energy);
    ringing.lowest.add(double{*lowest} / (energy * kernel.lowest()));
    ringing.highest.add(double{*highest} / (energy * kernel.highest()));
    ringing.energy_off.add(std::abs(light::total_energy(relit.light).x / energy - 1));
    ringing.values_below_zero.add(part_below(-kPlain * mean_of(exact.rgb), relit.image.rgb));
    ringing.lowest_value.add(lowest_value(relit.image, white_sky, energy * kernel.lowest()));
    ringing.error.add(distance(relit.image, exact) / norm(exact));
}

void add_findings(std::uint32_t order,
                  const Ringing& ringing,
                  const HarmonicKernel& kernel,
                  std::vector<Finding>& findings) {
    const std::string name = fmt::format("SH-{}", order);
    constexpr const char* kMean =
        "the light shown is a mean of the kernel K, weighted by energies above zero";
    const double most_below_zero = (kernel.l1() - 1) / 2;
    const std::vector<Finding> more{
        {name + ": texels below zero, of all", Sense::at_least, 0.25,
         ringing.texels_below_zero.least(), "of a sky that is black but for the sun"},
        {name + ": energy below zero, of the sun's, the least", Sense::at_least, 0.5,
         ringing.energy_below_zero.least(), "half a sun taken from a black sky"},
        {name + ": the same, the most", Sense::at_most, most_below_zero,
         ringing.energy_below_zero.most(), "(∫|K| − 1)/2, by the triangle inequality"},
        {name + ": lowest radiance, of the kernel's", Sense::at_most, 1, ringing.lowest.most(),
         kMean},
        {name + ": highest radiance, of the kernel's k²/4π", Sense::at_most, 1,
         ringing.highest.most(), kMean},
        {name + ": energy off, relative", Sense::at_most, 1e-5, ringing.energy_off.most(),
         "no function but the constant one has an integral; float"},
        {name + ": image values below −2 % of the mean, of all", Sense::at_least, 1e-3,
         ringing.values_below_zero.least(),
         "nothing is darker than black; the quantiser alone does not get there"},
        {name + ": lowest image value, of what the kernel allows", Sense::at_most, 1,
         ringing.lowest_value.most(),
         "its lowest radiance from everywhere; 1 % for the stored transport"},
        {name + ": image off, relative L2", Sense::at_least, 0.05, ringing.error.least(),
         "plain to see: shadows and highlights are as wide as the lobe"},
        {name + ": a light of 70 degrees, above its radiance", Sense::at_least, 0.05,
         ringing.overshoot, "Gibbs: a hard edge, and no order ends it"},
        {name + ": the same", Sense::at_most, most_below_zero, ringing.overshoot,
         "(∫|K| − 1)/2: all of K that is above zero, and radiance 1"},
    };
    findings.insert(findings.end(), more.begin(), more.end());
}

// A light as wide as a third of the sky: how far its own radiance is passed.
double overshoot(Relighter& relighter, std::uint32_t n) {
    light::LightCubemap light(n);
    light::add_area_light({.direction = direction_from_degrees(0, 60),
                           .angular_radius_radians = radians_from_degrees(70),
                           .radiance = Imath::V3f(1)},
                          light);
    const Relit relit = relighter.relit(light);
    return double{*std::max_element(relit.light.radiance.begin(), relit.light.radiance.end())} -
           1;
}

// The image at the full order against the stored transport times the light, in double.
double product_error(Relighter& relighter,
                     const transport::Transport& transport,
                     const light::LightCubemap& sun) {
    std::vector<Imath::V3f> texels;
    for (std::size_t i = 0; i < sun.plane_size(); ++i) {
        texels.emplace_back(sun.planes()[0][i], sun.planes()[1][i], sun.planes()[2][i]);
    }
    const test::LinearImage exact = test::dense_product(transport, texels);
    RelitImage image{exact.width, exact.height, {}};
    for (const auto& pixel : exact.pixels) {
        for (int c = 0; c < 3; ++c) {
            image.rgb.push_back(static_cast<float>(pixel[c]));
        }
    }
    return distance(relighter.relit(sun).image, image) / norm(image);
}

RelitImage below_zero(const RelitImage& image) {
    RelitImage negative = image;
    for (float& value : negative.rgb) {
        value = std::max(-value, 0.0F);
    }
    return negative;
}

// Around the table, at 25 to 70 degrees above the horizon.
std::vector<light::LightCubemap> suns_around(std::uint32_t n, int places) {
    std::vector<light::LightCubemap> suns;
    for (int i = 0; i < places; ++i) {
        const float turn = static_cast<float>(i) / static_cast<float>(places);
        suns.emplace_back(n);
        light::add_area_light(
            {.direction = direction_from_degrees(20 + 360 * turn, 25 + 45 * turn),
             .angular_radius_radians = radians_from_degrees(kSunRadiusDegrees),
             .radiance = Imath::V3f(kSunRadiance)},
            suns.back());
    }
    return suns;
}

// As many wavelets as there are functions in each order, whose image errors are given. A sun
// has 61 on a face at most: of each of five sizes of square it touches four, which have three
// each, and the mean. Where there are fewer to take, what is missing rings as well, in squares.
void add_wavelets(const lab::LabScene& scene,
                  std::span<const light::LightCubemap> suns,
                  std::span<const RelitImage> exact,
                  const std::array<double, kOrders.size()>& errors_of_orders,
                  std::vector<Finding>& findings) {
    for (std::size_t k = 0; k < kOrders.size(); ++k) {
        constexpr std::uint32_t kAllOfASun = 61;
        const std::uint32_t terms = kOrders[k] * kOrders[k];
        Relighter relighter(scene, fmt::format("nwa-{}-area", terms));
        Range error;
        Range below_zero;
        for (std::size_t i = 0; i < suns.size(); ++i) {
            const Relit relit = relighter.relit(suns[i]);
            error.add(distance(relit.image, exact[i]) / norm(exact[i]));
            below_zero.add(energy_below_zero(relit.light) / light::total_energy(suns[i]).x);
        }
        const Sense sense = terms < kAllOfASun ? Sense::reported : Sense::at_most;
        const std::string name = fmt::format("NWA-{}", terms);
        findings.push_back({name + ": energy below zero, of the sun's, the most", sense, 1e-5,
                            below_zero.most(), "all of the sun's wavelets: float"});
        findings.push_back({name + ": image off, relative L2", sense, 1e-5, error.most(),
                            fmt::format("the same; SH-{} has as many terms and is off by "
                                        "{:.2g} at least",
                                        kOrders[k], errors_of_orders[k])});
    }
}

Outcome provoke(Workbench& workbench) {
    const auto haar = workbench.baked("table");
    const auto harmonics = workbench.baked("table", {.sh_order = kOrders.back()});
    const lab::LabScene scene{.haar = haar, .sh_transport = harmonics->transport().directory()};
    const std::uint32_t n = haar->face_resolution();
    const auto suns = suns_around(n, workbench.choose(3, 60));
    std::vector<Lighting> lightings;
    for (const light::LightCubemap& sun : suns) {
        lightings.push_back(lighting_from_cubemap(sun));
    }
    const auto exact = exact_images(haar, lightings);
    workbench.progress("sh_ringing", 0.3);

    Outcome outcome;
    const float exposure = exposure_for(exact[0]);
    outcome.tiles = {{exact[0], "exact", exposure}};
    std::vector<Tile> negative;
    std::array<double, kOrders.size()> errors{};
    for (std::size_t k = 0; k < kOrders.size(); ++k) {
        const std::uint32_t order = kOrders[k];
        const HarmonicKernel kernel(order);
        const std::string method = fmt::format("sh-{}", order);
        Relighter relighter(scene, method);
        const RelitImage white_sky = relighter.relit(constant_sky(n, 1)).image;
        Ringing ringing;
        for (std::size_t i = 0; i < suns.size(); ++i) {
            const Relit relit = relighter.relit(suns[i]);
            add(relit, white_sky, exact[i], suns[i], kernel, ringing);
            if (i == 0) {
                constexpr float kStops = 2;
                outcome.tiles.push_back({relit.image, method, exposure});
                negative.push_back(
                    {below_zero(relit.image), method + ": below zero, 4x", exposure + kStops});
            }
        }
        ringing.overshoot = overshoot(relighter, n);
        add_findings(order, ringing, kernel, outcome.findings);
        errors[k] = ringing.error.least();
        workbench.progress("sh_ringing", 0.3 + 0.03 * order);
    }
    Relighter full_order(scene, fmt::format("sh-{}", kOrders.back()));
    outcome.findings.push_back({"SH-20: image off the dense product, relative L2",
                                Sense::at_most, 1e-5,
                                product_error(full_order, harmonics->transport(), suns[0]),
                                "all columns there are, summed in float"});
    add_wavelets(scene, suns, exact, errors, outcome.findings);
    outcome.tiles.insert(outcome.tiles.end(), negative.begin(), negative.end());
    return outcome;
}

}  // namespace

Failure sh_ringing() {
    return {.name = "sh_ringing",
            .what = "light rings around suns and is negative in every other ring",
            .scene = "table, 96x72, n = 32, direct light; a sun of 1 degree in an empty sky",
            .provoke = provoke};
}

}  // namespace relume::stability
