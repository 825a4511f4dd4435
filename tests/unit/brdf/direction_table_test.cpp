#include "protocol/brdf/direction_table.h"

#include "protocol/brdf/direction_angles.h"
#include "protocol/brdf/error.h"
#include "tests/unit/brdf/random_directions.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace relume::brdf {
namespace {

using Imath::V3f;

V3f direction_from_angles(double theta, double phi) {
    return V3f(Imath::V3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                          std::cos(theta)));
}

// Two functions of the angles, of which the second is the first plus ten.
DirectionTable table_of(std::uint32_t rows,
                        std::uint32_t columns,
                        const std::function<double(double, double)>& function) {
    const TableShape shape{.rows = rows, .columns = columns, .depth = 2};
    std::vector<float> values;
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const double value =
                function(shape.theta_from_row(row), shape.phi_from_column(column));
            values.push_back(static_cast<float>(value));
            values.push_back(static_cast<float>(value + 10));
        }
    }
    return {shape, std::move(values)};
}

std::array<float, 2> values_at(const DirectionTable& table, const V3f& direction) {
    std::array<float, 2> values{};
    table.evaluate(direction, values);
    return values;
}

TEST(DirectionAngles, AreThoseOfTheLibrary) {
    RandomDirections random(1);
    for (int i = 0; i < 10000; ++i) {
        V3f d = random.above_horizon();
        d = i % 3 == 0 ? d * 1e-8F : d;
        EXPECT_NEAR(polar_angle(d.x, d.y, d.z), std::atan2(std::hypot(d.x, d.y), d.z), 4e-7);
        const double phi = std::atan2(d.y, d.x);
        EXPECT_NEAR(azimuthal_angle(d.x, d.y), phi < 0 ? phi + 2 * std::numbers::pi : phi,
                    1e-6);
    }
}

TEST(DirectionTable, HasItsValuesOnTheGridAndIsBilinearBetween) {
    constexpr double kStep = std::numbers::pi / 2 / 8;
    constexpr double kTurn = 2 * std::numbers::pi / 12;
    // Bilinear in θ and φ inside each cell, and no function of only one of them.
    const auto function = [](double theta, double phi) {
        return 1 + theta * 3 + std::fmod(phi, 2 * std::numbers::pi) * (2 - theta);
    };
    const DirectionTable table = table_of(9, 12, function);
    for (const double row : {0.25, 1.0, 3.5, 6.75, 7.9}) {
        for (const double column : {0.0, 0.5, 4.0, 10.75}) {
            const auto found =
                values_at(table, direction_from_angles(row * kStep, column * kTurn));
            EXPECT_NEAR(found[0], function(row * kStep, column * kTurn), 1e-4);
            EXPECT_NEAR(found[1], found[0] + 10, 1e-5F);
        }
        // Across the seam: from the last column to the first.
        const double middle =
            (function(row * kStep, 11 * kTurn) + function(row * kStep, 0)) / 2;
        EXPECT_NEAR(values_at(table, direction_from_angles(row * kStep, 11.5 * kTurn))[0],
                    middle, 1e-4);
    }
}

TEST(DirectionTable, ConvergesWithTheSquareOfTheStep) {
    const auto function = [](double theta, double phi) {
        return std::sin(theta) * std::sin(theta) * std::cos(2 * phi) + std::cos(3 * theta);
    };
    const auto largest_error = [&](std::uint32_t rows, std::uint32_t columns) {
        const DirectionTable table = table_of(rows, columns, function);
        RandomDirections random(3);
        double largest = 0;
        for (int i = 0; i < 20000; ++i) {
            const V3f d = random.above_horizon();
            const double value =
                function(std::atan2(std::hypot(d.x, d.y), d.z), std::atan2(d.y, d.x));
            largest = std::max(largest, std::fabs(values_at(table, d)[0] - value));
        }
        return largest;
    };
    const double coarse = largest_error(17, 32);
    const double fine = largest_error(33, 64);
    EXPECT_LT(fine, 0.28 * coarse);
    EXPECT_GT(fine, 0.2 * coarse);
}

