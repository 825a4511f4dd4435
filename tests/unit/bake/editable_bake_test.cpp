// A bake of an image whose materials people edit under any light.
#include "precompute/bake/bake.h"
#include "precompute/bake/base/error.h"
#include "precompute/bake/fields/field_bake.h"
#include "precompute/bake/inspect.h"
#include "precompute/bake/receivers/pixel/pixel_receivers.h"
#include "precompute/bake/relight.h"
#include "precompute/bake/rows/light_texels.h"
#include "precompute/scene/builtin.h"
#include "protocol/base/program/usage.h"
#include "protocol/basis/cubemap.h"
#include "protocol/brdf/diffuse_lobe.h"
#include "protocol/brdf/local_frame.h"
#include "protocol/curve/curve_json.h"
#include "protocol/transport/transport.h"
#include "tests/support/scratch_directory.h"
#include "tests/unit/bake/file_bytes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace relume::bake {
namespace {

namespace fs = std::filesystem;

class EditableBake : public testing::Test {
  protected:
    [[nodiscard]] std::shared_ptr<const transport::Transport> baked(
        const char* name, const FieldRequest& fields) const {
        bake(scene_, parameters_, path(name), {}, {}, fields);
        return transport::Transport::open(path(name));
    }
    [[nodiscard]] fs::path path(const char* name) const { return scratch_.path() / name; }
    // What refuses the request; "none" where nothing does.
    [[nodiscard]] std::string fault(const FieldRequest& fields) const {
        try {
            bake(scene_, parameters_, path("fault"), {}, {}, fields);
        } catch (const program::UsageError& error) {
            return error.what();
        } catch (const BakeError& error) {
            return error.what();
        }
        return "none";
    }
    void expect_fault(const FieldRequest& fields, const std::string& named) const {
        const std::string found = fault(fields);
        EXPECT_NE(found.find(named), std::string::npos) << found << " / " << named;
    }

    // Built once, for it takes a second.
    static const scene::Scene& earrings() {
        static const scene::Scene scene = scene::build_builtin_scene("earrings");
        return scene;
    }

