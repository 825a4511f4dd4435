#include "protocol/light/environment_import.h"

#include "protocol/light/environment_error.h"
#include "tests/unit/light/image_files.h"
#include "tests/unit/light/synthetic_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

namespace relume::light {
namespace {

using namespace testing;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

MapImage grey_image(std::uint32_t height, float value) {
    return {2 * height, height, std::vector<float>(std::size_t{6} * height * height, value)};
}

bool mentions(const std::vector<std::string>& warnings, const std::string& words) {
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& warning) {
        return warning.find(words) != std::string::npos;
    });
}

// The message of the refusal.
std::string refusal(std::span<const std::byte> file,
                    std::optional<Projection> projection = {}) {
    try {
        (void)import_environment(file, {.projection = projection});
    } catch (const EnvironmentError& e) {
        return e.what();
    }
    return "not refused";
}

#define EXPECT_REFUSED(file, words)                                   \
    do {                                                              \
        const std::string message = refusal(file);                    \
        EXPECT_NE(message.find(words), std::string::npos) << message; \
    } while (false)

TEST(EnvironmentImport, ReadsBackWhatWasWritten) {
    const MapImage image = draw(Projection::lat_long, 64, 32, smooth_radiance);
    for (const char* format : {"openexr", "hdr"}) {
        const ImportedImage imported = import_image(encode_rgb(format, image));
        EXPECT_EQ(imported.projection, Projection::lat_long);
        EXPECT_TRUE(imported.notes.warnings.empty()) << imported.notes.warnings.front();
        ASSERT_EQ(imported.image.rgb.size(), image.rgb.size());
        for (std::size_t i = 0; i < image.rgb.size(); ++i) {
            // Radiance HDR cuts to 8 bits below the power of two above the largest, here 4.
            const float bound = std::string(format) == "hdr" ? 4.0F / 256 : 0.0F;
            EXPECT_NEAR(imported.image.rgb[i], image.rgb[i], bound);
        }
    }
}

TEST(EnvironmentImport, TheProjectionCanBeGiven) {
    const MapImage image = draw(Projection::lat_long, 60, 21, smooth_radiance);
    const std::vector<std::byte> file = encode_rgb("openexr", image);
    EXPECT_REFUSED(file, "60x21");
    EXPECT_REFUSED(file, "lat_long (2:1)");
    const ImportedEnvironment imported =
        import_environment(file, {.projection = Projection::lat_long});
    EXPECT_EQ(imported.map.projection(), Projection::lat_long);
    EXPECT_NE(refusal(file, Projection::angular_map).find("angular_map (1:1)"),
              std::string::npos);
}

TEST(EnvironmentImport, OneChannelIsGreyAndAlphaIsIgnored) {
    const ImportedImage grey =
        import_image(encode("openexr", 4, 2, {"Y"}, {1, 2, 3, 4, 5, 6, 7, 8}));
    EXPECT_EQ(grey.image.rgb[3], 2.0F);
    EXPECT_EQ(grey.image.rgb[4], 2.0F);
    EXPECT_EQ(grey.image.rgb[5], 2.0F);
    const ImportedImage with_alpha = import_image(
        encode("openexr", 2, 1, {"R", "G", "B", "A"}, {1, 2, 3, 0.5F, 4, 5, 6, kNan}));
    EXPECT_EQ(with_alpha.image.rgb, (std::vector<float>{1, 2, 3, 4, 5, 6}));
}

TEST(EnvironmentImport, OtherChannelsAreRefusedByName) {
    EXPECT_REFUSED(encode("openexr", 2, 1, {"Z", "A"}, {1, 1, 1, 1}), "no name (A, Z)");
    EXPECT_REFUSED(encode("openexr", 2, 1, {"X", "Y", "Z"}, {1, 1, 1, 1, 1, 1}), "X, Y, Z");
    EXPECT_REFUSED(encode("openexr", 2, 1, {"Z"}, {1, 1}), "channels R, G and B, or Y");
}

TEST(EnvironmentImport, ALayerServesWhereThereIsNoPlainColour) {
    const ImportedImage imported = import_image(
        encode("openexr", 2, 1, {"Sky.R", "Sky.G", "Sky.B", "Z"}, {1, 2, 3, 9, 4, 5, 6, 9}));
    EXPECT_EQ(imported.image.rgb, (std::vector<float>{1, 2, 3, 4, 5, 6}));
    EXPECT_TRUE(mentions(imported.notes.warnings, "layer Sky"));
}

TEST(EnvironmentImport, NegativesBecomeZeroWithAWarning) {
    MapImage image = grey_image(8, 1);
    image.rgb[30] = -0.004F;
    image.rgb[31] = -0.002F;
    image.rgb[60] = -1e-6F;
    const ImportedImage imported = import_image(encode_rgb("openexr", image));
    EXPECT_EQ(imported.image.rgb[30], 0.0F);
    EXPECT_EQ(imported.image.rgb[32], 1.0F);
    EXPECT_TRUE(mentions(imported.notes.warnings,
                         "2 negative texels set to 0, the lowest being -0.004"));
}