TEST(DirectionTable, OneColumnDependsOnThetaAlone) {
    const DirectionTable table = table_of(5, 1, [](double theta, double) { return theta; });
    for (const double phi : {0.0, 1.0, 3.0, 6.0}) {
        EXPECT_NEAR(values_at(table, direction_from_angles(0.7, phi))[0], 0.7F, 1e-6F);
    }
}

TEST(DirectionTable, IsZeroBelowTheHorizonAndFiniteForWhatIsNoDirection) {
    const DirectionTable table = table_of(5, 8, [](double, double) { return 1; });
    EXPECT_EQ(values_at(table, {0.6F, 0, -0.8F})[1], 0);
    EXPECT_EQ(values_at(table, {0, 1, 0})[1], 0);
    EXPECT_EQ(values_at(table, {0, 0, 0})[1], 0);
    EXPECT_EQ(values_at(table, {0, 0, -1})[1], 0);
    EXPECT_NEAR(values_at(table, {0, 0, 1})[1], 11, 1e-5F);
    EXPECT_NEAR(values_at(table, {1, 0, 1e-7F})[1], 11, 1e-5F);
    constexpr float kBad[]{std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity(),
                           -std::numeric_limits<float>::infinity(),
                           3e38F,
                           1e-45F,
                           1.0F};
    for (const float x : kBad) {
        for (const float y : kBad) {
            for (const float z : kBad) {
                EXPECT_TRUE(std::isfinite(values_at(table, {x, y, z})[0]))
                    << x << ' ' << y << ' ' << z;
            }
        }
    }
}

TEST(DirectionTable, ManyHaveTheBitsOfOne) {
    for (const std::uint32_t columns : {1U, 48U}) {
        const DirectionTable table = table_of(
            33, columns, [](double theta, double phi) { return std::sin(5 * theta + phi); });
        RandomDirections random(4);
        DirectionList directions(0);
        for (int i = 0; i < 1003; ++i) {
            directions.add(random.on_sphere());
        }
        directions.add({0, 0, 1});
        directions.add({1, 0, 0});
        directions.add({1, -0.0F, 0.5F});
        directions.add({std::numeric_limits<float>::quiet_NaN(), 0, 1});
        std::vector<float> many(directions.x.size() * 2, -1);
        table.evaluate(directions.planes(), many);
        for (std::size_t i = 0; i < directions.x.size(); ++i) {
            const auto one = values_at(table, directions[i]);
            ASSERT_EQ(many[2 * i], one[0]) << i;
            ASSERT_EQ(many[2 * i + 1], one[1]) << i;
        }
    }
}

TEST(DirectionTable, RefusesWhatIsNoTable) {
    const auto make = [](std::uint32_t rows, std::uint32_t columns, std::uint32_t depth,
                         std::size_t count, float value) {
        return DirectionTable({.rows = rows, .columns = columns, .depth = depth},
                              std::vector<float>(count, value));
    };
    EXPECT_NO_THROW(make(2, 3, 4, 24, 1));
    EXPECT_THROW(make(1, 3, 4, 12, 1), BrdfError);
    EXPECT_THROW(make(513, 1, 1, 513, 1), BrdfError);
    EXPECT_THROW(make(2, 0, 1, 0, 1), BrdfError);
    EXPECT_THROW(make(2, 1025, 1, 2050, 1), BrdfError);
    EXPECT_THROW(make(2, 1, 0, 0, 1), BrdfError);
    EXPECT_THROW(make(2, 1, 65, 130, 1), BrdfError);
    EXPECT_THROW(make(2, 3, 4, 23, 1), BrdfError);
    EXPECT_THROW(make(2, 3, 4, 24, std::numeric_limits<float>::infinity()), BrdfError);
    EXPECT_THROW(make(2, 3, 4, 24, std::numeric_limits<float>::quiet_NaN()), BrdfError);
}

}  // namespace
}  // namespace relume::brdf
