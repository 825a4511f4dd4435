#include "server/view/mesh/raster_tile.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <random>
#include <span>
#include <vector>

namespace relume::view {
namespace {

constexpr double kImageSide = 256;

// The specification: every triangle in turn at the place of every pixel.
void draw_plainly(std::span<const ProjectedTriangle> triangles,
                  std::span<const std::uint32_t> numbers,
                  std::uint32_t left,
                  std::uint32_t top,
                  const SamplePosition& sample,
                  RasterTile& tile) {
    for (const std::uint32_t number : numbers) {
        const ProjectedTriangle& triangle = triangles[number];
        for (std::size_t y = 0; y < kRasterSide; ++y) {
            for (std::size_t x = 0; x < kRasterSide; ++x) {
                std::array<double, 3> weights{};
                for (std::size_t k = 0; k < 3; ++k) {
                    weights[k] = triangle.edges[k].at(left + sample.x + static_cast<double>(x),
                                                      top + sample.y + static_cast<double>(y));
                }
                if (*std::min_element(weights.begin(), weights.end()) < 0) {
                    continue;
                }
                const double sum = weights[0] + weights[1] + weights[2];
                const auto nearness = static_cast<float>(sum * triangle.nearness_of_weight);
                const std::size_t at = y * RasterTile::kRow + x;
                if (nearness > tile.nearness[at]) {
                    tile.nearness[at] = nearness;
                    tile.triangle[at] = triangle.triangle;
                    tile.weight_1[at] = static_cast<float>(weights[1] / sum);
                    tile.weight_2[at] = static_cast<float>(weights[2] / sum);
                }
            }
        }
    }
}

// Triangles of an image, as a view projects them.
class Drawing {
  public:
    // At image points (x, y) and these depths, whichever way they run.
    void add(const std::array<Imath::V3d, 3>& corners) {
        std::array<Imath::V3d, 3> projected;
        for (std::size_t k = 0; k < 3; ++k) {
            const Imath::V3d& at = corners[k];
            projected[k] = {at.x * at.z, at.y * at.z, at.z};
        }
        for (int turn = 0; turn < 2; ++turn) {
            if (auto triangle = project(projected, kImageSide, kImageSide)) {
                triangle->triangle = static_cast<std::uint32_t>(7 * triangles_.size() + 3);
                triangles_.push_back(*triangle);
                return;
            }
            std::swap(projected[1], projected[2]);
        }
    }
    [[nodiscard]] std::size_t size() const { return triangles_.size(); }
    [[nodiscard]] std::span<const ProjectedTriangle> triangles() const { return triangles_; }
    [[nodiscard]] std::vector<std::uint32_t> numbers(std::size_t count) const {
        std::vector<std::uint32_t> numbers(std::min(count, triangles_.size()));
        std::iota(numbers.begin(), numbers.end(), 0U);
        return numbers;
    }

