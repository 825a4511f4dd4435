// tests/cases/environments: variants of one picture by many writers. Each holds what its
// reference file holds, by the rule that the variant breaks.
#include "protocol/light/environment_error.h"
#include "protocol/light/environment_import.h"

#include <OpenEXR/ImfRgbaFile.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

namespace relume::light {
namespace {

const std::filesystem::path kCases = std::filesystem::path(RELUME_CASES) / "environments";
const std::filesystem::path kHdr = kCases / "30-hdr-variants";
const std::filesystem::path kExr = kCases / "31-exr-variants";

struct Picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<float> rgb;
    ImportNotes notes;

    [[nodiscard]] Imath::V3f at(std::uint32_t x, std::uint32_t y) const {
        const float* texel = &rgb[(std::size_t{y} * width + x) * 3];
        return {texel[0], texel[1], texel[2]};
    }
};

Picture read(const std::filesystem::path& file, const ImportOptions& options = {}) {
    ImportedEnvironment imported = import_environment(file, options);
    const EnvironmentMap::Level& level = imported.map.levels().front();
    return {level.width, level.height, level.rgb, imported.notes};
}

std::string refusal(const std::filesystem::path& file, const ImportOptions& options = {}) {
    try {
        (void)import_environment(file, options);
    } catch (const EnvironmentError& e) {
        return e.what();
    }
    return "not refused";
}

bool has_warning(const Picture& picture, const std::string& words) {
    return std::any_of(
        picture.notes.warnings.begin(), picture.notes.warnings.end(),
        [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
}

// Of every value, `expected(x, y)` being what the picture should hold.
void expect_pixels(const Picture& picture,
                   const std::function<Imath::V3f(std::uint32_t, std::uint32_t)>& expected,
                   float relative,
                   const std::string& what) {
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            const Imath::V3f found = picture.at(x, y);
            const Imath::V3f wanted = expected(x, y);
            const float most = std::max({wanted.x, wanted.y, wanted.z, 1e-3F});
            for (int c = 0; c < 3; ++c) {
                ASSERT_NEAR(found[c], wanted[c], relative * most)
                    << what << " at (" << x << ", " << y << ")";
            }
        }
    }
}

void expect_same(const std::filesystem::path& file,
                 const Picture& reference,
                 float relative,
                 float factor = 1) {
    SCOPED_TRACE(file.filename());
    const Picture picture = read(file);
    ASSERT_EQ(picture.width, reference.width);
    ASSERT_EQ(picture.height, reference.height);
    expect_pixels(
        picture, [&](std::uint32_t x, std::uint32_t y) { return reference.at(x, y) * factor; },
        relative, file.filename());
}

TEST(HdrCases, EveryEncodingAndOrderOfTexelsGivesThePicture) {
    const Picture flat = read(kHdr / "flat.hdr");
    ASSERT_EQ(flat.width, 128U);
    ASSERT_EQ(flat.height, 64U);
    // The picture as it was drawn, in float; RGBE cuts to 8 bits of the largest.
    expect_same(kHdr / "flat.hdr", read(kExr / "float.exr"), 1.0F / 128);
    for (const char* name : {"rle.hdr", "crlf.hdr", "longheader.hdr", "noformat.hdr",
                             "nomagic.hdr", "rgbe_magic.hdr", "fmt_spaces.hdr", "minusX.hdr",
                             "plusY.hdr", "plusYminusX.hdr", "columns.hdr"}) {
        expect_same(kHdr / name, flat, 0);
    }
}

TEST(HdrCases, TheOldRunLengthEncodingIsRead) {
    const Picture constant = read(kHdr / "old_rle_const.hdr");
    expect_pixels(
        constant, [&](std::uint32_t, std::uint32_t) { return constant.at(0, 0); }, 0,
        "old_rle_const");
    EXPECT_EQ(constant.at(0, 0), Imath::V3f(0.5F, 0.25F, 1));
    // Steps of one picture, written with runs and, for few of them, without.
    for (const char* name : {"old_rle.hdr", "old_rle_fewruns.hdr"}) {
        const Picture picture = read(kHdr / name);
        EXPECT_EQ(picture.rgb.size(), std::size_t{3} * 128 * 64) << name;
        EXPECT_GT(*std::max_element(picture.rgb.begin(), picture.rgb.end()), 0.5F) << name;
    }
    expect_same(kHdr / "old_rle_fewruns.hdr", read(kExr / "float.exr"), 1.0F / 60);
}

TEST(HdrCases, ExposureIsDividedOutAndNoted) {
    const Picture flat = read(kHdr / "flat.hdr");
    expect_same(kHdr / "exposure4.hdr", flat, 0, 0.25F);
    expect_same(kHdr / "exposure_x2.hdr", flat, 0, 0.25F);
    EXPECT_TRUE(has_warning(read(kHdr / "exposure4.hdr"), "EXPOSURE 4 divided out"));
    EXPECT_TRUE(has_warning(read(kHdr / "exposure_x2.hdr"), "EXPOSURE 4 divided out"));
}

TEST(HdrCases, PrimariesAreConvertedAndNoted) {
    const Picture flat = read(kHdr / "flat.hdr");
    const Picture converted = read(kHdr / "primaries.hdr");
    EXPECT_TRUE(has_warning(converted, "(0.7347, 0.2653)"));
    // By published matrices: Wide Gamut RGB to XYZ (D50), Bradford to D65, XYZ to Rec. 709.
    const Imath::M33f to_xyz(0.7161046F, 0.1009296F, 0.1471858F, 0.2581874F, 0.7249378F,
                             0.0168748F, 0, 0.0517813F, 0.7734287F);
    const Imath::M33f to_d65(0.9555766F, -0.0230393F, 0.0631636F, -0.0282895F, 1.0099416F,
                             0.0210077F, 0.0122982F, -0.0204830F, 1.3299098F);
    const Imath::M33f to_rgb(3.2404542F, -1.5371385F, -0.4985314F, -0.9692660F, 1.8760108F,
                             0.0415560F, 0.0556434F, -0.2040259F, 1.0572252F);
    const Imath::M33f matrix = to_rgb * to_d65 * to_xyz;
    expect_pixels(
        converted,
        [&](std::uint32_t x, std::uint32_t y) {
            const Imath::V3f c = product(matrix, flat.at(x, y));
            return Imath::V3f(std::max(0.0F, c.x), std::max(0.0F, c.y), std::max(0.0F, c.z));
        },
        2e-3F, "primaries.hdr");
}

TEST(HdrCases, ACutFileIsIncomplete) {
    EXPECT_NE(refusal(kHdr / "trunc.hdr").find("incomplete, copy it again"), std::string::npos);
}

TEST(HdrCases, SmallAndOddShapes) {
    for (const char* name : {"const1x1.hdr", "const2x1.hdr", "const1x2.hdr", "const3x1.hdr",
                             "const4x1.hdr", "const8x1.hdr", "const2x2.hdr", "const4x2.hdr",
                             "../33-one-row-environment/const2x1.hdr"}) {
        const ImportedEnvironment imported = import_environment(kHdr / name);
        EXPECT_EQ(imported.map.radiance({0.3F, 0.5F, -0.7F}), Imath::V3f(1)) << name;
        EXPECT_NEAR(imported.map.total_energy().x, 4 * M_PI, 1e-5) << name;
    }
    const Picture two = read(kHdr / "two1.hdr");
    EXPECT_EQ(two.width, 2U);
    for (const char* name : {"const2x4.hdr", "odd7x3.hdr", "w127x64.hdr", "w129x64.hdr"}) {
        EXPECT_NE(refusal(kHdr / name).find("projection lat_long given"), std::string::npos)
            << name;
        const ImportOptions lat_long{.projection = Projection::lat_long};
        EXPECT_EQ(refusal(kHdr / name, lat_long), "not refused") << name;
    }
    EXPECT_TRUE(has_warning(read(kHdr / "const2x2.hdr"), "taken for an angular map"));
    EXPECT_TRUE(read(kHdr / "const1x1.hdr").notes.warnings.empty());
}

TEST(ExrCases, EveryCompressionAndLayoutGivesThePicture) {
    const Picture exact = read(kExr / "float.exr");
    const Picture half = read(kExr / "half.exr");
    expect_same(kExr / "half.exr", exact, 1e-3F);
    for (const char* name :
         {"c_none.exr", "c_rle.exr", "c_zip.exr", "c_zips.exr", "c_piz.exr", "tiled.exr",
          "named_rgb.exr", "named_Rfull.exr", "vray_dot.exr", "blender.exr", "blender_ao.exr",
          "rgb_plus_ao.exr", "mp_beauty_depth.exr", "mp_depth_beauty.exr",
          "shifted_both.exr"}) {
        expect_same(kExr / name, half, 0);
    }
    expect_same(kExr / "c_pxr24.exr", half, 1e-3F);
    for (const char* name : {"c_b44.exr", "c_b44a.exr", "c_dwaa.exr", "c_dwab.exr"}) {
        expect_same(kExr / name, half, 0.06F);
    }
}

TEST(ExrCases, TheLayerIsChosenAndTheLayersAreListed) {
    const Picture ao = read(kExr / "blender_ao.exr");
    EXPECT_EQ(ao.notes.layer, "ViewLayer.Combined");
    EXPECT_EQ(ao.notes.layers,
              (std::vector<std::string>{"ViewLayer.AO", "ViewLayer.Combined"}));
    const Picture asked = read(kExr / "blender_ao.exr", {.layer = "ViewLayer.AO"});
    EXPECT_EQ(asked.notes.layer, "ViewLayer.AO");
    EXPECT_NE(asked.rgb, ao.rgb);
    EXPECT_NE(refusal(kExr / "blender_ao.exr", {.layer = "Sky"})
                  .find("expected one of ViewLayer.AO, ViewLayer.Combined"),
              std::string::npos);
    EXPECT_NE(refusal(kExr / "only_Z.exr").find("(Z)"), std::string::npos);
    EXPECT_EQ(read(kExr / "mp_depth_beauty.exr").notes.layer, "rgba");
}

TEST(ExrCases, WindowsAreFramed) {
    const Picture half = read(kExr / "half.exr");
    const Picture hugin = read(kExr / "hugin_crop.exr");
    expect_pixels(
        hugin,
        [&](std::uint32_t x, std::uint32_t y) {
            const bool inside = x >= 16 && x < 112 && y >= 8 && y < 56;
            return inside ? half.at(x, y) : Imath::V3f(0);
        },
        0, "hugin_crop.exr");
    EXPECT_TRUE(has_warning(hugin, "96x48 at (16, 8) of 128x64"));
    const Picture row = read(kExr / "crop_one_row.exr");
    expect_pixels(
        row,
        [&](std::uint32_t x, std::uint32_t y) {
            return y < 63 ? half.at(x, y) : Imath::V3f(0);
        },
        0, "crop_one_row.exr");
}

TEST(ExrCases, AnUpsideDownPictureIsTurned) {
    expect_same(kExr / "orient3.exr", read(kExr / "half.exr"), 0);
}

TEST(ExrCases, ChromaticitiesAreConverted) {
    const Picture exact = read(kExr / "float.exr");
    const Picture converted = read(kExr / "acescg.exr");
    // The picture was turned to ACEScg by five digits; in its corners colours cancel.
    expect_same(kExr / "acescg.exr", exact, 1e-3F);
    EXPECT_TRUE(has_warning(converted, "converted to Rec. 709"));
    EXPECT_NE(read(kExr / "acescg_nochroma.exr").rgb, exact.rgb);
}

TEST(ExrCases, GreyAndLuminanceWithChroma) {
    const Picture exact = read(kExr / "float.exr");
    const Picture grey = read(kExr / "grey_Y.exr");
    EXPECT_EQ(grey.at(60, 20).x, grey.at(60, 20).z);
    EXPECT_NEAR(grey.at(60, 20).x, exact.at(60, 20).x, 1e-3F);
    EXPECT_EQ(read(kExr / "grey_YA.exr").rgb, grey.rgb);
    expect_same(kExr / "lumachroma.exr", exact, 0.02F);
}

TEST(ExrCases, ChromaOfEveryFourthTexelIsBroughtBack) {
    const Picture exact = read(kExr / "float.exr");
    std::vector<Imf::Rgba> texels;
    for (std::size_t i = 0; i < exact.rgb.size(); i += 3) {
        texels.emplace_back(exact.rgb[i], exact.rgb[i + 1], exact.rgb[i + 2]);
    }
    const std::string path = ::testing::TempDir() + "relume_quarter_chroma.exr";
    {
        Imf::RgbaOutputFile file(path.c_str(), 128, 64, Imf::WRITE_YC);
        file.setFrameBuffer(texels.data(), 1, 128);
        file.writePixels(64);
    }
    expect_same(path, exact, 0.06F);
    std::filesystem::remove(path);
}

TEST(ExrCases, BadTexels) {
    const Picture half = read(kExr / "half.exr");
    const auto brightest = [](const Picture& picture) {
        return *std::max_element(picture.rgb.begin(), picture.rgb.end());
    };
    for (const char* name : {"sun65504.exr", "suninf.exr", "suninf_rg.exr"}) {
        EXPECT_EQ(brightest(read(kExr / name)), 65504.0F) << name;
    }
    EXPECT_GT(brightest(read(kExr / "sunfloat.exr")), 65504.0F);
    EXPECT_EQ(brightest(read(kExr / "sunfloat_inf.exr")),
              brightest(read(kExr / "sunfloat.exr")));
    for (const char* name : {"nan_neg.exr", "sun_nan_core.exr"}) {
        EXPECT_TRUE(has_warning(read(kExr / name), "NaN")) << name;
    }
    for (const char* name : {"many_bad.exr", "nan_bottom_rows.exr"}) {
        EXPECT_NE(refusal(kExr / name).find("NaN or infinite"), std::string::npos) << name;
    }
}

TEST(ExrCases, ACutFileIsIncompleteWhereverItIsCut) {
    for (const char* name : {"half.exr", "tiled.exr", "mp_beauty_depth.exr", "c_none.exr"}) {
        std::FILE* file = std::fopen((kExr / name).c_str(), "rb");
        ASSERT_NE(file, nullptr);
        std::vector<std::byte> bytes(std::filesystem::file_size(kExr / name));
        ASSERT_EQ(std::fread(bytes.data(), 1, bytes.size(), file), bytes.size());
        std::fclose(file);
        for (std::size_t length = 8; length < bytes.size(); length += bytes.size() / 61 + 1) {
            try {
                (void)import_environment(std::span(bytes).first(length));
                FAIL() << name << " cut at " << length;
            } catch (const EnvironmentError& e) {
                EXPECT_NE(std::string(e.what()).find("incomplete, copy it again"),
                          std::string::npos)
                    << name << " cut at " << length << ": " << e.what();
            }
        }
    }
}

}  // namespace
}  // namespace relume::light
