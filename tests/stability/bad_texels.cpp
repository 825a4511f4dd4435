// Environment files as they are found: negatives in Debian's CC0 maps, and files made to hold
// whatever a float can.
#include "protocol/light/environment_error.h"
#include "protocol/light/environment_import.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"
#include "tests/unit/light/image_files.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace relume::stability {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::size_t count_not_finite(std::span<const float> values) {
    return static_cast<std::size_t>(std::count_if(
        values.begin(), values.end(), [](float value) { return !std::isfinite(value); }));
}

light::MapImage read_raw(const std::filesystem::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) {
        throw std::runtime_error(OIIO::geterror());
    }
    const OIIO::ImageSpec& spec = input->spec();
    light::MapImage image{
        static_cast<std::uint32_t>(spec.width), static_cast<std::uint32_t>(spec.height), {}};
    image.rgb.resize(std::size_t{3} * image.width * image.height);
    if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, image.rgb.data())) {
        throw std::runtime_error(input->geterror());
    }
    return image;
}

// ∫ |negative part| dω and ∫ L dω of a lat-long map, green.
struct Energy {
    double negative = 0;
    double total = 0;
};
Energy energy_of(const light::MapImage& image) {
    Energy energy;
    const double height = image.height;
    for (std::size_t i = 1; i < image.rgb.size(); i += 3) {
        const double row = static_cast<double>(i / 3 / image.width);
        const double weight = (std::cos(std::numbers::pi * row / height) -
                               std::cos(std::numbers::pi * (row + 1) / height)) *
                              2 * std::numbers::pi / image.width;
        energy.total += weight * double{image.rgb[i]};
        energy.negative += weight * std::max(0.0, -double{image.rgb[i]});
    }
    return energy;
}

struct RealMaps {
    double negatives = 0;      // texels below zero, in all files
    double lowest = 0;         // of all values imported; 0 or more is sound
    double not_finite = 0;     // imported values
    double energy_gained = 0;  // by import, of the energy that negatives took; of all maps
};

RealMaps import_real_maps() {
    RealMaps found;
    Energy raw_sum;
    double imported_sum = 0;
    found.lowest = 1;
    for (const auto& entry : std::filesystem::directory_iterator(RELUME_STUDIO_LIGHTS)) {
        if (entry.path().extension() != ".exr") {
            continue;
        }
        const light::MapImage raw = read_raw(entry.path());
        const Energy energy = energy_of(raw);
        raw_sum.negative += energy.negative;
        raw_sum.total += energy.total;
        found.negatives += static_cast<double>(
            std::count_if(raw.rgb.begin(), raw.rgb.end(), [](float v) { return v < 0; }));
        const light::ImportedEnvironment imported = light::import_environment(entry.path());
        const auto& rgb = imported.map.levels().front().rgb;
        imported_sum += energy_of({raw.width, raw.height, rgb}).total;
        found.lowest =
            std::min(found.lowest, double{*std::min_element(rgb.begin(), rgb.end())});
        found.not_finite += static_cast<double>(count_not_finite(rgb));
    }
    found.energy_gained = (imported_sum - raw_sum.total) / raw_sum.negative;
    return found;
}

// Grey, and in one texel of a hundred what no lighting may hold.
light::MapImage hostile_map() {
    constexpr std::uint32_t kHeight = 32;
    light::MapImage image{2 * kHeight, kHeight,
                          std::vector<float>(std::size_t{6} * kHeight * kHeight, 1)};
    const float values[] = {kNan, kInfinity, -kInfinity, -1e30F, 3e38F, -0.0F, 1e-45F};
    std::size_t at = 100;
    for (const float value : values) {
        image.rgb[at] = value;
        at += 400;
    }
    return image;
}

bool is_refused(const light::MapImage& image) {
    try {
        (void)light::import_environment(light::testing::encode_rgb("openexr", image));
    } catch (const light::EnvironmentError&) {
        return true;
    }
    return false;
}

Outcome provoke(Workbench& workbench) {
    const auto scene = workbench.baked("table", {.face_resolution = 16});
    const std::uint32_t n = scene->face_resolution();
    const RealMaps real = import_real_maps();
    workbench.progress("bad_texels", 0.7);

    // Unrepaired, one NaN among the texels.
    light::LightCubemap broken = constant_sky(n, 1);
    broken.radiance[5] = kNan;
    const double lost = static_cast<double>(count_not_finite(lighting_from_cubemap(broken)));

    const light::MapImage hostile = hostile_map();
    const auto imported =
        light::import_environment(light::testing::encode_rgb("openexr", hostile));
    const auto environment = std::make_shared<const light::PrefilteredEnvironment>(
        std::make_shared<const light::EnvironmentMap>(imported.map), n);
    double image_not_finite = 0;
    std::vector<RelitImage> images;
    for (const float degrees : {0.0F, 33.0F, 181.0F}) {
        light::LightRig rig;
        rig.environment = environment;
        rig.rotation.setAxisAngle({0, 1, 0}, radians_from_degrees(degrees));
        const Lighting lighting = lighting_from_rig(rig, n);
        images.push_back(exact_images(scene, std::span(&lighting, 1)).front());
        image_not_finite += static_cast<double>(count_not_finite(images.back().rgb));
    }
    light::MapImage ruined = hostile;
    for (std::size_t i = 0; i < ruined.rgb.size(); i += 150) {
        ruined.rgb[i] = kNan;
    }

    Outcome outcome;
    outcome.findings = {
        {"Debian's CC0 maps: values below zero in the files", Sense::at_least, 1,
         real.negatives, "the files have the fault"},
        {"the same, imported: lowest value, negated", Sense::at_most, 0, -real.lowest,
         "negatives become 0"},
        {"the same: values not finite", Sense::at_most, 0, real.not_finite, "none may pass"},
        {"the same: energy gained by import, of what the negatives took", Sense::at_most, 1.001,
         real.energy_gained,
         "setting a negative to 0 gives back what it took, once; a thousandth for float sums"},
        {"one NaN texel unrepaired: coefficients lost", Sense::at_least, 1, lost,
         "a NaN spreads over all wavelets above it"},
        {"crafted EXR of NaN, ±∞, −1e30, 3e38 in few texels: image values not finite",
         Sense::at_most, 0, image_not_finite, "none may pass"},
        {"crafted EXR with NaN in 2 of 100 texels: accepted", Sense::at_most, 0,
         is_refused(ruined) ? 0.0 : 1.0, "more than one in a hundred is a broken file"},
    };
    const float exposure = exposure_for(images[0]);
    outcome.tiles = {
        {{hostile.width, hostile.height, hostile.rgb}, "crafted file", -1},
        {{hostile.width, hostile.height, imported.map.levels().front().rgb}, "imported", -1},
        {images[0], "under it", exposure},
        {images[1], "turned by 33 degrees", exposure}};
    return outcome;
}

}  // namespace

Failure bad_texels() {
    return {.name = "bad_texels",
            .what = "negative, NaN and infinite texels get into the image",
            .scene = "table, n = 16; Debian's CC0 maps and an EXR file made for the purpose",
            .provoke = provoke};
}

}  // namespace relume::stability
