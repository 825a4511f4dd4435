// Wavelets against spherical harmonics.
#include "protocol/light/light_rig.h"
#include "tests/lab/claims/claim.h"
#include "tests/lab/sequences/environment_source.h"

#include <fmt/format.h>

#include <algorithm>

namespace relume::lab {
namespace {

// A light that stands still, with ever more terms of both.
struct TermsOfLight {
    std::string light;
    std::vector<Record> harmonics;
    std::vector<Record> wavelets;  // by area, ascending
};

TermsOfLight sweep(Evidence& evidence, const LabScene& scene, const std::string& light) {
    std::vector<TermsCurve> curves = evidence.terms(scene, light, {"sh-{}", "nwa-{}-area"});
    return {.light = light,
            .harmonics = std::move(curves[0].records),
            .wavelets = std::move(curves[1].records)};
}

// Terms of spherical harmonics over the wavelet terms that err no more from there on, by the
// L2 norm of the image.
double terms_ratio(const TermsOfLight& terms, const Record& harmonics) {
    const auto worse = std::find_if(
        terms.wavelets.rbegin(), terms.wavelets.rend(),
        [&](const Record& record) { return record.error.l2 > harmonics.error.l2; });
    const Record& enough = worse == terms.wavelets.rbegin() ? terms.wavelets.back()
                           : worse == terms.wavelets.rend() ? terms.wavelets.front()
                                                            : *(worse.base());
    return static_cast<double>(harmonics.applied) / enough.applied;
}

const Record& of_order(const TermsOfLight& terms, std::uint32_t order) {
    const std::string label = fmt::format("sh-{}", order);
    return *std::find_if(terms.harmonics.begin(), terms.harmonics.end(),
                         [&](const Record& record) { return record.method == label; });
}

std::string figures(const std::vector<TermsOfLight>& lights,
                    const std::vector<std::uint32_t>& orders) {
    std::string text;
    for (const TermsOfLight& terms : lights) {
        for (const std::uint32_t order : orders) {
            const Record& record = of_order(terms, order);
            text += fmt::format("{}{}, SH-{} ({} terms, L2 {:.3g}): {:.2g}",
                                text.empty() ? "" : "; ", terms.light, order, record.applied,
                                record.error.l2, terms_ratio(terms, record));
        }
    }
    return text;
}

Claim all_frequency_claim(Evidence& evidence, const LabScene& scene) {
    std::vector<TermsOfLight> lights;
    for (const char* light : {"studio", "night", "bare-sun"}) {
        lights.push_back(sweep(evidence, scene, light));
    }
    const bool holds = std::all_of(lights.begin(), lights.end(), [](const TermsOfLight& terms) {
        return terms_ratio(terms, of_order(terms, 18)) >= 10;
    });
    return {
        .claim =
            "Under all-frequency light wavelets need one to two orders of magnitude "
            "fewer terms than SH at equal error: ratio at SH-18 ≥ 10",
        .source = "[Ng03 §4.1.2]",
        .measure = "L2 of the image",
        .found = "terms of SH over terms of NWA by area, table: " + figures(lights, {8, 18}),
        .beside = "",
        .holds = holds,
        .why = holds ? ""
                     : "The first light of the sequence alone; where the map is lit by "
                       "lamps wider than a texel, 300 SH terms see some of their edges. The "
                       "ratio grows with the order: wavelets converge and SH hardly do."};
}

Claim low_frequency_claim(Evidence& evidence, const LabScene& scene) {
    const std::vector<TermsOfLight> lights{sweep(evidence, scene, "sky-overcast")};
    const double ratio = terms_ratio(lights[0], of_order(lights[0], 3));
    const bool holds = ratio >= 0.5 && ratio <= 2;
    return {
        .claim =
            "Under low-frequency light both need about as many terms: ratio at SH-3 "
            "within a factor of two of 1",
        .source = "[Ng03 §4.1.2]",
        .measure = "L2 of the image",
        .found = "terms of SH over terms of NWA by area, table: " + figures(lights, {2, 3, 5}),
        .beside = "",
        .holds = holds,
        .why = holds ? ""
                     : "An overcast sky is a polynomial of low degree, but for the horizon; "
                       "six faces of Haar functions have first to find each other's level, "
                       "and steps approach a slope slowly."};
}

// How far below black the light and the image go.
struct Undershoot {
    double lowest_radiance = 0;  // over the largest of the light asked for
    double negative_sphere = 0;  // part of the sphere, mean of the colours
    double negative_image = 0;   // part of the values of covered pixels
    double lowest_pixel = 0;     // over the mean of the image
};

Undershoot undershoot(const LabScene& scene, const std::string& method) {
    const std::uint32_t n = scene.haar->face_resolution();
    light::LightRig rig;
    rig.environment = load_environment("bare-sun", n);
    light::LightCubemap target(n);
    light::evaluate(rig, n, target);
    std::vector<float> haar;
    light::lighting_coefficients(target, scene.haar->projection(), haar);
    const auto contestant = method_from_text(method).enter(scene);
    contestant->set_light({.radiance = target, .haar = haar});
    (void)contestant->step();
    light::LightCubemap shown;
    contestant->write_radiance(shown);
    const transport::TileGrid& image = scene.haar->image();
    std::vector<float> rgb(std::size_t{3} * image.width * image.height);
    contestant->write_image(rgb);

    const auto negative_part = [](const std::vector<float>& values) {
        const auto is_lit = [](float value) { return value != 0; };
        const auto is_negative = [](float value) { return value < 0; };
        return static_cast<double>(std::count_if(values.begin(), values.end(), is_negative)) /
               static_cast<double>(std::count_if(values.begin(), values.end(), is_lit));
    };
    double sum = 0;
    for (const float value : rgb) {
        sum += double{value};
    }
    const double mean = sum / static_cast<double>(rgb.size());
    return {.lowest_radiance =
                double{*std::min_element(shown.radiance.begin(), shown.radiance.end())} /
                double{*std::max_element(target.radiance.begin(), target.radiance.end())},
            .negative_sphere = negative_part(shown.radiance),
            .negative_image = negative_part(rgb),
            .lowest_pixel = double{*std::min_element(rgb.begin(), rgb.end())} / mean};
}

Claim ringing_claim(const LabScene& scene) {
    std::string found;
    bool holds = true;
    for (const char* method : {"sh-5", "sh-10", "sh-20", "nwa-100-area"}) {
        const Undershoot below = undershoot(scene, method);
        found += fmt::format(
            "{}{}: {:.0f} % of texels negative, down to {:.2g} of the sun; "
            "{:.2g} % of image values negative, down to {:.2g} of the mean",
            found.empty() ? "" : "; ", method, 100 * below.negative_sphere,
            below.lowest_radiance, 100 * below.negative_image, below.lowest_pixel);
        holds = holds && (below.negative_sphere > 0.1) == (method[0] == 's');
    }
    return {.claim =
                "SH ring around a bare sun: over 10 % of the texels are negative, with 100 "
                "wavelet terms they are not",
            .source = "[Ng03 §4.1.1]",
            .measure = "texels below zero",
            .found = "table, bare-sun: " + found,
            .beside = "",
            .holds = holds,
            .why = holds ? "" : "See the figures."};
}

}  // namespace

std::vector<Claim> sh_claims(Evidence& evidence) {
    const LabScene scene = evidence.scene_in_both_bases("table");
    return {all_frequency_claim(evidence, scene), low_frequency_claim(evidence, scene),
            ringing_claim(scene)};
}

}  // namespace relume::lab
