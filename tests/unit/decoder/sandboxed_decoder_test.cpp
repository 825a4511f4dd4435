#include "server/decoder/sandboxed_decoder.h"

#include "protocol/light/environment_error.h"
#include "tests/unit/light/image_files.h"
#include "tests/unit/light/synthetic_maps.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <thread>

namespace relume::decoder {
namespace {

using namespace light;
using namespace light::testing;
using std::chrono::milliseconds;

DecodeLimits real() {
    DecodeLimits limits;
    limits.program = RELUME_DECODE;
    return limits;
}

DecodeLimits misbehaving(milliseconds timeout = milliseconds(20'000)) {
    DecodeLimits limits;
    limits.program = RELUME_MISBEHAVING_DECODER;
    limits.timeout = timeout;
    return limits;
}

std::string refusal(std::span<const std::byte> file, const DecodeLimits& limits) {
    try {
        (void)decode_in_child(file, {}, limits);
    } catch (const EnvironmentError& e) {
        return e.what();
    }
    return "not refused";
}

std::string refusal(const std::string& mode, const DecodeLimits& limits = misbehaving()) {
    return refusal(std::as_bytes(std::span(mode)), limits);
}

void expect_words(const std::string& message, const std::string& words) {
    EXPECT_NE(message.find(words), std::string::npos) << message;
}

TEST(SandboxedDecoder, GivesWhatDecodingHereGives) {
    const MapImage image = draw(Projection::vertical_cross, 48, 64, smooth_radiance);
    for (const char* format : {"openexr", "hdr"}) {
        const std::vector<std::byte> file = encode_rgb(format, image);
        const ImportedEnvironment there = decode_in_child(file, {}, real());
        const ImportedEnvironment here = import_environment(file);
        EXPECT_EQ(there.map.projection(), Projection::vertical_cross);
        EXPECT_EQ(there.map.levels()[0].rgb, here.map.levels()[0].rgb) << format;
        EXPECT_EQ(there.notes.warnings, here.notes.warnings);
    }
}

TEST(SandboxedDecoder, EveryCompressionOfExrStaysWithinItsRights) {
    const MapImage image = draw(Projection::lat_long, 64, 32, smooth_radiance);
    for (const char* compression :
         {"none", "rle", "zip", "zips", "piz", "pxr24", "b44", "dwaa", "dwab"}) {
        const auto file =
            encode("openexr", 64, 32, {"R", "G", "B"}, image.rgb,
                   [&](OIIO::ImageSpec& spec) { spec["compression"] = compression; });
        const auto tiled =
            encode("openexr", 64, 32, {"R", "G", "B"}, image.rgb, [&](OIIO::ImageSpec& spec) {
                spec["compression"] = compression;
                spec.tile_width = 16;
                spec.tile_height = 16;
            });
        for (const auto& bytes : {file, tiled}) {
            const ImportedEnvironment decoded = decode_in_child(bytes, {}, real());
            EXPECT_NEAR(decoded.map.radiance({0, 0, -1}).x, smooth_radiance({0, 0, -1}).x,
                        0.05F)
                << compression;
        }
    }
}

TEST(SandboxedDecoder, DecodesTheStudioMapsWithTheirWarnings) {
    std::ifstream stream(std::string(RELUME_STUDIO_LIGHTS) + "/courtyard.exr",
                         std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const ImportedEnvironment decoded =
        decode_in_child(std::as_bytes(std::span(text)), {}, real());
    EXPECT_EQ(decoded.map.width(), 1024U);
    ASSERT_FALSE(decoded.notes.warnings.empty());
    expect_words(decoded.notes.warnings.back(), "negative texels set to 0");
}

TEST(SandboxedDecoder, PassesOnProjectionAndRefusals) {
    const auto file =
        encode_rgb("openexr", draw(Projection::lat_long, 60, 21, smooth_radiance));
    EXPECT_EQ(decode_in_child(file, {.projection = Projection::lat_long}, real()).map.width(),
              60U);
    try {
        (void)decode_in_child(file, {}, real());
        FAIL();
    } catch (const EnvironmentError& e) {
        EXPECT_EQ(e.found(), "60x21");
        expect_words(e.expected(), "lat_long (2:1)");
        expect_words(e.what(), "60x21");
    }
    expect_words(refusal("this is no image", real()), "Radiance HDR or OpenEXR");
    expect_words(refusal("", real()), "is empty");
}

TEST(SandboxedDecoder, BrokenFilesEndInAResultOrANamedError) {
    const MapImage image = draw(Projection::lat_long, 32, 16, smooth_radiance);
    std::mt19937 generator(1);
    std::size_t refused = 0;
    for (const char* format : {"openexr", "hdr"}) {
        const std::vector<std::byte> file = encode_rgb(format, image);
        for (int i = 0; i < 12; ++i) {
            std::vector<std::byte> broken = file;
            if (i % 3 == 0) {
                broken.resize(
                    std::uniform_int_distribution<std::size_t>(0, file.size())(generator));
            } else {
                const std::size_t reach =
                    i % 3 == 1 ? std::min<std::size_t>(400, file.size()) : file.size();
                const auto at =
                    std::uniform_int_distribution<std::size_t>(0, reach - 1)(generator);
                broken[at] ^= static_cast<std::byte>(1U << (generator() % 8));
            }
            const std::string message = refusal(broken, real());
            EXPECT_FALSE(message.empty());
            EXPECT_EQ(message.find("forbidden"), std::string::npos) << message;
            refused += message == "not refused" ? 0U : 1U;
        }
    }
    EXPECT_GT(refused, 8U);
}

TEST(SandboxedDecoder, HugeDimensionsAreRefusedBeforeTheyAreDecoded) {
    const auto file = encode_rgb("hdr", draw(Projection::lat_long, 64, 32, smooth_radiance));
    std::string text(reinterpret_cast<const char*>(file.data()), file.size());
    const std::size_t at = text.find("-Y 32 +X 64");
    ASSERT_NE(at, std::string::npos);
    text.replace(at, 11, "-Y 1000000000 +X 2000000000");
    expect_words(refusal(text, real()), "texels a side");
    text = std::string(reinterpret_cast<const char*>(file.data()), file.size());
    text.replace(at, 11, "-Y 8192 +X 16384");
    DecodeLimits limits = real();
    limits.max_texels = 1 << 20;
    expect_words(refusal(text, limits), "1048576 in all");
}

std::vector<std::byte> content_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

TEST(SandboxedDecoder, HostileHeadersAreRefusedInWordsAndInLittleMemory) {
    const std::filesystem::path cases = std::filesystem::path(RELUME_CASES) / "uploads";
    const std::map<std::string, std::string> words{
        {"exr_2g.exr", "texels a side"},
        {"exr_65535.exr", "texels a side"},
        {"exr_attr_huge.exr", "attribute foo of 2147483647 bytes"},
        {"exr_deep.exr", "image is deep"},
        {"exr_neg.exr", "from (100, 100) to (-100, -100)"},
        {"exr_tiled_huge.exr", "tile is 2147483647x2147483647"}};
    std::size_t tried = 0;
    for (const auto& entry : std::filesystem::directory_iterator(cases)) {
        const std::string name = entry.path().filename();
        ASSERT_TRUE(words.contains(name)) << name;
        expect_words(refusal(content_of(entry.path()), real()), words.at(name));
        ++tried;
    }
    EXPECT_EQ(tried, words.size());
}

TEST(SandboxedDecoder, WhatADecoderMayTakeIsBounded) {
    // 2048×1024 texels take 25 MB, and the file says so truly.
    const MapImage large{2048, 1024, std::vector<float>(std::size_t{3} * 2048 * 1024)};
    const std::vector<std::byte> file = encode_rgb("openexr", large);
    DecodeLimits limits = real();
    EXPECT_EQ(refusal(file, limits), "not refused");
    limits.address_space_bytes = std::size_t{32} << 20;
    const std::string message = refusal(file, limits);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    expect_words(message, "memory");
#endif
}

TEST(SandboxedDecoder, ADecodeEndsWhenNobodyWaitsForIt) {
    DecodeLimits limits = misbehaving(milliseconds(60'000));
    std::stop_source source;
    limits.stop = source.get_token();
    std::jthread stopper([&source] {
        std::this_thread::sleep_for(milliseconds(100));
        source.request_stop();
    });
    expect_words(refusal("hang", limits), "nobody waits");
}

TEST(SandboxedDecoder, LongFilesAreRefusedUnseen) {
    DecodeLimits limits = real();
    limits.max_file_bytes = 10;
    expect_words(refusal("eleven byte", limits), "11 bytes long, expected at most 10");
}

TEST(SandboxedDecoder, AChildThatFailsIsNamed) {
    expect_words(refusal("crash"), "Segmentation fault");
    expect_words(refusal("silent"), "ended before its answer was complete");
    expect_words(refusal("fail"), "exited with status 3");
    expect_words(refusal("nonsense"), "answered nonsense");
    expect_words(refusal("endless text"), "answered nonsense");
    expect_words(refusal("huge image"), "answered with 16384x16384 texels");
    expect_words(refusal("short image"), "ended before its answer was complete");
    expect_words(refusal("unknown projection"), "answered nonsense");
    expect_words(refusal("wrong shape"), "expected the shape of angular_map");
    expect_words(refusal("bad values"), "holds -1");
    expect_words(refusal("control characters"), "?[31mred");
}

TEST(SandboxedDecoder, AChildThatDoesNotEndIsEnded) {
    for (const char* mode : {"hang", "spin"}) {
        expect_words(refusal(mode, misbehaving(milliseconds(200))), "took longer than 200 ms");
    }
}

TEST(SandboxedDecoder, NoWayLeadsOutOfTheSandbox) {
    expect_words(refusal("try to do nothing"), "exited with status 60");
    for (const char* act :
         {"open", "socket", "fork", "exec", "kill", "make executable memory"}) {
        expect_words(refusal(std::string("try to ") + act), "tried a forbidden system call");
    }
}

TEST(SandboxedDecoder, TheChildInheritsNothing) {
    const int open_here = open("/dev/null", O_RDONLY);  // NOLINT: not close-on-exec on purpose
    ASSERT_GE(open_here, 3);
    sigset_t terminate;
    sigemptyset(&terminate);
    sigaddset(&terminate, SIGTERM);
    sigset_t before;
    pthread_sigmask(SIG_BLOCK, &terminate, &before);
    EXPECT_EQ(refusal("inheritance"), "not refused");
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    close(open_here);
}

TEST(SandboxedDecoder, AMissingProgramIsNamed) {
    DecodeLimits limits;
    limits.program = "/nonexistent/relume-decode";
    expect_words(refusal("", limits), "/nonexistent/relume-decode");
}

TEST(SandboxedDecoder, RunsFromManyThreads) {
    const auto file =
        encode_rgb("openexr", draw(Projection::angular_map, 64, 64, smooth_radiance));
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([&file, i] {
            if (i % 2 == 0) {
                EXPECT_EQ(decode_in_child(file, {}, real()).map.height(), 64U);
            } else {
                expect_words(refusal("crash"), "Segmentation fault");
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
}

}  // namespace
}  // namespace relume::decoder
