#include "server/net/access.h"

#include <gtest/gtest.h>

namespace relume::net {
namespace {

HttpRequest request(const std::string& target) {
    HttpRequest made;
    made.target = parse_request_target(target).value();
    return made;
}

TEST(Access, WithoutATokenAsksForNone) {
    const Access access("", OriginPolicy({}));
    EXPECT_TRUE(access.has_token(request("/")));
    EXPECT_TRUE(access.has_token(request("/?token=x")));
}

TEST(Access, TakesTheTokenFromQueryOrHeader) {
    const Access access("secret", OriginPolicy({}));
    EXPECT_FALSE(access.has_token(request("/")));
    EXPECT_FALSE(access.has_token(request("/?token=")));
    EXPECT_FALSE(access.has_token(request("/?token=secre")));
    EXPECT_FALSE(access.has_token(request("/?token=secretsecret")));
    EXPECT_FALSE(access.has_token(request("/?token=secreT")));
    EXPECT_TRUE(access.has_token(request("/?token=secret")));
    HttpRequest with_header = request("/");
    with_header.authorization = "Bearer secret";
    EXPECT_TRUE(access.has_token(with_header));
    with_header.authorization = "Bearer other";
    EXPECT_FALSE(access.has_token(with_header));
    with_header.authorization = "Basic secret";
    EXPECT_FALSE(access.has_token(with_header));
}

TEST(OriginPolicy, OwnOriginAndNoOriginAreAllowed) {
    const OriginPolicy policy({});
    EXPECT_TRUE(policy.allows(std::nullopt, "host:8080"));
    EXPECT_TRUE(policy.allows("http://host:8080", "host:8080"));
    EXPECT_TRUE(policy.allows("https://HOST", "host"));
    EXPECT_FALSE(policy.allows("http://host:8081", "host:8080"));
    EXPECT_FALSE(policy.allows("http://evil.example", "host:8080"));
    EXPECT_FALSE(policy.allows("null", "host:8080"));
    EXPECT_FALSE(policy.allows("", ""));
    EXPECT_FALSE(policy.allows("http://", ""));
}

TEST(OriginPolicy, OthersOnlyWhenListed) {
    const OriginPolicy listed({"http://dev.example:5173"});
    EXPECT_TRUE(listed.allows("http://dev.example:5173", "host"));
    EXPECT_TRUE(listed.allows_cross("http://dev.example:5173", "host"));
    EXPECT_FALSE(listed.allows("http://dev.example", "host"));
    EXPECT_FALSE(listed.allows_cross("http://host", "host"));  // its own, nothing to name
    const OriginPolicy all({"*"});
    EXPECT_TRUE(all.allows("http://anything", "host"));
}

}  // namespace
}  // namespace relume::net