    scene::Scene scene_ = earrings();
    BakeParameters parameters_{.width = 40,
                               .height = 32,
                               .face_resolution = 8,
                               .bounces = 1,
                               .samples = 8,
                               .pixel_samples = 4};
    test::ScratchDirectory scratch_;
};

TEST_F(EditableBake, HoldsWhatItsMaterialsAreAndWhatTheirPointsSee) {
    const auto transport = baked("e.relume", {.editable = {"pearl", "cloth", "pedestal"}});
    EXPECT_TRUE(find_faults(path("e.relume")).empty());
    const transport::Manifest& manifest = transport->manifest();
    EXPECT_EQ(manifest.kind, transport::Kind::image);
    ASSERT_TRUE(manifest.materials);
    ASSERT_EQ(manifest.materials->editable.size(), 3U);
    const transport::EditableRecord& pearl = manifest.materials->editable[0];
    EXPECT_EQ(pearl.id, "pearl");
    EXPECT_NO_THROW((void)curve::curve_brdf_from_json(pearl.brdf, "pearl"));
    EXPECT_TRUE(manifest.materials->editable[2].brdf.is_null());
    EXPECT_FALSE(manifest.materials->editable[2].coat);
    for (const transport::EditableRecord& record : manifest.materials->editable) {
        const auto material =
            std::find_if(scene_.materials.begin(), scene_.materials.end(),
                         [&](const scene::Material& one) { return one.name == record.name; });
        EXPECT_EQ(record.coat.has_value(), material->model == scene::BsdfModel::ggx);
    }
    EXPECT_EQ(manifest.materials->visibility.face_resolution, 8U);
    EXPECT_EQ(manifest.bake.at("editable").size(), 3U);
    EXPECT_EQ(manifest.bake.at("visibility_resolution"), 8);
    EXPECT_TRUE(fs::exists(path("e.relume") / "view/materials.png"));
    EXPECT_FALSE(fs::exists(path("e.relume") / "partial"));

    // Shares by slot and material are those of the pixels' surfaces.
    const RayCaster caster(scene_);
    const PixelReceivers pixels(caster, parameters_);
    for (std::uint32_t block = 0; block < manifest.block_count(); ++block) {
        std::map<std::pair<std::uint32_t, std::size_t>, float> found;
        for (const transport::SeenPoint& point : transport->seen_points()->of_block(block)) {
            found[{point.slot, point.material}] += point.share;
        }
        for (std::uint32_t slot = 0; slot < transport::kBlockSize; ++slot) {
            const auto receiver = pixels.receiver_at(block, slot);
            for (std::size_t m = 0; m < 3; ++m) {
                float share = 0;
                if (receiver) {
                    for (const ReceiverSurface& surface : pixels.look(*receiver).surfaces) {
                        const std::string& name = scene_.materials[surface.material].name;
                        share +=
                            name == manifest.materials->editable[m].name ? surface.share : 0;
                    }
                }
                const auto at = found.find({slot, m});
                EXPECT_NEAR(at == found.end() ? 0 : at->second, share, 1e-3);
            }
        }
    }
    const std::string text = text_from_description(describe(path("e.relume")));
    EXPECT_NE(text.find("edited under any light: pearl, cloth, pedestal"), std::string::npos)
        << text;
    EXPECT_NE(text.find("% open"), std::string::npos) << text;
}

TEST_F(EditableBake, HasTheLightOfABakeWithoutItBitForBit) {
    const auto with = baked("with.relume", {.editable = {"pearl", "cloth"}});
    const auto without = baked("without.relume", {});
    ASSERT_EQ(with->manifest().shards.size(), without->manifest().shards.size());
    for (std::size_t i = 0; i < with->manifest().shards.size(); ++i) {
        const std::string& file = with->manifest().shards[i].file;
        // After the header, which has the fingerprint.
        constexpr std::size_t kHeader = 128;
        EXPECT_TRUE(bytes_of(path("with.relume") / file).substr(kHeader) ==
                    bytes_of(path("without.relume") / file).substr(kHeader));
    }
    for (const char* file : {"columns.bin", "receivers.bin", "sketch.bin"}) {
        EXPECT_TRUE(bytes_of(path("with.relume") / file) ==
                    bytes_of(path("without.relume") / file))
            << file;
    }
    EXPECT_FALSE(without->manifest().materials);
    EXPECT_FALSE(fs::exists(path("without.relume") / "visibility.bin"));
    EXPECT_FALSE(fs::exists(path("without.relume") / "view/materials.png"));
    EXPECT_FALSE(without->manifest().measured.contains("visibility"));
    EXPECT_NE(with->manifest().fingerprint, without->manifest().fingerprint);
}

TEST_F(EditableBake, GivesTheSameBytesOnAnyNumberOfThreads) {
    std::vector<std::map<std::string, std::string>> files;
    for (const std::uint32_t threads : {1U, 3U}) {
        parameters_.threads = threads;
        const std::string name = std::to_string(threads);
        (void)baked(name.c_str(), {.editable = {"pearl", "cloth"}, .resolution = 4});
        for (const char* file : {"manifest.json", "visibility.bin", "points.bin"}) {
            files.resize(threads == 1 ? 1 : 2);
            files.back()[file] = bytes_of(path(name.c_str()) / file);
        }
    }
    EXPECT_TRUE(files[0] == files[1]);
    EXPECT_GT(files[0].at("points.bin").size(), 1000U);
}

TEST_F(EditableBake, GoesOnAfterAnInterruptionAndGivesTheSameBytes) {
    // More than one part of visibility.
    parameters_.width = 16 * 33;
    parameters_.height = 48;
    parameters_.face_resolution = 4;
    parameters_.samples = 2;
    parameters_.threads = 1;
    const FieldRequest fields{.editable = {"cloth", "pedestal"}, .resolution = {}};
    const BakeSummary whole = bake(scene_, parameters_, path("whole"), {}, {}, fields);
    EXPECT_GT(whole.field_points, 1000U);
    EXPECT_GT(whole.field_rays, whole.field_points);
    EXPECT_EQ(whole.field_points_resumed, 0U);

    bool in_second_part = false;
    const BakeHooks stop{.on_progress =
                             [&](const BakeProgress& progress) {
                                 in_second_part =
                                     progress.stage == BakeStage::visibility &&
                                     fs::exists(path("again") / "partial/00000000.fields");
                             },
                         .should_stop = [&] { return in_second_part; }};
    EXPECT_THROW(bake(scene_, parameters_, path("again"), stop, {}, fields), BakeInterrupted);
    EXPECT_FALSE(fs::exists(path("again") / "manifest.json"));
    const BakeSummary resumed = bake(scene_, parameters_, path("again"), {}, {}, fields);
    EXPECT_EQ(resumed.shards_resumed, resumed.shards);
    EXPECT_GT(resumed.field_points_resumed, 0U);
    EXPECT_LT(resumed.field_points_resumed, resumed.field_points);
    EXPECT_LT(resumed.field_rays, whole.field_rays);
    for (const char* file :
         {"manifest.json", "visibility.bin", "points.bin", "shards/00000.shard"}) {
        EXPECT_TRUE(bytes_of(path("again") / file) == bytes_of(path("whole") / file)) << file;
    }
    // Another request takes none of it over.
    EXPECT_EQ(bake(scene_, parameters_, path("again"), {}, {}, {.editable = {"cloth"}})
                  .field_points_resumed,
              0U);
}

// Light that each pixel gets directly by the BRDFs of editable materials, from the files alone,
// as protocol/README.md §2 has it; the integral over each texel is its middle's.
DenseImage direct_light(const transport::Transport& transport, const CubemapLight& light) {
    const transport::Manifest& manifest = transport.manifest();
    const auto& editable = manifest.materials->editable;
    std::vector<std::optional<curve::CurveBrdf>> brdfs;
    for (const transport::EditableRecord& record : editable) {
        brdfs.emplace_back();
        if (!record.brdf.is_null()) {
            brdfs.back() = curve::curve_brdf_from_json(record.brdf, record.id);
        }
    }
    const auto& [width, height] = manifest.image();
    DenseImage image{.width = width, .height = height, .rgb = {}, .coverage = {}};
    for (auto& plane : image.rgb) {
        plane.resize(std::size_t{width} * height);
    }
    const LightTexels texels(manifest.materials->visibility.face_resolution, 0);
    const std::size_t words = transport.visibility()->words_per_point();
    std::vector<std::uint64_t> bits;
    for (std::uint32_t block = 0; block < manifest.block_count(); ++block) {
        transport.visibility()->read(block, bits);
        const auto points = transport.seen_points()->of_block(block);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const transport::SeenPoint& point = points[i];
            const brdf::Frame frame = brdf::local_frame(point.normal);
            const Imath::V3f wo = frame.local_from_world(point.wo);
            brdf::DiffuseLobe diffuse{.colour = point.diffuse, .coat = {}};
            if (const auto& coat = editable[point.material].coat) {
                diffuse.coat = brdf::Coat{.f0 = coat->f0, .f90 = coat->f90};
            }
            Imath::V3d sum(0, 0, 0);
            for (std::size_t place = 0; place < texels.size(); ++place) {
                const std::size_t texel = texels.texel_index(place);
                const Imath::V3f world(texels.direction_x()[place], texels.direction_y()[place],
                                       texels.direction_z()[place]);
                const Imath::V3f wi = frame.local_from_world(world);
                if (!transport::is_open(std::span(bits).subspan(i * words, words), texel) ||
                    wi.z <= 0 || world.dot(point.geometric_normal) <= 0) {
                    continue;
                }
                Imath::V3f reflected = diffuse.times_cosine(wi.z, wo.z);
                if (brdfs[point.material]) {
                    reflected += brdfs[point.material]->evaluate(wi, wo) * wi.z;
                }
                for (int c = 0; c < 3; ++c) {
                    sum[c] += double{reflected[c]} * light[static_cast<std::size_t>(c)][texel] *
                              texels.solid_angle_sr()[place];
                }
            }
            const std::uint32_t tiles_x = manifest.image().tiles_x();
            const std::uint32_t x = block % tiles_x * 16 + point.slot % 16U;
            const std::uint32_t y = block / tiles_x * 16 + point.slot / 16U;
            for (std::size_t c = 0; c < 3; ++c) {
                image.rgb[c][std::size_t{y} * width + x] +=
                    double{point.share} * sum[static_cast<int>(c)];
            }
        }
    }
    return image;
}

