// Materials that people edit under any light: their section of the manifest, and a directory
// that has one.
#include "protocol/transport/materials_section.h"

#include "protocol/curve/curve_json.h"
#include "protocol/transport/transport.h"
#include "protocol/transport/transport_writer.h"
#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_materials.h"
#include "tests/support/tiny_transport.h"
#include "tests/unit/transport/broken_bytes.h"
#include "tests/unit/transport/changed_manifest.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>

namespace relume::transport {
namespace {

std::vector<EditableRecord> editable() {
    const auto gold = curve::CurveBrdf::ggx({0.9F, 0.7F, 0.3F}, 1, 0.1F);
    return {
        {.id = "post", .name = "Post", .brdf = curve::json_from_curve_brdf(gold), .coat = {}},
        {.id = "cloth", .name = "Cloth", .brdf = nullptr, .coat = {}},
        {.id = "pearl",
         .name = "Pearl",
         .brdf = curve::json_from_curve_brdf(gold),
         .coat = CoatRecord{.f0 = 0.04F, .f90 = 0.5F}}};
}

Manifest sample() {
    Manifest manifest;
    manifest.generator = "test";
    manifest.layout = ReceiverLayout::pixel_tiles({.width = 20, .height = 16});
    manifest.signal_basis = basis::CubemapBasis::haar(8);
    manifest.stating_rows = 64;
    manifest.choosing_rows = 32;
    manifest.columns.file = "columns.bin";
    manifest.receivers.file = "receivers.bin";
    manifest.sketch.file = "sketch.bin";
    manifest.colour.matrix = {{{1}, {1}, {1}}};
    manifest.shards = {{.file = "shards/00000.shard",
                        .bytes = 1,
                        .header_checksum = 2,
                        .first_block = 0,
                        .block_count = 2}};
    manifest.materials =
        MaterialsSection{.visibility = {.face_resolution = 8, .file = {"visibility.bin", 3, 4}},
                         .points = {"points.bin", 5, 6},
                         .editable = editable()};
    return manifest;
}

TEST(MaterialsSection, ComesBackFromItsText) {
    const std::string text = text_from_manifest(sample());
    const Manifest again = manifest_from_text(text, "m");
    EXPECT_EQ(text_from_manifest(again), text);
    EXPECT_EQ(again.materials->editable, editable());
    EXPECT_EQ(again.materials->visibility.face_resolution, 8U);
    EXPECT_EQ(again.materials->visibility.file.checksum, 4U);
    EXPECT_EQ(again.materials->points.bytes, 5U);
}

TEST(MaterialsSection, NamesWhatIsWrong) {
    struct Wrong {
        const char* place;
        std::function<void(nlohmann::json&)> change;
    };
    const Wrong wrong[] = {
        {"materials.editable", [](auto& m) { m["editable"] = nlohmann::json::array(); }},
        {"materials.editable: found 17",
         [](auto& m) { m["editable"] = nlohmann::json::array_t(17, m["editable"][0]); }},
        {"materials.editable", [](auto& m) { m.erase("editable"); }},
        {"materials.points", [](auto& m) { m.erase("points"); }},
        {"materials.points.file", [](auto& m) { m["points"]["file"] = "/etc/passwd"; }},
        {"materials.visibility.xxh3", [](auto& m) { m["visibility"]["xxh3"] = 1; }},
        {"materials.visibility.face_resolution",
         [](auto& m) { m["visibility"]["face_resolution"] = 12; }},
        {"materials.editable[1].id", [](auto& m) { m["editable"][1]["id"] = "post"; }},
        {"materials.editable[1].id", [](auto& m) { m["editable"][1]["id"] = "a b"; }},
        {"materials.editable[0].brdf", [](auto& m) { m["editable"][0].erase("brdf"); }},
        {"materials.editable[0].brdf",
         [](auto& m) { m["editable"][0]["brdf"]["model"] = "mirror"; }},
        {"materials.editable[2].coat", [](auto& m) { m["editable"][2]["coat"]["f0"] = 0.6; }},
        {"materials.editable[2].coat", [](auto& m) { m["editable"][2]["coat"]["f90"] = 2; }},
        {"materials.editable[2].coat", [](auto& m) { m["editable"][2]["coat"] = 1; }},
    };
    for (const auto& [place, change] : wrong) {
        try {
            (void)manifest_from_text(
                changed_text(sample(), [&](auto& object) { change(object["materials"]); }),
                "m");
            ADD_FAILURE() << place;
        } catch (const TransportError& error) {
            test::expect_refusal(error.what(), place);
        }
    }
}

// A directory of 40×24 pixels, six blocks, with points in two of them.
class EditableDirectory : public testing::Test {
  protected:
    EditableDirectory() {
        test::write_tiny_transport(path_);
        const VisibilityFieldBuilder bits = visibility(3);
        write(bits, points());
    }

