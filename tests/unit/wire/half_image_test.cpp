#include "protocol/wire/half_image.h"

#include "tests/unit/wire/vectors.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace relume::wire {
namespace {

bool same_bits(std::span<const Imath::half> a, std::span<const Imath::half> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](Imath::half x, Imath::half y) { return x.bits() == y.bits(); });
}

HalfImage decode(const nlohmann::json& c) {
    return decode_half_image(bytes_from_hex(c.at("payload").get<std::string>()), c.at("width"),
                             c.at("height"), c.at("has_alpha"));
}

TEST(HalfImages, SharedCasesDecode) {
    for (const auto& c : vectors_from_file("half_images")) {
        SCOPED_TRACE(c.at("name"));
        std::vector<Imath::half> expected;
        for (const auto& value : c.at("values")) {
            expected.emplace_back(value.get<float>());
        }
        EXPECT_TRUE(same_bits(decode(c).values, expected));
    }
}

TEST(HalfImages, SharedMalformedCasesAreRefused) {
    for (const auto& c : vectors_from_file("half_images_malformed")) {
        SCOPED_TRACE(c.at("name"));
        const WireError error = wire_error_of([&] { return decode(c); });
        EXPECT_EQ(error.code(), ErrorCode::bad_image);
        EXPECT_EQ(error.path(), "payload");
    }
}

HalfImage arbitrary_image() {
    HalfImage image{.width = *rc::gen::inRange<std::uint32_t>(1, 40),
                    .height = *rc::gen::inRange<std::uint32_t>(1, 40),
                    .has_alpha = *rc::gen::arbitrary<bool>(),
                    .values = {}};
    const auto seed = *rc::gen::arbitrary<std::uint32_t>();
    const auto spread = *rc::gen::element<std::uint32_t>(1, 0x0FU, 0xFFFFU);
    image.values.resize(image.plane_count() * image.plane_size());
    std::uint32_t random = seed;
    for (Imath::half& value : image.values) {
        random = random * 1664525U + 1013904223U;
        const auto bits = static_cast<std::uint16_t>((random >> 16U) & spread);
        value.setBits((bits & 0x7C00U) == 0x7C00U ? std::uint16_t{0x3C00} : bits);
    }
    return image;
}

RC_GTEST_PROP(HalfImages, AnyImageSurvivesTheRoundTripBehindAnyHeader, ()) {
    const HalfImage image = arbitrary_image();
    HalfImageEncoder encoder(*rc::gen::inRange(1, 6));
    std::vector<std::byte> frame(*rc::gen::inRange<std::size_t>(0, 70), std::byte{0x5A});
    const std::size_t before = frame.size();
    const std::size_t length = encoder.append_to(frame, image);
    RC_ASSERT(frame.size() == before + length);
    const HalfImage decoded = decode_half_image(std::span(frame).subspan(before), image.width,
                                                image.height, image.has_alpha);
    RC_ASSERT(same_bits(decoded.values, image.values));
    RC_ASSERT(std::all_of(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(before),
                          [](std::byte b) { return b == std::byte{0x5A}; }));
}

RC_GTEST_PROP(HalfImages, EveryTruncationAndEveryOtherSizeIsRefused, ()) {
    const HalfImage image = arbitrary_image();
    HalfImageEncoder encoder;
    std::vector<std::byte> payload;
    encoder.append_to(payload, image);
    const auto kept = *rc::gen::inRange<std::size_t>(0, payload.size());
    RC_ASSERT_THROWS_AS(decode_half_image(std::span(payload).first(kept), image.width,
                                          image.height, image.has_alpha),
                        WireError);
    RC_ASSERT_THROWS_AS(
        decode_half_image(payload, image.width + 1, image.height, image.has_alpha), WireError);
    RC_ASSERT_THROWS_AS(decode_half_image(payload, image.width, image.height, !image.has_alpha),
                        WireError);
}

TEST(HalfImages, AnEncoderIsAsGoodAsNewAfterAnError) {
    HalfImageEncoder encoder;
    std::vector<std::byte> payload;
    HalfImage image{.width = 2, .height = 2, .has_alpha = false, .values = {}};
    image.values.resize(11);
    EXPECT_THROW(encoder.append_to(payload, image), std::invalid_argument);
    EXPECT_TRUE(payload.empty());
    image.values.resize(12);
    encoder.append_to(payload, image);
    EXPECT_NO_THROW(static_cast<void>(decode_half_image(payload, 2, 2, false)));
}

TEST(HalfImages, HalfFromLinearIsNearestAndFinite) {
    EXPECT_EQ(static_cast<float>(half_from_linear(1.0F)), 1.0F);
    EXPECT_EQ(static_cast<float>(half_from_linear(2049.0F)), 2048.0F);  // ties to even
    EXPECT_EQ(static_cast<float>(half_from_linear(1e9F)), 65504.0F);
    EXPECT_EQ(static_cast<float>(half_from_linear(65519.0F)), 65504.0F);
    EXPECT_EQ(static_cast<float>(half_from_linear(-std::numeric_limits<float>::infinity())),
              -65504.0F);
    EXPECT_EQ(half_from_linear(std::numeric_limits<float>::quiet_NaN()).bits(), 0);
}

}  // namespace
}  // namespace relume::wire