CubemapLight light_from_the_left(std::uint32_t n, float elsewhere) {
    CubemapLight light;
    for (std::size_t c = 0; c < 3; ++c) {
        light[c].resize(basis::texel_count(n));
        for (std::size_t texel = 0; texel < light[c].size(); ++texel) {
            const Imath::V3f direction =
                basis::direction_from_texel(n, basis::texel_from_index(n, texel));
            light[c][texel] =
                elsewhere + (1 - elsewhere) * (direction.dot({-0.6F, 0.7F, 0.4F}) > 0.6F
                                                   ? static_cast<float>(c + 1)
                                                   : 0.0F);
        }
    }
    return light;
}

double relative_l2(const DenseImage& image, const DenseImage& truth) {
    double difference = 0;
    double norm = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t pixel = 0; pixel < truth.rgb[c].size(); ++pixel) {
            difference += std::pow(image.rgb[c][pixel] - truth.rgb[c][pixel], 2);
            norm += std::pow(truth.rgb[c][pixel], 2);
        }
    }
    return std::sqrt(difference / norm);
}

// Under radiance 1 from everywhere an open diffuse surface shows its colour.
TEST_F(EditableBake, BitsOfAnOpenPlaneGiveItsIrradiance) {
    scene_ = scene::build_builtin_scene("plane");
    scene_.materials[0].base_colour = {0.8F, 0.4F, 0.2F};
    parameters_.face_resolution = 16;
    const auto transport = baked("p.relume", {.editable = {scene_.materials[0].name}});
    const DenseImage shown = direct_light(*transport, light_from_the_left(16, 1));
    for (std::size_t c = 0; c < 3; ++c) {
        for (const double value : shown.rgb[c]) {
            const double colour = double{scene_.materials[0].base_colour[static_cast<int>(c)]};
            EXPECT_NEAR(value, colour, 5e-3 * colour);
        }
    }
}

