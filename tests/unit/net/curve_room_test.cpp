// A room of a scene of curves: the image is that of the curves in its state, exact at rest.
#include "protocol/basis/daubechies4.h"
#include "protocol/transport/block_basis.h"
#include "protocol/wire/room_patch.h"
#include "server/net/rooms/curve_edits.h"
#include "server/net/rooms/relighter.h"
#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_curves.h"
#include "tests/unit/net/exact_picture.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;

class CurveRoom : public testing::Test {
  protected:
    CurveRoom() {
        test::write_tiny_curves(folder_.path() / "tiny.relume", {"pearl", "post"});
        scenes_.refresh(folder_.path());
        scene_ = scenes_.find("tiny");
        relighter_.emplace(scene_, metrics_, std::chrono::seconds(1));
        state_.background.mode = wire::BackgroundMode::transparent;
        show(kAllStages);
    }

    void show(wire::Stages stages) {
        EXPECT_TRUE(relighter_->set_state(state_, {}, {}, stages).empty());
    }
    void edit(const json& materials) {
        const json patch = with_samples({{"materials", materials}}, state_.materials,
                                        scene_->loaded->curves());
        wire::apply_patch(state_, patch, {});
        show(wire::stages_of(patch));
    }
    void rest() {
        Relighter* const self = &*relighter_;
        while (!self->at_rest()) {
            Relighter::advance_together({&self, 1});
        }
    }
    // With the method alone, from an exact image.
    void take_thirty_terms_an_image() {
        state_.strategy.method = relighting::Method::bi;
        state_.budget = {.milliseconds = {}, .coefficients = 30, .target_error = 0};
        show(kAllStages);
        rest();
    }
    // Takes the terms of one image; of several calls that do a part of it, the last is true.
    bool advance() {
        Relighter* const self = &*relighter_;
        Relighter::advance_together({&self, 1});
        return self->step_is_complete();
    }
    // Until no term is off. The image after it, the same made from nothing, is not counted.
    int images_until_exact() {
        int images = 0;
        while (!relighter_->at_rest() && images < 20) {
            images += advance() ? 1 : 0;
        }
        return images - 1;
    }
    std::vector<std::uint16_t> picture() { return exact_picture(*relighter_); }
    // The signal by its definition in the contract.
    [[nodiscard]] std::vector<float> signal() const {
        const auto curves = scene_->loaded->curves();
        const std::size_t count = 1 + 257 * curves.size();
        std::vector<float> signal(3 * count, 0);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            float* plane = &signal[channel * count];
            plane[0] = 1;
            for (std::size_t m = 0; m < curves.size(); ++m) {
                std::array<float, 256> samples = curves[m].baked[channel];
                double diffuse = 1;
                if (const auto found = state_.materials.find(curves[m].id);
                    found != state_.materials.end()) {
                    for (std::size_t k = 0; k < 256; ++k) {
                        samples[k] =
                            static_cast<float>(found->second.samples.numbers[3 * k + channel] *
                                               found->second.tint[static_cast<int>(channel)]);
                    }
                    diffuse = found->second.diffuse[static_cast<int>(channel)];
                }
                plane[1 + 257 * m] = static_cast<float>(diffuse);
                basis::daubechies4_forward(samples,
                                           std::span<float, 256>(plane + 2 + 257 * m, 256));
            }
        }
        return signal;
    }
    void expect_image_is_that_of_the_state() {
        rest();
        std::vector<double> sums = test::dense_product(scene_->loaded->transport(), signal());
        test::receivers_from_sums(sums);
        const transport::TileGrid image = scene_->loaded->image();
        const std::vector<std::uint16_t> bits = picture();
        double error = 0;
        double norm = 0;
        const std::size_t plane = std::size_t{image.width} * image.height;
        for (std::uint32_t y = 0; y < image.height; ++y) {
            for (std::uint32_t x = 0; x < image.width; ++x) {
                const auto [block, slot] = image.place_from_pixel(x, y);
                for (std::size_t c = 0; c < 3; ++c) {
                    const std::size_t at = (std::size_t{block} * 3 + c) * 256 + slot;
                    const double expected =
                        sums[at] * double{scene_->loaded->transport().tint()[at]};
                    half shown;
                    shown.setBits(bits[c * plane + std::size_t{y} * image.width + x]);
                    const double found = std::max<double>(shown, -1e9);
                    error += (found - expected) * (found - expected);
                    norm += expected * expected;
                }
            }
        }
        EXPECT_LT(std::sqrt(error / norm), 1e-3);  // half floats
    }

    test::ScratchDirectory folder_;
    SceneLibrary scenes_;
    Metrics metrics_;
    std::shared_ptr<const ServedScene> scene_;
    std::optional<Relighter> relighter_;
    wire::RoomState state_;
};

