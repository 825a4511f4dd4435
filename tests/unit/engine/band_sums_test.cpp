#include "server/engine/sums/band_sums.h"

#include "tests/support/random_lighting.h"
#include "tests/unit/engine/engine_fixture.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

namespace relume::engine {
namespace {

constexpr std::size_t kColours = transport::kColours;

const served::Scene& scene() {
    static const TinyScene tiny({.channels = 3});
    return *tiny.scene();
}

// What is shown becomes this lighting in one column of `one_in`.
std::vector<ColumnChange> changes_towards(std::span<const float> target,
                                          std::size_t one_in,
                                          std::vector<float>& shown) {
    const std::size_t count = scene().columns().count();
    std::vector<ColumnChange> changes;
    for (const std::uint32_t j : scene().columns().by_band()) {
        if (j % one_in != 0) {
            continue;
        }
        ColumnChange change{.column = j};
        for (std::size_t c = 0; c < kColours; ++c) {
            change.from[c] = shown[c * count + j];
            change.to[c] = shown[c * count + j] = target[c * count + j];
        }
        changes.push_back(change);
    }
    return changes;
}

void clear(std::uint32_t bands, std::vector<float>& shown) {
    const std::size_t count = scene().columns().count();
    for (std::size_t i = 0; i < shown.size(); ++i) {
        if (((bands >> scene().columns().bands()[i % count]) & 1U) != 0) {
            shown[i] = 0;
        }
    }
}

void rebuild(BandSums& images, std::span<const float> lighting) {
    TransportOperator::Weights weights;
    scene().stored_operator().strips().set_weights(scene().transport(), lighting, weights);
    const BandSums::Rebuild whole{.sums = &images, .weights = &weights};
    BandSums::rebuild_together(0, scene().stored_operator().block_count(), {&whole, 1});
}

// Whatever was added, taken back, cleared and made anew: the total is the dense product of what
// is shown.
RC_GTEST_PROP(BandSums, TotalIsTheProductOfWhatIsShown, ()) {
    BandSums images(scene().stored_operator());
    std::vector<float> shown(kColours * scene().columns().count());
    for (int round = *rc::gen::inRange(1, 12); round > 0; --round) {
        const auto target = test::random_lighting(8, *rc::gen::inRange<unsigned>(0, 1000));
        switch (*rc::gen::inRange(0, 8)) {
            case 0:
                rebuild(images, target);
                shown = target;
                break;
            case 1:
                images.renew_total();
                break;
            case 2: {
                TransportOperator::Weights weights;
                scene().stored_operator().strips().set_weights(scene().transport(), shown, weights);
                images.renew_band(*rc::gen::inRange(0U, scene().columns().band_count()), weights);
                break;
            }
            default: {
                const auto bands =
                    *rc::gen::inRange<std::uint32_t>(0, 1U << scene().columns().band_count());
                clear(bands, shown);
                images.update(
                    bands,
                    changes_towards(target, *rc::gen::element<std::size_t>(1, 7, 50), shown));
            }
        }
    }
    // Of the brightest there can have been, for something is left of what was.
    const auto exact = test::dense_product(scene().transport(), shown);
    const auto bright = test::dense_product(scene().transport(), test::random_lighting(8, 0));
    double difference = 0;
    double norm = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const double d = images.total()[i] - exact[i];
        difference += d * d;
        norm += bright[i] * bright[i];
    }
    RC_ASSERT(std::sqrt(difference / norm) < 3e-6);
}

// A lamp that a whole product put into the bands' images and that columns take away again: the
// estimates say what is left of it, and to make the bands anew removes it.
TEST(BandSums, KnowWhatALampLeaves) {
    const auto sky = test::random_lighting(8, 1);
    const auto with_lamp = test::random_lighting(8, 1, 1e6F);
    BandSums images(scene().stored_operator());
    rebuild(images, with_lamp);
    std::vector<float> shown = with_lamp;
    images.update(0, changes_towards(sky, 1, shown));
    const auto exact = test::dense_product(scene().transport(), shown);
    double norm = 0;
    for (const double value : exact) {
        norm += value * value;
    }
    norm = std::sqrt(norm);
    const double left = test::relative_l2(images.total(), exact);
    EXPECT_GT(left, 1e-5);
    EXPECT_GT(images.rounding_error_of_total(), left * norm / 3);
    images.renew_total();
    EXPECT_EQ(images.rounding_error_of_total(), 0);
    EXPECT_GT(images.rounding_error_of_bands(),
              test::relative_l2(images.total(), exact) * norm / 3);
    TransportOperator::Weights weights;
    scene().stored_operator().strips().set_weights(scene().transport(), shown, weights);
    for (std::uint32_t i = 0; i < scene().columns().band_count(); ++i) {
        images.renew_band(images.most_drifted_band(), weights);
    }
    EXPECT_LT(images.rounding_error_of_bands(), 1e-6 * norm);
    EXPECT_LT(test::relative_l2(images.total(), exact), 1e-6);
}

// Black is black, whatever was there.
TEST(BandSums, HoldNothingWhenAllBandsAreCleared) {
    const auto lamp = test::random_lighting(8, 3, 1e6F);
    BandSums images(scene().stored_operator());
    rebuild(images, lamp);
    std::vector<float> shown = lamp;
    images.update(0, changes_towards(test::random_lighting(8, 4), 7, shown));
    images.update((1U << scene().columns().band_count()) - 1, {});
    for (const float sum : images.total()) {
        ASSERT_EQ(sum, 0);
    }
    EXPECT_EQ(images.rounding_error_of_total(), 0);
}

// Few columns are known one by one; a whole product leaves an image for every band.
TEST(BandSums, TakeMemoryForBandsOnlyOnceTheseHaveImages) {
    BandSums images(scene().stored_operator());
    EXPECT_EQ(images.bytes_of_bands(), 0);
    const std::uint64_t image = images.total().size_bytes();
    std::vector<float> shown(kColours * scene().columns().count());
    const auto changes = changes_towards(test::random_lighting(8, 4), 40, shown);
    images.update(0, changes);
    EXPECT_EQ(images.bytes_of_bands(), changes.size() * sizeof(ColumnChange));
    rebuild(images, shown);
    EXPECT_EQ(images.bytes_of_bands(), scene().columns().band_count() * image);
}

}  // namespace
}  // namespace relume::engine
