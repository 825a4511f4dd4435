#include "precompute/scene/builtin/furniture.h"
#include "precompute/scene/builtin/noise.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace relume::scene {
namespace {

constexpr float kTwoPi = 2.0F * std::numbers::pi_v<float>;
constexpr float kSoil = 0.135F;

struct Leaf {
    Imath::V3f base;
    Imath::V3f along;  // unit, from base to tip
    Imath::V3f up;     // unit, the upper side
    float length;
    float width;
    float droop;  // how far the tip bends down, in lengths
};

void add_leaf(MeshBuilder& mesh, const Leaf& leaf) {
    constexpr std::uint32_t kRows = 7;
    constexpr std::uint32_t kColumns = 5;
    const Imath::V3f across = leaf.along.cross(leaf.up).normalized();
    const Imath::V3f up = across.cross(leaf.along);
    mesh.add_grid(
        kRows, kColumns, Closing::open, Closing::open, [&](std::uint32_t i, std::uint32_t j) {
            const float t = static_cast<float>(i) / (kRows - 1);
            const float s = 2.0F * static_cast<float>(j) / (kColumns - 1) - 1.0F;
            // Widest a third of the way, pointed at the tip.
            const float half =
                0.5F * leaf.width *
                std::sin(std::numbers::pi_v<float> * std::pow(0.03F + 0.96F * t, 0.72F));
            const float fold = 0.35F * std::abs(s) * half;
            const float bend = leaf.droop * leaf.length * t * t;
            return leaf.base + leaf.along * (leaf.length * t) + across * (s * half) +
                   up * fold - Imath::V3f(0, bend, 0);
        });
}

}  // namespace

void add_plant(const Foliage& foliage, std::uint64_t seed) {
    constexpr int kStems = 26;
    constexpr int kSteps = 12;
    Random random(seed);
    std::size_t shade = 0;
    for (int stem = 0; stem < kStems; ++stem) {
        // Golden-angle spread; inner stems stand upright, outer ones lean and bend.
        const float outward = std::sqrt((static_cast<float>(stem) + 0.5F) / kStems);
        const float azimuth =
            2.399963F * static_cast<float>(stem) + random.uniform(-0.3F, 0.3F);
        const Imath::V3f side(std::cos(azimuth), 0, std::sin(azimuth));
        const float length = random.uniform(0.26F, 0.42F) * (1.1F - 0.35F * outward);
        const float lean = outward * random.uniform(0.7F, 1.15F);
        std::vector<TubePoint> axis;
        Imath::V3f place = Imath::V3f(0, kSoil, 0) + side * (0.055F * outward);
        for (int i = 0; i <= kSteps; ++i) {
            const float t = static_cast<float>(i) / kSteps;
            axis.push_back({place, 0.0028F * (1.0F - 0.7F * t)});
            const float tilt = lean * (0.35F + 0.95F * t);
            place +=
                (side * std::sin(tilt) + Imath::V3f(0, std::cos(tilt), 0)) * (length / kSteps);
        }
        foliage.stems.add_tube(axis, 7, Closing::open);
        for (int i = 3; i <= kSteps; ++i) {
            const Imath::V3f& base = axis[static_cast<std::size_t>(i)].centre;
            const Imath::V3f stem_along =
                (base - axis[static_cast<std::size_t>(i) - 1].centre).normalized();
            // Two leaves at each knot, turned by about 137° from knot to knot; one at the tip.
            const int leaves = i == kSteps ? 1 : 2;
            for (int k = 0; k < leaves; ++k) {
                const float turn = 2.399963F * static_cast<float>(i) +
                                   std::numbers::pi_v<float> * static_cast<float>(k) +
                                   random.uniform(-0.4F, 0.4F);
                const Imath::V3f radial(std::cos(turn), 0, std::sin(turn));
                const float rise = random.uniform(0.15F, 0.6F);
                Imath::V3f along = (radial + stem_along * rise).normalized();
                if (i == kSteps)
                    along = (stem_along + radial * 0.4F).normalized();
                const float size =
                    random.uniform(0.75F, 1.15F) *
                    (0.7F + 0.5F * std::sin(kTwoPi * 0.5F * static_cast<float>(i) / kSteps));
                add_leaf(*foliage.leaves[shade % foliage.leaves.size()],
                         {.base = base,
                          .along = along,
                          .up = {0, 1, 0},
                          .length = 0.078F * size,
                          .width = 0.034F * size,
                          .droop = random.uniform(0.1F, 0.35F)});
                shade += random.uniform(0, 1) < 0.6F ? 1U : 2U;
            }
        }
    }
}

}  // namespace relume::scene