// What rows of direct light say of a scene, the points say as well: in shadows of a diffuse
// room, and by highlight, coat and diffuse layer of an open plane.
TEST_F(EditableBake, BitsAndRowsAgreeOnDirectLight) {
    parameters_.bounces = 0;
    parameters_.face_resolution = 16;
    parameters_.pixel_samples = 16;
    const auto error = [&](const char* scene, const scene::Material& material) {
        scene_ = scene::build_builtin_scene(scene);
        FieldRequest fields;
        for (scene::Material& one : scene_.materials) {
            fields.editable.push_back(one.name);
            if (material.model != scene::BsdfModel::lambert) {
                const std::string name = one.name;
                one = material;
                one.name = name;
            }
        }
        const std::string name = std::string(scene) + std::to_string(int(material.model));
        const auto transport = baked(name.c_str(), fields);
        const CubemapLight light = light_from_the_left(16, 0.1F);
        const double found =
            relative_l2(direct_light(*transport, light), relight(*transport, light));
        std::printf("  %s: relative L2 to its rows: %.4f\n", name.c_str(), found);
        return found;
    };
    EXPECT_LT(error("box", {}), 0.05);
    EXPECT_LT(error("plane", {.model = scene::BsdfModel::ggx,
                              .base_colour = {0.7F, 0.5F, 0.3F},
                              .metallic = 0.3F,
                              .roughness = 0.6F}),
              0.02);
    EXPECT_LT(error("plane", {.model = scene::BsdfModel::phong,
                              .base_colour = {0.3F, 0.2F, 0.3F},
                              .specular = {0.3F, 0.4F, 0.3F},
                              .exponent = 12}),
              0.02);
    EXPECT_LT(error("thin", {.model = scene::BsdfModel::ggx,
                             .base_colour = {0.7F, 0.5F, 0.3F},
                             .roughness = 0.5F}),
              0.1);
}

TEST_F(EditableBake, SaysWhichMaterialNoPixelSees) {
    scene::Material hidden = scene_.materials[0];
    hidden.name = "hidden";
    scene_.materials.push_back(hidden);
    (void)baked("h.relume", {.editable = {"hidden", "pearl"}});
    const std::string text = text_from_description(describe(path("h.relume")));
    EXPECT_NE(text.find("no pixel sees the edited material hidden"), std::string::npos);
    (void)baked("none.relume", {.editable = {"hidden"}});
    EXPECT_TRUE(find_faults(path("none.relume")).empty());
    EXPECT_EQ(transport::Transport::open(path("none.relume"))->seen_points()->point_count(),
              0U);
}

TEST_F(EditableBake, SaysWhoseHighlightHasTextures) {
    scene_.materials[0].surface_texture = scene::TextureUse(0);
    scene_.textures.assign(1, scene::Texture("plain", 1, 1, std::vector<half>(4, half(0.5F))));
    (void)baked("t.relume", {.editable = {scene_.materials[0].name}});
    const std::string text = text_from_description(describe(path("t.relume")));
    EXPECT_NE(text.find("without its textures"), std::string::npos) << text;
}

TEST_F(EditableBake, NamesWhatIsWrong) {
    expect_fault({.editable = {"perl"}}, "did you mean pearl");
    expect_fault({.editable = {"pearl", "pearl"}}, "listed twice");
    expect_fault({.editable = std::vector<std::string>(17, "pearl")}, "at most 16");
    expect_fault({.editable = {"pearl"}, .resolution = 16}, "the light's 8");
    expect_fault({.editable = {"pearl"}, .resolution = 6}, "power of two");
    expect_fault({.editable = {}, .resolution = 8}, "--editable MATERIAL");
    parameters_.receivers = ReceiverKind::vertices;
    expect_fault({.editable = {"pearl"}}, "--receivers vertices");
    EXPECT_FALSE(fs::exists(path("fault") / "manifest.json"));
}

TEST(FieldBytes, AreBounded) {
    EXPECT_EQ(uncompressed_bytes(10, 4), 10U * 16);
    EXPECT_NO_THROW(check_field_bytes(kMostFieldBytes / 3072, 64, "less"));
    try {
        check_field_bytes(kMostFieldBytes / 3072 + 1, 64, "a coarser cubemap");
        FAIL();
    } catch (const BakeError& error) {
        EXPECT_NE(std::string(error.what()).find("a coarser cubemap"), std::string::npos);
    }
}

}  // namespace
}  // namespace relume::bake
