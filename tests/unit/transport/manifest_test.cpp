#include "protocol/transport/manifest.h"

#include "protocol/transport/error.h"
#include "tests/unit/transport/changed_manifest.h"

#include <gtest/gtest.h>

namespace relume::transport {
namespace {

Manifest sample() {
    Manifest manifest;
    manifest.generator = "test";
    manifest.layout = transport::ReceiverLayout::pixel_tiles({.width = 33, .height = 16});
    manifest.signal_basis = basis::CubemapBasis::haar(8);
    manifest.stating_rows = 64;
    manifest.choosing_rows = 32;
    manifest.colour.matrix = {{{1}, {0.5F}, {0.25F}}};
    manifest.columns = {.file = "columns.bin", .bytes = 5, .checksum = 6};
    manifest.receivers = {.file = "receivers.bin", .bytes = 7, .checksum = 8};
    manifest.sketch = {.file = "sketch.bin", .bytes = 9, .checksum = 10};
    manifest.shards = {{.file = "shards/0",
                        .bytes = 1,
                        .header_checksum = 2,
                        .first_block = 0,
                        .block_count = 2},
                       {.file = "shards/1",
                        .bytes = 3,
                        .header_checksum = 4,
                        .first_block = 2,
                        .block_count = 1}};
    return manifest;
}

std::string changed(const std::function<void(nlohmann::json&)>& change) {
    return changed_text(sample(), change);
}

TEST(Manifest, ComesBackFromItsText) {
    const std::string text = text_from_manifest(sample());
    EXPECT_EQ(text_from_manifest(manifest_from_text(text, "m")), text);
    EXPECT_NO_THROW((void)manifest_from_text(changed([](auto&) {}), "m"));
}

TEST(Manifest, SamplingErrorIsOptional) {
    Manifest manifest = sample();
    EXPECT_FALSE(manifest_from_text(text_from_manifest(manifest), "m").sampling_error);
    manifest.sampling_error = {.natural = 0.008, .sun = 0.1};
    EXPECT_EQ(manifest_from_text(text_from_manifest(manifest), "m").sampling_error,
              manifest.sampling_error);
}

TEST(Manifest, RefusesEveryWrongSamplingError) {
    const nlohmann::json wrong[] = {nullptr,
                                    0.1,
                                    nlohmann::json::object(),
                                    {{"natural", 0.1}},
                                    {{"natural", -0.1}, {"sun", 0.1}},
                                    {{"natural", "0.1"}, {"sun", 0.1}},
                                    {{"natural", 0.1}, {"sun", 1e300}}};
    for (const nlohmann::json& error : wrong) {
        EXPECT_THROW((void)manifest_from_text(
                         changed([&](auto& object) { object["sampling_error"] = error; }), "m"),
                     TransportError)
            << error;
    }
}

TEST(Manifest, NamesEitherBasisOfLight) {
    for (const basis::CubemapBasis& basis :
         {basis::CubemapBasis::haar(16), basis::CubemapBasis::spherical_harmonics(1, 4),
          basis::CubemapBasis::spherical_harmonics(basis::kMaxShOrder, 256)}) {
        Manifest manifest = sample();
        manifest.signal_basis = basis;
        const Manifest read = manifest_from_text(text_from_manifest(manifest), "m");
        EXPECT_EQ(read.signal_basis, basis);
        EXPECT_EQ(read.column_count(), basis.coefficient_count());
    }
}

TEST(Manifest, RefusesEveryWrongBasis) {
    const nlohmann::json wrong[] = {
        {{"name", "sh"}, {"face_resolution", 16}},
        {{"name", "sh"}, {"order", 5}},
        {{"name", "sh"}, {"order", 0}, {"face_resolution", 16}},
        {{"name", "sh"}, {"order", 21}, {"face_resolution", 16}},
        {{"name", "sh"}, {"order", -1}, {"face_resolution", 16}},
        {{"name", "sh"}, {"order", 2.5}, {"face_resolution", 16}},
        {{"name", "sh"}, {"order", "5"}, {"face_resolution", 16}},
        {{"name", "sh"}, {"order", 5}, {"face_resolution", 12}},
        {{"name", "sh"}, {"order", 5}, {"face_resolution", 2}},
        {{"name", "SH"}, {"order", 5}, {"face_resolution", 16}},
        {{"name", nullptr}, {"face_resolution", 16}},
        {{"face_resolution", 16}},
        "sh",
    };
    for (const nlohmann::json& basis : wrong) {
        EXPECT_THROW(
            (void)manifest_from_text(changed([&](auto& m) { m["basis"] = basis; }), "m"),
            TransportError)
            << basis;
    }
}

TEST(Manifest, NamesFileKeyFoundAndExpected) {
    const auto text = changed([](nlohmann::json& m) { m["image"]["width"] = 99999; });
    try {
        (void)manifest_from_text(text, "some/manifest.json");
        FAIL() << "a width of 99999 was accepted";
    } catch (const TransportError& error) {
        EXPECT_STREQ(error.what(),
                     "some/manifest.json: manifest.image.width: found 99999, expected an "
                     "integer from 1 to 16384");
    }
}

TEST(Manifest, RefusesEveryWrongValue) {
    using Change = std::function<void(nlohmann::json&)>;
    const Change changes[] = {
        [](auto& m) { m["format"] = "other"; },
        [](auto& m) { m["version"] = kFormatVersion + 1; },
        [](auto& m) { m["kind"] = "curve"; },
        [](auto& m) { m.erase("image"); },
        [](auto& m) { m["image"] = 3; },
        [](auto& m) { m["image"]["height"] = -1; },
        [](auto& m) { m["image"]["height"] = 1.5; },
        [](auto& m) { m["basis"]["face_resolution"] = 12; },
        [](auto& m) { m["basis"]["face_resolution"] = 512; },
        [](auto& m) { m["colour"]["channels"] = 2; },
        [](auto& m) {
            m["colour"]["matrix"] = nlohmann::json::array({1, 2, 3});
        },
        [](auto& m) { m["colour"]["matrix"][0][0] = "x"; },
        [](auto& m) { m["blocks"] = 4; },
        [](auto& m) { m["sketch"]["stating_rows"] = 100000; },
        [](auto& m) { m["sketch"]["stating_rows"] = 15; },
        [](auto& m) { m["sketch"].erase("stating_rows"); },
        [](auto& m) { m["sketch"]["choosing_rows"] = 1025; },
        [](auto& m) { m["sketch"]["choosing_rows"] = 0; },
        [](auto& m) { m["sketch"]["choosing_rows"] = "64"; },
        [](auto& m) { m["sketch"].erase("choosing_rows"); },
        [](auto& m) { m["files"]["columns"]["file"] = "../columns.bin"; },
        [](auto& m) { m["files"]["columns"]["file"] = "/etc/passwd"; },
        [](auto& m) { m["files"]["columns"]["file"] = ""; },
        [](auto& m) { m["files"]["sketch"]["xxh3"] = "12"; },
        [](auto& m) { m["fingerprint"] = "00000000000000ZZ"; },
        [](auto& m) { m["shards"] = nullptr; },
        [](auto& m) { m["shards"][1]["first_block"] = 1; },
        [](auto& m) { m["shards"].erase(1); },
        [](auto& m) { m["shards"][0]["block_count"] = 65; },
        [](auto& m) {
            m["camera"]["eye"] = {1, 2};
        },
        [](auto& m) { m["camera"]["tan_half_width"] = "wide"; },
        [](auto& m) { m["camera"]["tan_half_width"] = 0; },
        [](auto& m) { m["camera"]["tan_half_height"] = -1; },
        [](auto& m) { m["camera"]["eye"][0] = 1e300; },
        [](auto& m) {
            m["camera"]["up"] = {0, 2, 0};
        },
        [](auto& m) {
            m["camera"]["up"] = {0, 0, 0};
        },
        [](auto& m) {
            m["camera"]["forward"] = {0, 1, 0};
        },
        [](auto& m) {
            m["camera"]["right"] = {0.8, 0.6, 0};
        },
        [](auto& m) { m["colour"]["matrix"][2][0] = 1e39; },
        [](auto& m) { m["files"]["columns"]["file"] = std::string("columns.bin\0x", 13); },
        [](auto& m) { m["files"]["columns"]["file"] = "./columns.bin"; },
        [](auto& m) { m["files"]["columns"]["file"] = "a//columns.bin"; },
        [](auto& m) { m["files"]["columns"]["file"] = "columns.bin\n"; },
        [](auto& m) { m["files"]["columns"]["file"] = std::string(1000, 'a'); },
        [](auto& m) { m["shards"][0]["file"] = std::string("shards/0\0", 9); },
        [](auto& m) { m["bake"] = 5; },
        [](auto& m) { m["measured"] = "much"; },
        [](auto& m) {
            for (int i = 0; i < 20; ++i) {
                m["measured"] = {{"deeper", m["measured"]}};
            }
        },
    };
    int number = 0;
    for (const Change& change : changes) {
        EXPECT_THROW((void)manifest_from_text(changed(change), "m"), TransportError)
            << "change " << number;
        ++number;
    }
}

// What follows the checksum line, with that line before it.
std::string with_checksum(const std::string& body) {
    return "{\"xxh3\":\"" + text_from_checksum(checksum(std::as_bytes(std::span(body)))) +
           "\",\n" + body;
}

TEST(Manifest, NestingAndKeysAreThoseOfStrictJson) {
    const std::string text = text_from_manifest(sample());
    const std::string body = text.substr(text.find('\n') + 1);
    EXPECT_NO_THROW((void)manifest_from_text(with_checksum(body), "m"));
    constexpr std::size_t kLevels = 100'000;
    const std::string nested = std::string(kLevels, '[') + std::string(kLevels, ']');
    for (const std::string& first :
         {"\"measured2\":" + nested + ",", std::string("\"kind\":\"image\","),
          std::string("\"xxh3\":\"0\",")}) {
        EXPECT_THROW((void)manifest_from_text(with_checksum(first + body), "m"), TransportError)
            << first.substr(0, 60);
    }
}

TEST(Manifest, RefusesTextThatIsNotOne) {
    for (const char* text : {"", "{}", "\n", "{\"xxh3\":\"0123456789abcdef\",\n",
                             "{\"xxh3\":\"0123456789abcdef\",\n}"}) {
        EXPECT_THROW((void)manifest_from_text(text, "m"), TransportError) << text;
    }
}

TEST(Manifest, CameraLooksThroughThePixelsOfTheImage) {
    const TileGrid image{.width = 4, .height = 2};
    const CameraRecord camera{.tan_half_width = 2, .tan_half_height = 1};
    EXPECT_EQ(camera.direction_from_pixel(2, 1, image), Imath::V3f(0, 0, -1));
    const Imath::V3f corner = camera.direction_from_pixel(0, 0, image);
    EXPECT_LT((corner - Imath::V3f(-2, 1, -1).normalized()).length(), 1e-6F);
}

}  // namespace
}  // namespace relume::transport
