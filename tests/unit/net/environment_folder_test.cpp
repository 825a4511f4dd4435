// Maps that come, change and go while the server runs.
#include "server/net/library/environment_folder.h"

#include "protocol/light/environment_error.h"
#include "tests/unit/net/hdr_file.h"
#include "tests/unit/net/room_fixture.h"

#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace relume::net {
namespace {

namespace fs = std::filesystem;

constexpr light::MapCentre kCentre = light::MapCentre::negative_z;

std::vector<std::string> names(const EnvironmentLibrary& library, EnvironmentKind kind) {
    std::vector<std::string> found;
    for (const auto& environment : library.list()) {
        if (environment.kind == kind) {
            found.push_back(environment.name);
        }
    }
    return found;
}

float radiance_of(const EnvironmentLibrary& library, const char* name) {
    return library.find(name)->prefiltered(4)->source().radiance({0, 0, -1}).x;
}

TEST(EnvironmentFolder, TakesWhatCanBeUsedOfAFolder) {
    const test::ScratchDirectory scratch;
    write_hdr(scratch.path() / "good.hdr", 16, 8, 0.5F);
    write_hdr(scratch.path() / "odd-shape.hdr", 17, 5, 1);
    write_hdr(scratch.path() / "bad name.hdr", 16, 8, 1);
    std::ofstream(scratch.path() / "broken.exr") << "this is no image";
    std::ofstream(scratch.path() / "notes.txt") << "nor is this";
    EnvironmentLibrary library({});
    EnvironmentFolder(library, scratch.path(), kCentre).refresh();
    EXPECT_EQ(names(library, EnvironmentKind::file), std::vector<std::string>{"good"});
    const auto good = library.find("good")->prefiltered(4);
    EXPECT_NEAR(good->source().radiance({0, 0, -1}).x, 0.5F, 0.01F);
}

TEST(EnvironmentFolder, AFileThatFailsLaterFailsByName) {
    const test::ScratchDirectory scratch;
    write_hdr(scratch.path() / "short.hdr", 64, 32, 0.5F);
    EnvironmentLibrary library({});
    EnvironmentFolder(library, scratch.path(), kCentre).refresh();
    std::filesystem::resize_file(scratch.path() / "short.hdr", 200);
    const auto environment = library.find("short");
    EXPECT_THROW(static_cast<void>(environment->prefiltered(4)), light::EnvironmentError);
    EXPECT_THROW(static_cast<void>(environment->preview_jpeg()), light::EnvironmentError);
}

// As a careful program does: whole, or not at all.
void write_whole(const fs::path& file, float radiance) {
    const fs::path aside = file.parent_path() / "aside" / "map.hdr";
    fs::create_directories(aside.parent_path());
    write_hdr(aside, 16, 8, radiance);
    fs::rename(aside, file);
}

class ChangingFolder : public testing::Test {
  protected:
    ChangingFolder() {
        write(1, "map.hdr");
        folder_.refresh();
        version_ = version();
    }
    void write(float radiance, const char* file) const {
        write_whole(scratch_.path() / file, radiance);
    }
    [[nodiscard]] std::uint64_t version(const char* name = "map") const {
        return library_.find(name)->description().version;
    }

