#include "precompute/factors/merl_brdf.h"

#include "precompute/factors/error.h"
#include "precompute/scene/bsdf.h"
#include "tests/support/merl_file.h"
#include "tests/unit/factors/directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace relume::factors {
namespace {

using Imath::V3f;
using test::merl_file;
using test::PairOfDirections;

const scene::Bsdf& material() {
    static const scene::Bsdf bsdf =
        scene::Bsdf::phong({0.1F, 0.2F, 0.3F}, {0.5F, 0.4F, 0.3F}, 30);
    return bsdf;
}

const std::vector<std::byte>& file() {
    static const std::vector<std::byte> bytes =
        merl_file([](const V3f& wi, const V3f& wo) { return material().evaluate(wi, wo); });
    return bytes;
}

void expect_refused(std::span<const std::byte> bytes, const std::string& part) {
    try {
        const MerlBrdf brdf("some.binary", bytes);
        ADD_FAILURE() << "accepted, expected: " << part;
    } catch (const FactorError& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.rfind("some.binary: ", 0), 0U) << message;
        EXPECT_NE(message.find(part), std::string::npos) << message;
    }
}

TEST(MerlBrdf, GivesTheBrdfThatWasTabulated) {
    const MerlBrdf measured("f", file());
    CosineDirections directions(1);
    double error = 0;
    double norm = 0;
    for (int i = 0; i < 20000; ++i) {
        const V3f wi = directions.next();
        const V3f wo = directions.next();
        const V3f expected = material().evaluate(wi, wo);
        error += (measured.evaluate(wi, wo) - expected).length2();
        norm += expected.length2();
    }
    EXPECT_LT(std::sqrt(error / norm), 0.01);
    EXPECT_GT(measured.unmeasured_count(), 0U);
}

TEST(MerlBrdf, HasTheStoredValueInTheMiddleOfACell) {
    // One cell, alone: half vector 40, difference 30, azimuth 70, green.
    std::vector<std::byte> bytes(MerlBrdf::kFileBytes);
    std::copy_n(file().begin(), 12, bytes.begin());
    const std::size_t cell = (40 * 90 + 30) * 180 + 70;
    const double stored = 1500;
    std::memcpy(&bytes[12 + 8 * (MerlBrdf::kCells + cell)], &stored, 8);
    const MerlBrdf measured("f", bytes);
    const double theta_half = std::numbers::pi / 2 * std::pow(40.5 / 90, 2);
    const double degree = std::numbers::pi / 180;
    const auto at = [&](double theta_difference, double phi_difference) {
        const PairOfDirections pair(theta_half, theta_difference * degree,
                                    phi_difference * degree);
        return measured.evaluate(pair.wi, pair.wo);
    };
    // Half of it is the mirrored cell's, 180 − 70.
    EXPECT_NEAR(at(30.5, 70.5).y, 1.15F / 2, 2e-3F);
    EXPECT_NEAR(at(30.5, 109.5).y, 1.15F / 2, 2e-3F);
    EXPECT_NEAR(at(30.5, 250.5).y, 1.15F / 2, 2e-3F);
    EXPECT_NEAR(at(31.0, 70.5).y, 1.15F / 4, 2e-3F);
    EXPECT_NEAR(at(30.5, 71.0).y, 1.15F / 4, 2e-3F);
    EXPECT_NEAR(at(31.6, 70.5).y, 0, 2e-3F);
    EXPECT_EQ(at(30.5, 70.5).x, 0);
    EXPECT_EQ(at(30.5, 70.5).z, 0);
}

