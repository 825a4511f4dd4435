#include "protocol/wire/image_header.h"

#include "protocol/wire/limits.h"
#include "tests/unit/wire/vectors.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>

namespace relume::wire {
namespace {

ImageHeader header_from_fields(const nlohmann::json& fields) {
    return {.encoding = fields.at("encoding") == "jpeg" ? ImageEncoding::jpeg
                                                        : ImageEncoding::half_planes,
            .width = fields.at("width"),
            .height = fields.at("height"),
            .revision = fields.at("revision"),
            .sequence = fields.at("sequence"),
            .relative_error = fields.at("relative_error"),
            .exact = fields.at("exact"),
            .has_alpha = fields.at("has_alpha"),
            .edit_to_image_ms = fields.at("edit_to_image_ms"),
            .relight_ms = fields.at("relight_ms"),
            .encode_ms = fields.at("encode_ms"),
            .coefficients_applied = fields.at("coefficients_applied"),
            .payload_bytes = fields.at("payload_bytes"),
            .coefficients_remaining = fields.at("coefficients_remaining")};
}

std::vector<std::byte> frame_of(std::span<const std::byte> header, std::size_t payload_bytes) {
    std::vector<std::byte> frame(header.size() + payload_bytes);
    std::copy(header.begin(), header.end(), frame.begin());
    return frame;
}

TEST(ImageHeaders, SharedCasesDecodeAndEncodeToTheSameBytes) {
    for (const auto& c : vectors_from_file("image_headers")) {
        SCOPED_TRACE(c.at("name"));
        const std::vector<std::byte> bytes = bytes_from_hex(c.at("hex").get<std::string>());
        const ImageHeader expected = header_from_fields(c.at("fields"));
        EXPECT_EQ(decode_image_header(frame_of(bytes, expected.payload_bytes)), expected);
        const auto encoded = encode_image_header(expected);
        EXPECT_TRUE(std::equal(encoded.begin(), encoded.end(), bytes.begin(), bytes.end()));
    }
}

TEST(ImageHeaders, SharedMalformedCasesAreRefusedByTheNameOfTheField) {
    for (const auto& c : vectors_from_file("image_headers_malformed")) {
        SCOPED_TRACE(c.at("name"));
        const auto frame =
            frame_of(bytes_from_hex(c.at("hex").get<std::string>()), c.at("payload_bytes"));
        const WireError error = wire_error_of([&] { return decode_image_header(frame); });
        EXPECT_EQ(error.code(), ErrorCode::bad_image);
        EXPECT_EQ(error.path(), c.at("field"));
    }
}

TEST(ImageHeaders, EncodingRefusesWhatDecodingWould) {
    const ImageHeader good{.width = 4, .height = 4, .payload_bytes = 1};
    EXPECT_NO_THROW(static_cast<void>(encode_image_header(good)));
    ImageHeader bad = good;
    bad.relative_error = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(static_cast<void>(encode_image_header(bad)), WireError);
    bad = good;
    bad.width = 0;
    EXPECT_THROW(static_cast<void>(encode_image_header(bad)), WireError);
    bad = good;
    bad.has_alpha = true;
    EXPECT_THROW(static_cast<void>(encode_image_header(bad)), WireError);
}

rc::Gen<float> finite_amount() {
    return rc::gen::map(rc::gen::arbitrary<std::uint32_t>(),
                        [](std::uint32_t bits) { return static_cast<float>(bits) / 4096.0F; });
}

rc::Gen<ImageHeader> valid_header() {
    return rc::gen::exec([] {
        ImageHeader header;
        header.encoding = *rc::gen::element(ImageEncoding::jpeg, ImageEncoding::half_planes);
        header.width = *rc::gen::inRange<std::uint32_t>(1, 4097);
        header.height = *rc::gen::inRange<std::uint32_t>(1, 4097);
        header.revision = *rc::gen::arbitrary<std::uint64_t>() & kMaxInteger;
        header.sequence = *rc::gen::arbitrary<std::uint64_t>() & kMaxInteger;
        header.exact = *rc::gen::arbitrary<bool>();
        header.has_alpha =
            header.encoding == ImageEncoding::half_planes && *rc::gen::arbitrary<bool>();
        header.relative_error = header.exact ? 0.0F : *finite_amount();
        header.edit_to_image_ms = *finite_amount();
        header.relight_ms = *finite_amount();
        header.encode_ms = *finite_amount();
        header.coefficients_applied = *rc::gen::arbitrary<std::uint32_t>();
        header.coefficients_remaining =
            header.exact ? 0U : *rc::gen::arbitrary<std::uint32_t>();
        header.payload_bytes = *rc::gen::inRange<std::uint32_t>(1, 2000);
        return header;
    });
}

RC_GTEST_PROP(ImageHeaders, AnyValidHeaderSurvivesTheRoundTrip, ()) {
    const ImageHeader header = *valid_header();
    const auto bytes = encode_image_header(header);
    RC_ASSERT(decode_image_header(frame_of(bytes, header.payload_bytes)) == header);
}

RC_GTEST_PROP(ImageHeaders, AnyBytesAreDecodedToAValidHeaderOrRefused, ()) {
    const ImageHeader header = *valid_header();
    auto frame = frame_of(encode_image_header(header), header.payload_bytes);
    for (int flips = *rc::gen::inRange(1, 4); flips > 0; --flips) {
        const auto at = *rc::gen::inRange<std::size_t>(0, kImageHeaderBytes);
        frame[at] ^= static_cast<std::byte>(1U << *rc::gen::inRange(0U, 8U));
    }
    try {
        const ImageHeader decoded = decode_image_header(frame);
        const auto again = encode_image_header(decoded);
        RC_ASSERT(std::equal(again.begin(), again.end(), frame.begin()));
    } catch (const WireError& error) {
        RC_ASSERT(error.code() == ErrorCode::bad_image);
        RC_ASSERT(!error.path().empty());
    }
}

}  // namespace
}  // namespace relume::wire
