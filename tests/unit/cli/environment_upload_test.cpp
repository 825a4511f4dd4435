#include "client/cli/environment_upload.h"

#include "client/cli/client_error.h"
#include "protocol/wire/names.h"

#include <gtest/gtest.h>

namespace relume::cli {
namespace {

TEST(UploadNames, AreValidWhateverTheFileIsCalled) {
    for (const char* file : {"city.hdr", "/a/b/Meine Küche (1).exr", ".hdr", "..hdr", "...", "",
                             "a/.hidden.hdr", "~!@#.hdr"}) {
        EXPECT_TRUE(wire::is_name(upload_name(file, "x", ""))) << upload_name(file, "x", "");
    }
    EXPECT_TRUE(wire::is_name(upload_name(std::string(300, 'n') + ".hdr", "x", "")));
    EXPECT_TRUE(upload_name("city.hdr", "x", "").starts_with("city-"));
}

TEST(UploadNames, FollowContentAndProjection) {
    EXPECT_EQ(upload_name("a.hdr", "x", ""), upload_name("b/a.exr", "x", ""));
    EXPECT_NE(upload_name("a.hdr", "x", ""), upload_name("a.hdr", "y", ""));
    EXPECT_NE(upload_name("a.hdr", "x", ""), upload_name("a.hdr", "x", "latlong"));
}

TEST(Environments, ANameNeedsNoServerButAMissingFileIsNamed) {
    const Url nowhere{"127.0.0.1", "1", ""};
    EXPECT_EQ(environment_on_server(nowhere, "", "city", ""), "city");
    EXPECT_THROW(static_cast<void>(environment_on_server(nowhere, "", "missing.hdr", "")),
                 ClientError);
    EXPECT_THROW(static_cast<void>(environment_on_server(nowhere, "", "a/b", "")), ClientError);
}

}  // namespace
}  // namespace relume::cli
