#include "client/cli/environment_upload.h"

#include "client/cli/client_error.h"
#include "protocol/base/text/names.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>

#include <fstream>

namespace relume::cli {
namespace {

TEST(UploadNames, AreValidWhateverTheFileIsCalled) {
    for (const char* file : {"city.hdr", "/a/b/Meine Küche (1).exr", ".hdr", "..hdr", "...", "",
                             "a/.hidden.hdr", "~!@#.hdr"}) {
        EXPECT_TRUE(text::is_name(upload_name(file, "x", {}))) << upload_name(file, "x", {});
    }
    EXPECT_TRUE(text::is_name(upload_name(std::string(300, 'n') + ".hdr", "x", {})));
    EXPECT_TRUE(upload_name("city.hdr", "x", {}).starts_with("city-"));
}

TEST(UploadNames, FollowContentAndProjection) {
    EXPECT_EQ(upload_name("a.hdr", "x", {}), upload_name("b/a.exr", "x", {}));
    EXPECT_NE(upload_name("a.hdr", "x", {}), upload_name("a.hdr", "y", {}));
    EXPECT_NE(upload_name("a.hdr", "x", {}),
              upload_name("a.hdr", "x", {.projection = "lat_long"}));
    EXPECT_NE(upload_name("a.hdr", "x", {}), upload_name("a.hdr", "x", {.centre = "+x"}));
    EXPECT_NE(upload_name("a.hdr", "x", {}), upload_name("a.hdr", "x", {.layer = "Sky"}));
}

std::string refusal_of(const std::string& file_or_name) {
    try {
        static_cast<void>(environment_on_server({"127.0.0.1", "1", ""}, "", file_or_name, {}));
        return "none";
    } catch (const ClientError& error) {
        return error.what();
    }
}

TEST(Environments, AMissingFileIsNamedWithThoseLikeItAndNoServerIsAsked) {
    const test::ScratchDirectory scratch;
    std::ofstream(scratch.path() / "studio.hdr") << "x";
    const std::string found = (scratch.path() / "studio.hdr").string();
    const std::string asked = (scratch.path() / "studoi.hdr").string();
    EXPECT_NE(refusal_of(asked).find("did you mean " + found + "?"), std::string::npos)
        << refusal_of(asked);
    EXPECT_NE(refusal_of("missing.hdr").find("no such file"), std::string::npos);
    EXPECT_NE(refusal_of("a/b").find("no such file"), std::string::npos);
}

}  // namespace
}  // namespace relume::cli
