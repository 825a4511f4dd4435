#include "server/net/http/access.h"

#include "server/net/http/subprotocols.h"

#include <gtest/gtest.h>

namespace relume::net {
namespace {

HttpRequest request(const std::string& target) {
    HttpRequest made;
    made.target = parse_request_target(target).value();
    return made;
}

HostPolicy local() {
    return {"127.0.0.1:8080", boost::asio::ip::make_address("127.0.0.1"), {}};
}

TEST(Access, WithoutATokenAsksForNone) {
    const Access access("", OriginPolicy({}), local());
    EXPECT_EQ(access.role_of(request("/")), Role::editor);
    EXPECT_EQ(access.role_of(request("/?token=x")), Role::editor);
}

TEST(Access, TakesTheTokenFromQueryOrHeader) {
    const Access access("secret", OriginPolicy({}), local());
    EXPECT_EQ(access.role_of(request("/")), Role::none);
    EXPECT_EQ(access.role_of(request("/?token=")), Role::none);
    EXPECT_EQ(access.role_of(request("/?token=secre")), Role::none);
    EXPECT_EQ(access.role_of(request("/?token=secretsecret")), Role::none);
    EXPECT_EQ(access.role_of(request("/?token=secreT")), Role::none);
    EXPECT_EQ(access.role_of(request("/?token=secret")), Role::editor);
    HttpRequest with_header = request("/");
    with_header.authorization = "Bearer secret";
    EXPECT_EQ(access.role_of(with_header), Role::editor);
    with_header.authorization = "Bearer other";
    EXPECT_EQ(access.role_of(with_header), Role::none);
    with_header.authorization = "Basic secret";
    EXPECT_EQ(access.role_of(with_header), Role::none);
}

TEST(Access, TakesTheTokenFromASubprotocol) {
    const Access access("secret?>", OriginPolicy({}), local());
    HttpRequest asking = request("/?token=other");
    const auto offers = [&](const char* offered) {
        asking.subprotocols = offered;
        return access.role_of(asking) != Role::none;
    };
    EXPECT_TRUE(offers("relume.v1, relume.token.c2VjcmV0Pz4"));
    EXPECT_TRUE(offers("relume.token.c2VjcmV0Pz4"));
    EXPECT_FALSE(offers("relume.v1, relume.token.c2VjcmV0Pz5"));
    EXPECT_FALSE(offers("relume.v1, relume.token.c2VjcmV0Pz4="));
    EXPECT_FALSE(offers("relume.v1, relume.token."));
    EXPECT_FALSE(offers("relume.v1"));
    asking.authorization = "Bearer secret?>";
    EXPECT_TRUE(offers("relume.token.AAAA"));
}

TEST(Subprotocols, TokensAreBase64Url) {
    EXPECT_EQ(token_from_subprotocols("relume.token.-_-_"), "\xFB\xFF\xBF");
    EXPECT_EQ(token_from_subprotocols("x,\trelume.token.Zg , y"), "f");
    EXPECT_EQ(token_from_subprotocols("relume.token.Zh"), std::nullopt);  // bits left over
    EXPECT_EQ(token_from_subprotocols("relume.token.Z"), std::nullopt);
    EXPECT_EQ(token_from_subprotocols("relume.token.Zg=="), std::nullopt);
    EXPECT_EQ(token_from_subprotocols(std::nullopt), std::nullopt);
}

TEST(Subprotocols, OneVersionMustBeTheServers) {
    EXPECT_TRUE(offers_subprotocol("relume.v2, relume.v1"));
    EXPECT_FALSE(offers_other_versions_only("relume.v2, relume.v1"));
    EXPECT_TRUE(offers_other_versions_only("relume.v2"));
    EXPECT_TRUE(offers_other_versions_only("relume.v10 ,relume.token.AAAA"));
    EXPECT_FALSE(offers_other_versions_only("chat"));
    EXPECT_FALSE(offers_other_versions_only(std::nullopt));
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

TEST(OriginPolicy, ADefaultPortIsAsGoodAsNone) {
    const OriginPolicy policy({"https://dev.example:443"});
    EXPECT_TRUE(policy.allows("http://host", "host:80"));
    EXPECT_TRUE(policy.allows("http://host:80", "host"));
    EXPECT_TRUE(policy.allows("https://host", "host:443"));
    EXPECT_TRUE(policy.allows("https://dev.example", "other"));
    EXPECT_FALSE(policy.allows("http://host", "host:443"));
    EXPECT_FALSE(policy.allows("https://host:80", "host"));
    EXPECT_FALSE(policy.allows("http://dev.example", "other"));
}

TEST(HostPolicy, ListensUnderItsAddressAndWhatIsAllowed) {
    const auto policy = [](const char* listen, const char* address) {
        return HostPolicy(listen, boost::asio::ip::make_address(address),
                          {"studio", "fe80::1"});
    };
    const HostPolicy one = policy("lan.example:80", "10.0.0.1");
    for (const char* const host : {"lan.example", "10.0.0.1:80", "studio:1", "[fe80::1]"}) {
        EXPECT_TRUE(one.allows(host)) << host;
    }
    for (const char* const host : {"localhost", "127.0.0.1", "10.0.0.2", "other"}) {
        EXPECT_FALSE(one.allows(host)) << host;
    }
    const HostPolicy all = policy("[::]:80", "::");
    for (const char* const host : {"localhost", "127.0.0.1", "10.0.0.2", "[::1]:80"}) {
        EXPECT_TRUE(all.allows(host)) << host;
    }
    EXPECT_FALSE(all.allows("other"));
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