    test::ScratchDirectory scratch_;
    EnvironmentLibrary library_{EnvironmentBounds{}};
    EnvironmentFolder folder_{library_, scratch_.path(), kCentre};
    std::uint64_t version_ = 0;
};

TEST_F(ChangingFolder, OffersWhatComes) {
    write(2, "second.hdr");
    folder_.refresh();
    EXPECT_EQ(names(library_, EnvironmentKind::file),
              (std::vector<std::string>{"map", "second"}));
    EXPECT_GT(version("second"), version_);
    EXPECT_EQ(version(), version_) << "what stayed is what it was";
}

TEST_F(ChangingFolder, AReplacedFileIsANewVersionAndIsTold) {
    std::vector<std::string> told;
    library_.when_replaced([&told](const std::string& name) { told.push_back(name); });
    EXPECT_NEAR(radiance_of(library_, "map"), 1, 0.01F);
    const auto held = library_.find("map")->prefiltered(4);
    write(2, "map.hdr");
    folder_.refresh();
    EXPECT_EQ(told, std::vector<std::string>{"map"});
    EXPECT_GT(version(), version_);
    EXPECT_NEAR(radiance_of(library_, "map"), 2, 0.01F);
    EXPECT_NEAR(held->source().radiance({0, 0, -1}).x, 1, 0.01F) << "who holds it keeps it";
    folder_.refresh();
    EXPECT_EQ(told.size(), 1U);
}

TEST_F(ChangingFolder, TakesBackWhatIsGone) {
    fs::remove(scratch_.path() / "map.hdr");
    folder_.refresh();
    EXPECT_EQ(library_.find("map"), nullptr);
    write(3, "map.hdr");
    folder_.refresh();
    EXPECT_GT(version(), version_);
}

TEST_F(ChangingFolder, AFileThatIsBeingCopiedIsWaitedFor) {
    write(2, "map.hdr");
    folder_.refresh(Patience::until_settled);
    EXPECT_EQ(version(), version_);
    folder_.refresh(Patience::until_settled);
    EXPECT_GT(version(), version_);
}

TEST_F(ChangingFolder, ABrokenFileLeavesWhatWasOffered) {
    const auto held = library_.find("map")->prefiltered(4);
    std::ofstream(scratch_.path() / "broken.tmp") << "this is no image";
    fs::rename(scratch_.path() / "broken.tmp", scratch_.path() / "map.hdr");
    folder_.refresh();
    EXPECT_EQ(version(), version_);
    write(2, "map.hdr");
    folder_.refresh();
    EXPECT_GT(version(), version_);
}

TEST_F(ChangingFolder, OneNameIsOneFilesUntilThatIsGone) {
    fs::copy(scratch_.path() / "map.hdr", scratch_.path() / "map.HDR");
    folder_.refresh();
    EXPECT_EQ(version(), version_);
    fs::remove(scratch_.path() / "map.hdr");
    folder_.refresh();
    ASSERT_NE(library_.find("map"), nullptr);
    EXPECT_GT(version(), version_);
}

TEST_F(ChangingFolder, NeitherUploadsNorFormulasGiveWay) {
    library_.add_upload("mine", {{16, 8, std::vector<float>(std::size_t{3} * 16 * 8, 7)},
                                 light::Projection::lat_long});
    write(2, "mine.hdr");
    write(2, "sky-noon.hdr");
    folder_.refresh();
    EXPECT_EQ(library_.find("mine")->description().kind, EnvironmentKind::upload);
    EXPECT_EQ(library_.find("sky-noon")->description().kind, EnvironmentKind::procedural);
    fs::remove(scratch_.path() / "mine.hdr");
    folder_.refresh();
    EXPECT_NE(library_.find("mine"), nullptr);
}

TEST_F(ChangingFolder, APipeIsNoMapAndHoldsNobody) {
    ASSERT_EQ(::mkfifo((scratch_.path() / "pipe.hdr").c_str(), 0600), 0);
    folder_.refresh();
    EXPECT_EQ(library_.find("pipe"), nullptr);
}

using EnvironmentFolderInARoom = RoomFixture;

TEST_F(EnvironmentFolderInARoom, ARoomIsRelitByTheFileThatReplacesItsMap) {
    const test::ScratchDirectory scratch;
    write_hdr(scratch.path() / "day.hdr", 16, 8, 1);
    EnvironmentFolder folder(environments_, scratch.path(), kCentre);
    folder.refresh();
    environments_.when_replaced(
        [this](const std::string& name) { rooms_->environment_replaced(name); });
    const Seat viewer = enter(ImageInterest::settled);
    viewer.edit({{"environment", {{"name", "day"}}}});
    const SharedImageFrame before = settled_image(viewer, 1);
    ASSERT_TRUE(before);
    write_whole(scratch.path() / "day.hdr", 2);
    folder.refresh();
    const SharedImageFrame after = settled_image(viewer, 2);
    ASSERT_TRUE(after);
    EXPECT_NE(payload_of(after), payload_of(before));
    // One that is gone lights on whom it lit.
    fs::remove(scratch.path() / "day.hdr");
    folder.refresh();
    viewer.edit({{"environment", {{"gain", 0.5}}}});
    const SharedImageFrame dimmed = settled_image(viewer, 3);
    ASSERT_TRUE(dimmed);
    EXPECT_EQ(payload_of(dimmed), payload_of(before));
}

}  // namespace
}  // namespace relume::net
