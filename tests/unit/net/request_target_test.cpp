#include "server/net/http/request_target.h"

#include <gtest/gtest.h>

#include <string>

namespace relume::net {
namespace {

TEST(RequestTarget, SplitsAndDecodes) {
    const auto target = parse_request_target("/session/a%20b?scene=x%26y&images=settled&e=&f");
    ASSERT_TRUE(target.has_value());
    EXPECT_EQ(target->path, "/session/a b");
    EXPECT_EQ(target->parameter("scene"), "x&y");
    EXPECT_EQ(target->parameter("images"), "settled");
    EXPECT_EQ(target->parameter("e"), "");
    EXPECT_EQ(target->parameter("f"), "");
    EXPECT_FALSE(target->parameter("g").has_value());
}

TEST(RequestTarget, PlusIsASpaceInTheQueryAlone) {
    const auto target = parse_request_target("/a+b?c=d+e");
    ASSERT_TRUE(target.has_value());
    EXPECT_EQ(target->path, "/a+b");
    EXPECT_EQ(target->parameter("c"), "d e");
}

class RefusedTarget : public testing::TestWithParam<const char*> {};

TEST_P(RefusedTarget, IsRefused) {
    EXPECT_FALSE(parse_request_target(GetParam()).has_value());
}

INSTANTIATE_TEST_SUITE_P(All,
                         RefusedTarget,
                         testing::Values("",
                                         "a",
                                         "*",
                                         "http://host/path",
                                         "/%",
                                         "/%4",
                                         "/%zz",
                                         "/%+1",
                                         "/a%00b",
                                         "/a%0ab",
                                         "/a\tb",
                                         "/..",
                                         "/../etc/passwd",
                                         "/a/../b",
                                         "/a/..",
                                         "/%2e%2e/etc/passwd",
                                         "/a/%2e",
                                         "/a%2f..%2fb",
                                         "/..\\b",
                                         "/a?b=%0d%0a",
                                         "/a?b=1&b=2"));

TEST(RequestTarget, BoundsLengthAndParameters) {
    EXPECT_TRUE(parse_request_target("/" + std::string(kMaxTargetBytes - 1, 'a')).has_value());
    EXPECT_FALSE(parse_request_target("/" + std::string(kMaxTargetBytes, 'a')).has_value());
    std::string target = "/a?";
    for (std::size_t i = 0; i < kMaxQueryParameters; ++i) {
        target += "p" + std::to_string(i) + "=1&";
    }
    EXPECT_TRUE(parse_request_target(target).has_value());
    EXPECT_FALSE(parse_request_target(target + "more=1").has_value());
}

}  // namespace
}  // namespace relume::net