    static SeenPointsBuilder points() {
        SeenPointsBuilder points(6);
        points.set_block(4, std::vector<SeenPoint>(3, {.slot = 7, .share = 0.25F}));
        points.set_block(1, std::vector<SeenPoint>(1, {.slot = 0, .material = 2, .share = 1}));
        return points;
    }
    static VisibilityFieldBuilder visibility(std::size_t points_of_block_4) {
        VisibilityFieldBuilder visibility(8, 6);
        visibility.set_block(4, std::vector<std::uint64_t>(6 * points_of_block_4, 0xff));
        visibility.set_block(1, std::vector<std::uint64_t>(6, 0x1));
        return visibility;
    }

    void write(const VisibilityFieldBuilder& visibility, const SeenPointsBuilder& points) {
        test::add_materials(path_, visibility, points, editable());
    }

    [[nodiscard]] std::string refusal() const {
        try {
            (void)Transport::open(path_);
            return "";
        } catch (const TransportError& error) {
            return error.what();
        }
    }

    test::ScratchDirectory scratch_;
    std::filesystem::path path_ = scratch_.path() / "tiny.relume";
};

TEST_F(EditableDirectory, OpensWithItsPoints) {
    const auto transport = Transport::open(path_);
    ASSERT_TRUE(transport->visibility() && transport->seen_points());
    EXPECT_EQ(transport->visibility()->point_count(), 4U);
    std::vector<std::uint64_t> bits;
    transport->visibility()->read(1, bits);
    EXPECT_EQ(bits, std::vector<std::uint64_t>(6, 0x1));
    EXPECT_EQ(transport->seen_points()->of_block(4).size(), 3U);
    EXPECT_EQ(transport->seen_points()->of_block(1).front().material, 2);
}

TEST_F(EditableDirectory, FilesThatDoNotBelongTogetherAreRefused) {
    write(visibility(2), points());
    test::expect_refusal(refusal(), "points of block 4: found 2, expected 3");
    write(VisibilityFieldBuilder(8, 5), SeenPointsBuilder(5));
    test::expect_refusal(refusal(), "blocks: found 5, expected 6");
    write(VisibilityFieldBuilder(8, 6), SeenPointsBuilder(5));
    test::expect_refusal(refusal(), "blocks beside those of its points: found 6, expected 5");
}

TEST_F(EditableDirectory, ABrokenFileIsNamed) {
    for (const char* name : {"visibility.bin", "points.bin"}) {
        const auto file = path_ / name;
        const auto kept = scratch_.path() / "kept";
        std::filesystem::copy_file(file, kept);
        std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
        test::expect_refusal(refusal(), std::string(name) + ": ");
        std::filesystem::remove(file);
        test::expect_refusal(refusal(), name);
        std::filesystem::copy_file(kept, file);
        std::fstream(file, std::ios::in | std::ios::out).seekp(20).put('x');
        test::expect_refusal(refusal(), std::string(name) + ": checksum");
        std::filesystem::remove(file);
        std::filesystem::rename(kept, file);
    }
}

}  // namespace
}  // namespace relume::transport