TEST(MerlBrdf, IsReciprocalIsotropicAndEven) {
    // Values that no formula would give.
    std::vector<std::byte> bytes = file();
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1000);
    for (std::size_t at = 12; at < bytes.size(); at += 8) {
        const double value = uniform(random);
        std::memcpy(&bytes[at], &value, 8);
    }
    const MerlBrdf measured("f", bytes);
    CosineDirections directions(2);
    for (int i = 0; i < 1000; ++i) {
        const V3f wi = directions.next();
        const V3f wo = directions.next();
        const V3f value = measured.evaluate(wi, wo);
        EXPECT_NEAR((measured.evaluate(wo, wi) - value).length(), 0, 5e-3F);
        EXPECT_NEAR((measured.evaluate(turned(wi, 2), turned(wo, 2)) - value).length(), 0,
                    5e-3F);
        EXPECT_NEAR(
            (measured.evaluate({wi.x, -wi.y, wi.z}, {wo.x, -wo.y, wo.z}) - value).length(), 0,
            5e-3F);
    }
}

TEST(MerlBrdf, KnowsTheWidthOfItsHighlight) {
    // cos^30 is half at 0.21 rad from the mirror direction, so is the table at its half angle.
    EXPECT_NEAR(MerlBrdf("f", file()).width_rad(), 0.22, 0.03);
    const auto flat = merl_file([](const V3f&, const V3f&) { return V3f(0.2F); });
    EXPECT_EQ(MerlBrdf("f", flat).width_rad(), 1);
}

TEST(MerlBrdf, IsFiniteAndNotNegativeEverywhere) {
    const MerlBrdf measured("f", file());
    for (const double theta_i : {0.0, 1e-4, 0.7, 1.5707}) {
        for (const double theta_o : {0.0, 1e-4, 0.7, 1.5707}) {
            for (const double phi : {0.0, 1e-4, 1.5708, 3.14159265, 4.0, 6.2831853}) {
                const V3f value = measured.evaluate(direction_from_angles(theta_i, phi),
                                                    direction_from_angles(theta_o, 0));
                for (int c = 0; c < 3; ++c) {
                    EXPECT_TRUE(std::isfinite(value[c]) && value[c] >= 0);
                }
            }
        }
    }
}

TEST(MerlBrdf, RefusesEveryMalformedFile) {
    const std::vector<std::byte>& good = file();
    expect_refused({}, "0 bytes, expected 34992012");
    expect_refused(std::span(good).first(12), "12 bytes, expected 34992012");
    expect_refused(std::span(good).first(good.size() - 1), "34992011 bytes");
    std::vector<std::byte> bytes = good;
    bytes.push_back(std::byte{0});
    expect_refused(bytes, "34992013 bytes");
    for (const std::size_t count : {0U, 1U, 2U}) {
        for (const std::int32_t value : {0, -90, 91, 360, std::numeric_limits<int>::max()}) {
            bytes = good;
            std::memcpy(&bytes[4 * count], &value, 4);
            expect_refused(bytes, "cells, expected 90×90×180");
        }
    }
    for (const double value : {std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity(), 1e300}) {
        bytes = good;
        std::memcpy(&bytes[12 + 8 * 5], &value, 8);
        expect_refused(bytes, "value 5 of plane 0");
    }
}

TEST(MerlBrdf, IsReadFromAFileThatIsOne) {
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / "relume-merl-test";
    std::filesystem::create_directories(folder);
    const std::filesystem::path path = folder / "grey.binary";
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(file().data()),
               static_cast<std::streamsize>(file().size()));
    const MerlBrdf measured = MerlBrdf::read(path);
    EXPECT_EQ(measured.evaluate({0, 0, 1}, {0, 0, 1}),
              MerlBrdf("f", file()).evaluate({0, 0, 1}, {0, 0, 1}));
    EXPECT_THROW(static_cast<void>(MerlBrdf::read(folder / "none.binary")), FactorError);
    EXPECT_THROW(static_cast<void>(MerlBrdf::read(folder)), FactorError);
    std::ofstream(path, std::ios::binary | std::ios::app).put('x');
    EXPECT_THROW(static_cast<void>(MerlBrdf::read(path)), FactorError);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace relume::factors