TEST_F(CurveRoom, ShowsTheMaterialsAsBakedAndAsEdited) {
    expect_image_is_that_of_the_state();
    edit({{"pearl", {{"roughness", 0.03}}}});
    expect_image_is_that_of_the_state();
    edit({{"post", {{"points", {{0, 9, 7, 1}, {1, 0, 0, 0}}}, {"diffuse", {0.5, 1, 2}}}}});
    expect_image_is_that_of_the_state();
}

TEST_F(CurveRoom, AnEditTakenBackGivesTheBitsFromBefore) {
    rest();
    const std::vector<std::uint16_t> before = picture();
    edit({{"pearl", {{"preset", "satin"}, {"tint", {1, 0.2, 0.1}}}}});
    rest();
    EXPECT_NE(picture(), before);
    edit({{"pearl", nullptr}});
    rest();
    EXPECT_EQ(picture(), before);
}

// What a person may make of the whole curve, and of the diffuse colour with it.
json any_change(std::mt19937_64& random) {
    std::uniform_real_distribution<double> value(0, 1);
    const auto samples = [&](auto&& sample) {
        json list = json::array();
        for (int k = 0; k < 256; ++k) {
            list.push_back(sample(k));
        }
        return json{{"samples", list}};
    };
    json change;
    switch (random() % 6) {
        case 0:  // jagged, of any size
            change = samples([&, size = std::pow(10, 8 * value(random) - 4)](int) -> json {
                return {size * value(random), size * value(random), size * value(random)};
            });
            break;
        case 1:  // nothing at all
            change = samples([](int) -> json { return {0, 0, 0}; });
            break;
        case 2:  // a jump
            change = samples([step = static_cast<int>(random() % 256)](int k) -> json {
                return k < step ? json{0, 0, 0} : json{3, 3, 3};
            });
            break;
        case 3:  // a peak of one sample
            change = samples([peak = static_cast<int>(random() % 256)](int k) -> json {
                return k == peak ? json{1e4, 1e4, 1e4} : json{0, 0, 0};
            });
            break;
        case 4:
            change = {{"shape", "ggx"}, {"roughness", 0.02 + 0.9 * value(random)}};
            break;
        default:
            change = {{"points", {{0, 9 * value(random), 1, 1}, {1, 0, 0, value(random)}}}};
    }
    change["diffuse"] = {value(random), value(random), value(random)};
    return change;
}

// Thirty terms an image reach every one of 257 in nine: those of a curve, and the diffuse
// colour.
TEST_F(CurveRoom, IsExactWithinNineImagesOfThirtyTermsFromAnyChangeOfACurve) {
    take_thirty_terms_an_image();
    std::mt19937_64 random(7);
    for (int change = 0; change < 60; ++change) {
        edit({{"pearl", any_change(random)}});
        if (change % 3 == 0) {  // the next one comes before this one is shown
            advance();
            edit({{"pearl", any_change(random)}});
        }
        EXPECT_LE(images_until_exact(), 9) << change;
    }
}

// A stroke over at most 38 samples changes at most 60 terms: at each level, of wavelets of four
// taps, half of those of the level below and two more.
TEST_F(CurveRoom, IsExactWithinTwoImagesOfThirtyTermsFromAnyLocalStroke) {
    constexpr std::size_t kMostSamples = 38;
    take_thirty_terms_an_image();
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> value(0, 20);
    for (int stroke = 0; stroke < 60; ++stroke) {
        const std::size_t count = 1 + random() % kMostSamples;
        // At either end of the curve, too.
        const std::size_t last_first = curve::kCurveSamples - count;
        const std::size_t first = stroke % 10 == 0   ? 0
                                  : stroke % 10 == 1 ? last_first
                                                     : random() % (last_first + 1);
        json values = json::array();
        for (std::size_t k = 0; k < count; ++k) {
            values.push_back({value(random), value(random), value(random)});
        }
        edit({{"pearl",
               {{"stroke",
                 {{"from", curve::curve_u(first)},
                  {"to", curve::curve_u(first + count - 1)},
                  {"values", values}}}}}});
        EXPECT_LE(images_until_exact(), 2) << first << " " << count;
    }
}

TEST_F(CurveRoom, TellsWhatCanBeEdited) {
    const wire::SceneSummary summary = scene_->summary();
    EXPECT_EQ(summary.kind, "curves");
    EXPECT_EQ(summary.basis, "daubechies4");
    EXPECT_EQ(summary.columns, 1U + 2 * 257);
    EXPECT_EQ(summary.edits,
              (std::vector<std::string>{"materials", "strategy", "budget", "display"}));
    ASSERT_EQ(summary.materials.size(), 2U);
    EXPECT_EQ(summary.materials[0].id, "pearl");
    EXPECT_EQ(summary.materials[0].curve, "distribution");
    EXPECT_EQ(summary.materials[0].baked.shape, curve::CurveShape::ggx);
    EXPECT_EQ(wire::scene_summary_from_json(to_json(summary), ""), summary);
}

}  // namespace
}  // namespace relume::net
