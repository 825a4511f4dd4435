// points.bin: what is written is read to the precision that is stated, and nothing else is
// taken.
#include "protocol/transport/seen_points.h"

#include "protocol/transport/error.h"
#include "protocol/transport/octahedral.h"
#include "tests/unit/transport/broken_bytes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>

namespace relume::transport {
namespace {

Imath::V3f random_direction(std::mt19937_64& random) {
    std::normal_distribution<float> normal;
    Imath::V3f direction;
    do {
        direction = {normal(random), normal(random), normal(random)};
    } while (direction.length() < 1e-3F);
    return direction.normalized();
}

// Points of some slots, of up to two materials.
std::vector<SeenPoint> random_points(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<SeenPoint> points;
    for (std::size_t i = 0; i < count; ++i) {
        points.push_back({.slot = static_cast<std::uint8_t>(i / 2 % 256),
                          .material = static_cast<std::uint8_t>(random() % 2),
                          .share = 0.01F + 0.48F * unit(random),
                          .normal = random_direction(random),
                          .geometric_normal = random_direction(random),
                          .wo = random_direction(random),
                          .diffuse = {unit(random), unit(random), unit(random)}});
    }
    return points;
}

SeenPointsBuilder small_points() {
    SeenPointsBuilder builder(3);
    builder.set_block(2, random_points(2, 2));
    builder.set_block(0, random_points(5, 0));
    return builder;
}

std::string refusal(std::span<const std::byte> bytes, std::size_t materials = 2) {
    try {
        const SeenPoints points(bytes, "points.bin", materials);
        return "";
    } catch (const TransportError& error) {
        return error.what();
    }
}

std::string refusal_of(const std::vector<SeenPoint>& points) {
    SeenPointsBuilder builder(1);
    builder.set_block(0, points);
    return refusal(builder.bytes());
}

TEST(Octahedral, DirectionsComeBackAndStay) {
    std::mt19937_64 random(3);
    double worst = 0;
    const auto check = [&](const Imath::V3f& direction) {
        const OctahedralDirection packed = octahedral_from_direction(direction);
        const Imath::V3f back = direction_from_octahedral(packed);
        EXPECT_NEAR(back.length(), 1, 1e-6);
        worst = std::max(worst, double{(back - direction).length()});
        EXPECT_EQ(octahedral_from_direction(back), packed);
    };
    for (int i = 0; i < 100'000; ++i) {
        check(random_direction(random));
    }
    for (const float sign : {1.0F, -1.0F}) {
        check({sign, 0, 0});
        check({0, sign, 0});
        check({0, 0, sign});
    }
    EXPECT_LT(worst, 7e-5);
}

TEST(Octahedral, AnyTwoNumbersAreADirection) {
    for (const int x : {-32768, -32767, -16384, -1, 0, 1, 12345, 32767}) {
        for (const int y : {-32768, -32767, -16384, -1, 0, 1, 12345, 32767}) {
            const Imath::V3f direction = direction_from_octahedral(
                {static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
            EXPECT_NEAR(direction.length(), 1, 1e-6) << x << ' ' << y;
        }
    }
}

TEST(SeenPoints, WhatIsWrittenIsRead) {
    const auto bytes = small_points().bytes();
    const SeenPoints points(bytes, "points.bin", 2);
    EXPECT_EQ(points.block_count(), 3U);
    EXPECT_EQ(points.point_count(), 7U);
    const std::size_t counts[] = {5, 0, 2};
    for (std::uint32_t block = 0; block < 3; ++block) {
        const auto written = random_points(counts[block], block);
        const auto read = points.of_block(block);
        ASSERT_EQ(read.size(), written.size());
        EXPECT_EQ(points.point_count(block), written.size());
        for (std::size_t i = 0; i < read.size(); ++i) {
            EXPECT_EQ(read[i], stored_point(written[i]));
            EXPECT_EQ(read[i], stored_point(read[i]));
            EXPECT_EQ(read[i].slot, written[i].slot);
            EXPECT_EQ(read[i].material, written[i].material);
            EXPECT_NEAR(read[i].share, written[i].share, 5e-4 * written[i].share);
            EXPECT_LT((read[i].normal - written[i].normal).length(), 7e-5);
            EXPECT_LT((read[i].geometric_normal - written[i].geometric_normal).length(), 7e-5);
            EXPECT_LT((read[i].wo - written[i].wo).length(), 7e-5);
            EXPECT_LT((read[i].diffuse - written[i].diffuse).length(), 1e-3);
        }
    }
}

TEST(SeenPoints, APointTakesNoMoreThan32Bytes) {
    SeenPointsBuilder builder(1);
    builder.set_block(0, random_points(510, 9));
    EXPECT_LE(builder.bytes().size(), 48 + 510 * 32);
}

TEST(SeenPoints, WrongHeadsAreNamed) {
    const auto bytes = small_points().bytes();
    ASSERT_EQ(refusal(bytes), "");
    const auto with = [&](std::size_t offset, std::uint32_t value) {
        return refusal(test::with_number(bytes, offset, value));
    };
    test::expect_refusal(with(0, 1),
                         "points.bin: magic: found something else, expected "
                         "RELUMESP");
    test::expect_refusal(with(8, 2), "version");
    test::expect_refusal(with(16, 8), "count of points");
    test::expect_refusal(with(24, 1), "reserved part: found 1");
    test::expect_refusal(with(28, 23), "frame");
    test::expect_refusal(with(32, 1), "block 0: offset");
    test::expect_refusal(refusal(std::span(bytes).first(31)), "length");
    test::expect_refusal(refusal(std::span(bytes).first(bytes.size() - 1)), "length");
}

TEST(SeenPoints, ValuesOutOfRangeAreNamed) {
    const auto changed = [](auto change) {
        std::vector<SeenPoint> points = random_points(6, 1);
        change(points);
        return refusal_of(points);
    };
    EXPECT_EQ(changed([](auto&) {}), "");
    test::expect_refusal(changed([](auto& p) { p[3].material = 2; }),
                         "points.bin: block 0: point 3: material: found 2, expected one of 2");
    test::expect_refusal(changed([](auto& p) { p[4].slot = 0; }), "point 4: slot: found 0");
    test::expect_refusal(changed([](auto& p) { p[1].share = 0; }), "point 1: share");
    test::expect_refusal(changed([](auto& p) { p[1].share = -0.5F; }), "point 1: share");
    test::expect_refusal(changed([](auto& p) { p[1].share = NAN; }), "point 1: share");
    test::expect_refusal(changed([](auto& p) { p[2].share = p[3].share = 0.6F; }),
                         "point 3: share: found 1.2");
    test::expect_refusal(changed([](auto& p) { p[5].diffuse.y = 1.01F; }), "point 5: diffuse");
    test::expect_refusal(changed([](auto& p) { p[5].diffuse.y = -0.01F; }), "point 5: diffuse");
    test::expect_refusal(changed([](auto& p) { p[5].diffuse.z = NAN; }), "point 5: diffuse");
    EXPECT_EQ(changed([](auto& p) { p[2].share = p[3].share = 0.5F; }), "");
}

TEST(SeenPoints, BrokenBytesAreRefusedOrPointsInRange) {
    test::for_each_broken(small_points().bytes(), 4000, [](std::span<const std::byte> bytes) {
        try {
            const SeenPoints points(bytes, "points.bin", 2);
            for (std::uint32_t block = 0; block < points.block_count(); ++block) {
                for (const SeenPoint& point : points.of_block(block)) {
                    ASSERT_LT(point.material, 2);
                    ASSERT_GT(point.share, 0);
                    ASSERT_NEAR(point.normal.length(), 1, 1e-5);
                }
            }
        } catch (const TransportError& error) {
            test::expect_refusal(error.what(), "points.bin: ");
        }
    });
}

}  // namespace
}  // namespace relume::transport