TEST(EnvironmentImport, FewBadTexelsAreMendedWithAWarning) {
    MapImage image = grey_image(16, 2);
    image.rgb[300] = kNan;
    image.rgb[301] = -kInfinity;
    image.rgb[602] = kInfinity;
    const ImportedImage imported = import_image(encode_rgb("openexr", image));
    EXPECT_EQ(imported.image.rgb[300], 2.0F);
    EXPECT_EQ(imported.image.rgb[301], 2.0F);
    EXPECT_EQ(imported.image.rgb[602], 65504.0F);
    EXPECT_TRUE(mentions(imported.notes.warnings, "1 NaN texels"));
    EXPECT_TRUE(mentions(imported.notes.warnings, "1 infinite texels set to 65504"));
}

TEST(EnvironmentImport, ABlockOfNanIsFilledFromAround) {
    MapImage image = grey_image(64, 3);
    for (std::size_t y = 20; y < 25; ++y) {
        for (std::size_t x = 50; x < 55; ++x) {
            image.rgb[(y * 128 + x) * 3] = kNan;
        }
    }
    const ImportedImage imported = import_image(encode_rgb("openexr", image));
    EXPECT_EQ(imported.image.rgb, grey_image(64, 3).rgb);
    EXPECT_TRUE(mentions(imported.notes.warnings, "25 NaN texels"));
}

TEST(EnvironmentImport, ManyBadTexelsAreRefused) {
    for (const float value : {kNan, kInfinity}) {
        MapImage image = grey_image(8, 1);
        image.rgb[0] = value;
        image.rgb[30] = value;
        EXPECT_REFUSED(encode_rgb("openexr", image), "2 of 128 texels are NaN or infinite");
    }
}

TEST(EnvironmentImport, TexelsTooBrightToSumAreLimited) {
    MapImage image = grey_image(8, 1);
    image.rgb[5] = 3e38F;
    const ImportedImage imported = import_image(encode_rgb("openexr", image));
    EXPECT_EQ(imported.image.rgb[5], kMaxTexelRadiance);
    EXPECT_TRUE(mentions(imported.notes.warnings, "1 texels brighter"));
}

TEST(EnvironmentImport, AMirroredHdrIsTurnedUpright) {
    const MapImage image = draw(Projection::lat_long, 64, 32, smooth_radiance);
    std::vector<std::byte> file = encode_rgb("hdr", image);
    std::string text(reinterpret_cast<const char*>(file.data()), file.size());
    const std::size_t at = text.find("-Y 32 +X 64");
    ASSERT_NE(at, std::string::npos);
    const ImportedImage upright = import_image(file);
    std::memcpy(file.data() + at, "+Y 32 +X 64", 11);
    const ImportedImage flipped = import_image(file);
    for (std::size_t y = 0; y < 32; ++y) {
        for (std::size_t i = 0; i < 192; ++i) {
            ASSERT_EQ(flipped.image.rgb[y * 192 + i], upright.image.rgb[(31 - y) * 192 + i]);
        }
    }
}

TEST(EnvironmentImport, RefusesTooManyTexels) {
    const MapImage image = grey_image(8, 1);
    try {
        (void)import_image(encode_rgb("openexr", image), {.max_texels = 127});
        FAIL();
    } catch (const EnvironmentError& e) {
        EXPECT_EQ(e.found(), "16x8");
        EXPECT_NE(e.expected().find("127"), std::string::npos);
    }
}

TEST(EnvironmentImport, RefusesWhatIsNoImage) {
    EXPECT_REFUSED(std::span<const std::byte>(), "is empty");
    const auto as_bytes = [](const std::string& text) {
        return std::as_bytes(std::span(text));
    };
    const std::string gif = "GIF89a and so on";
    EXPECT_REFUSED(as_bytes(gif), "a GIF");
    const std::string png = "\x89PNG\r\n";
    EXPECT_REFUSED(as_bytes(png), "a PNG");
    const std::string page = "<!doctype html>";
    EXPECT_REFUSED(as_bytes(page), "a web page");
    const std::string unknown = "GIB89a and so on";
    EXPECT_REFUSED(as_bytes(unknown), "47 49 42 38");
    EXPECT_THROW((void)import_environment(std::filesystem::path("no such file.hdr")),
                 EnvironmentError);
}

TEST(EnvironmentImport, RefusesTruncatedFiles) {
    const MapImage image = draw(Projection::lat_long, 64, 32, smooth_radiance);
    for (const char* format : {"openexr", "hdr"}) {
        const std::vector<std::byte> file = encode_rgb(format, image);
        for (std::size_t length = 0; length < file.size() * 9 / 10;
             length += file.size() / 37) {
            EXPECT_THROW((void)import_environment(std::span(file).first(length)),
                         EnvironmentError)
                << format << " cut at " << length << " of " << file.size();
        }
    }
}

TEST(EnvironmentImport, ReadsTheStudioMapsOfTheDistribution) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(RELUME_STUDIO_LIGHTS)) {
        if (entry.path().extension() == ".exr") {
            const ImportedEnvironment imported = import_environment(entry.path());
            EXPECT_EQ(imported.map.projection(), Projection::lat_long) << entry.path();
            EXPECT_GT(imported.map.total_energy().y, 0.1) << entry.path();
            ++count;
        }
    }
    EXPECT_GE(count, 5U) << "no maps in " << RELUME_STUDIO_LIGHTS;
}

}  // namespace
}  // namespace relume::light
