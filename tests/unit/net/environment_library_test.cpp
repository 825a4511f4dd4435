#include "server/net/library/environment_library.h"

#include "protocol/light/procedural_environment.h"
#include "protocol/wire/errors.h"
#include "tests/support/scratch_directory.h"
#include "tests/unit/net/hdr_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace relume::net {
namespace {

light::EnvironmentMap constant_map(float radiance, std::uint32_t height = 8) {
    light::MapImage image{.width = 2 * height, .height = height, .rgb = {}};
    image.rgb.assign(std::size_t{3} * image.width * image.height, radiance);
    return {std::move(image), light::Projection::lat_long};
}

std::vector<std::string> names(const EnvironmentLibrary& library, EnvironmentKind kind) {
    std::vector<std::string> found;
    for (const Environment::Description& environment : library.list()) {
        if (environment.kind == kind) {
            found.push_back(environment.name);
        }
    }
    return found;
}

TEST(EnvironmentLibrary, OffersTheProceduralOnesWithTheirSizes) {
    const EnvironmentLibrary library({});
    const auto found = names(library, EnvironmentKind::procedural);
    EXPECT_EQ(found.size(), light::procedural_environment_names().size());
    const std::string_view name = light::procedural_environment_names().back();
    const light::EnvironmentMap map = light::procedural_environment(name);
    EXPECT_EQ(library.find(name)->description().width, map.width());
    EXPECT_EQ(library.find(name)->description().height, map.height());
}

TEST(EnvironmentLibrary, PreviewIsAJpeg) {
    EnvironmentLibrary library({});
    library.add_upload("grey", constant_map(0.5F));
    const auto preview = library.find("grey")->preview_jpeg();
    ASSERT_GT(preview->size(), 4U);
    EXPECT_EQ(preview->substr(0, 3), "\xFF\xD8\xFF");
    EXPECT_EQ(library.find("grey")->preview_jpeg(), preview);
}

TEST(EnvironmentLibrary, UploadsReplaceUploadsButNothingElse) {
    EnvironmentLibrary library({});
    library.add_upload("mine", constant_map(1));
    const auto before = library.find("mine");
    library.add_upload("mine", constant_map(2));
    EXPECT_NE(library.find("mine"), before);
    // Who held the old one still has it.
    EXPECT_FLOAT_EQ(before->prefiltered(4)->source().radiance({0, 1, 0}).x, 1);
    try {
        library.add_upload("sky-noon", constant_map(1));
        FAIL() << "replaced a procedural environment";
    } catch (const wire::WireError& error) {
        EXPECT_EQ(error.code(), wire::ErrorCode::unsupported);
    }
}

TEST(EnvironmentLibrary, DropsTheOldestUnusedUploadAndRefusesWhenAllAreUsed) {
    EnvironmentLibrary library({.uploads = 2});
    library.add_upload("a", constant_map(1));
    library.add_upload("b", constant_map(1));
    auto used = library.find("a");
    library.add_upload("c", constant_map(1));
    EXPECT_EQ(names(library, EnvironmentKind::upload), (std::vector<std::string>{"a", "c"}));
    const auto also_used = library.find("c");
    try {
        library.add_upload("d", constant_map(1));
        FAIL() << "took more than the bound";
    } catch (const wire::WireError& error) {
        EXPECT_EQ(error.code(), wire::ErrorCode::too_many);
    }
    EXPECT_EQ(names(library, EnvironmentKind::upload), (std::vector<std::string>{"a", "c"}));
    used.reset();
    library.add_upload("d", constant_map(1));
    EXPECT_EQ(names(library, EnvironmentKind::upload), (std::vector<std::string>{"c", "d"}));
}

TEST(EnvironmentLibrary, BoundsTheBytesOfUploads) {
    const std::size_t one = Environment::bytes_of(constant_map(1));
    EnvironmentLibrary library({.uploads = 32, .upload_memory_bytes = 2 * one});
    for (const char* const name : {"a", "b", "c"}) {
        library.add_upload(name, constant_map(1));
        EXPECT_LE(library.resident_bytes(), 2 * one);
    }
    EXPECT_EQ(names(library, EnvironmentKind::upload), (std::vector<std::string>{"b", "c"}));
    EXPECT_THROW(library.add_upload("large", constant_map(1, 64)), wire::WireError);
    // The refused one took none of the others with it that could have stayed in use.
    library.add_upload("b", constant_map(3));
    EXPECT_FLOAT_EQ(library.find("b")->prefiltered(4)->source().radiance({0, 1, 0}).x, 3);
}

TEST(ResidentCache, LetsGoOfTheLongestUnused) {
    ResidentCache cache(10);
    auto make = [](std::weak_ptr<const int>& watch) {
        auto object = std::make_shared<const int>(1);
        watch = object;
        return object;
    };
    std::weak_ptr<const int> a;
    std::weak_ptr<const int> b;
    std::weak_ptr<const int> c;
    std::weak_ptr<const int> large;
    cache.keep(make(a), 4);
    cache.keep(make(b), 4);
    cache.keep(a.lock(), 4);
    cache.keep(make(c), 4);
    EXPECT_FALSE(a.expired());
    EXPECT_TRUE(b.expired());
    EXPECT_FALSE(c.expired());
    EXPECT_EQ(cache.bytes(), 8U);
    cache.keep(make(large), 11);
    EXPECT_TRUE(large.expired());
    EXPECT_EQ(cache.bytes(), 8U);
}

}  // namespace
}  // namespace relume::net