  private:
    std::vector<ProjectedTriangle> triangles_;
};

struct Place {
    std::uint32_t left = 0;
    std::uint32_t top = 0;
    SamplePosition sample;
};

// Whatever a triangle's pixels begin and end with: the middle of pixels, and places that a look
// at edges takes, in tiles at the image's corner and within it.
std::vector<Place> places() {
    std::vector<Place> places;
    for (const std::uint32_t left : {0U, 32U, 224U}) {
        for (const SamplePosition& sample :
             {SamplePosition{}, {1.0 / 32, 17.0 / 32}, {31.0 / 32, 31.0 / 32}}) {
            places.push_back({.left = left, .top = 256 - 32 - left, .sample = sample});
        }
    }
    return places;
}

bool is_same(const RasterTile& a, const RasterTile& b) {
    for (std::size_t y = 0; y < kRasterSide; ++y) {
        const auto row = [y](const auto& values) {
            return std::span(values).subspan(y * RasterTile::kRow, kRasterSide);
        };
        const auto equal = [&](const auto& of_a, const auto& of_b) {
            return std::equal(row(of_a).begin(), row(of_a).end(), row(of_b).begin());
        };
        if (!equal(a.nearness, b.nearness) || !equal(a.triangle, b.triangle) ||
            !equal(a.weight_1, b.weight_1) || !equal(a.weight_2, b.weight_2)) {
            return false;
        }
    }
    return true;
}

std::size_t pixels_hit(const RasterTile& tile) {
    return static_cast<std::size_t>(std::count_if(tile.nearness.begin(), tile.nearness.end(),
                                                  [](float nearness) { return nearness > 0; }));
}

// Returns how many pixels show something.
std::size_t expect_same_on_every_target(const Drawing& drawing,
                                        std::size_t count,
                                        const Place& place,
                                        const std::string& what) {
    const std::vector<std::uint32_t> numbers = drawing.numbers(count);
    const auto expected = std::make_unique<RasterTile>();
    expected->clear();
    draw_plainly(drawing.triangles(), numbers, place.left, place.top, place.sample, *expected);
    const auto found = std::make_unique<RasterTile>();
    for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().DeInit();
        found->clear();
        draw(drawing.triangles(), numbers, place.left, place.top, place.sample, *found);
        EXPECT_TRUE(is_same(*expected, *found))
            << what << " at " << place.left << ", " << place.top << ", sample "
            << place.sample.x << ", " << place.sample.y << ", on " << hwy::TargetName(target);
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
    return pixels_hit(*expected);
}

// Every instruction set this processor has gives the bits of the specification, for triangles
// that cover every number of pixels of a row from every first pixel on.
TEST(RasterTile, EveryTargetGivesTheBitsOfThePlainLoopForEveryRunOfPixels) {
    for (std::uint32_t first = 0; first < kRasterSide; ++first) {
        for (std::uint32_t count = 1; first + count <= kRasterSide; ++count) {
            Drawing drawing;
            const double from = 32 + first + 0.25;
            const double to = from + count - 0.5;
            drawing.add({{{from, 190, 2}, {to, 190, 3}, {to, 226, 4}}});
            drawing.add({{{from, 190, 2}, {to, 226, 4}, {from, 226, 3}}});
            EXPECT_GT(expect_same_on_every_target(
                          drawing, 2, {.left = 32, .top = 192, .sample = {}},
                          std::to_string(count) + " pixels from " + std::to_string(first)),
                      0U);
        }
    }
}

// Any number of triangles in front of each other, of all sizes: also such as pass the eye, and
// pairs with an edge in common and points at one depth.
TEST(RasterTile, EveryTargetGivesTheBitsOfThePlainLoopForCrowds) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-40, 296);
    std::uniform_real_distribution<double> near(-60, 60);
    std::uniform_real_distribution<double> depth(0.5, 9);
    std::uniform_real_distribution<double> before(-2, 4);
    Drawing drawing;
    while (drawing.size() < 301) {
        const Imath::V3d a(place(random), place(random), depth(random));
        const Imath::V3d b(a.x + near(random), a.y + near(random), depth(random));
        const Imath::V3d c(a.x + near(random), a.y + near(random), depth(random));
        drawing.add({a, b, c});
        drawing.add({b, c, Imath::V3d(b.x + c.x - a.x, b.y + c.y - a.y, a.z)});
        drawing.add({Imath::V3d(std::floor(a.x), std::floor(a.y), 5),
                     Imath::V3d(std::floor(b.x), std::floor(b.y), 5),
                     Imath::V3d(std::floor(c.x), std::floor(c.y), 5)});
        drawing.add({Imath::V3d(a.x, a.y, before(random)), b, Imath::V3d(c.x, c.y, -c.z)});
    }
    std::size_t hit = 0;
    for (const std::size_t count : {1UL, 2UL, 3UL, 7UL, 16UL, 33UL, 100UL, 301UL}) {
        for (const Place& at : places()) {
            hit += expect_same_on_every_target(drawing, count, at,
                                               std::to_string(count) + " triangles");
        }
    }
    EXPECT_GT(hit, 10'000U);
}

TEST(RasterTile, OfEquallyNearTrianglesTheFirstStays) {
    Drawing drawing;
    for (int i = 0; i < 2; ++i) {
        drawing.add({{{0, 0, 4}, {64, 0, 4}, {0, 64, 4}}});
    }
    RasterTile tile;
    tile.clear();
    draw(drawing.triangles(), drawing.numbers(2), 0, 0, {}, tile);
    EXPECT_EQ(tile.triangle[0], drawing.triangles()[0].triangle);
    EXPECT_EQ(tile.nearness[0], 0.25F);
}

TEST(RasterTile, WhereNothingIsDrawnIsNothing) {
    RasterTile tile;
    tile.nearness.fill(1);
    tile.triangle.fill(1);
    tile.clear();
    draw({}, {}, 64, 32, {}, tile);
    EXPECT_EQ(pixels_hit(tile), 0U);
    EXPECT_TRUE(std::all_of(tile.triangle.begin(), tile.triangle.end(),
                            [](std::uint32_t number) { return number == kNoTriangle; }));
}

}  // namespace
}  // namespace relume::view
