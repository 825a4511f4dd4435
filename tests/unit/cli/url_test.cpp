#include "client/cli/url.h"

#include "protocol/base/program/usage.h"

#include <gtest/gtest.h>

namespace relume::cli {
namespace {

TEST(Urls, HostPortAndPrefix) {
    EXPECT_EQ(url_from_text("example.org"), (Url{"example.org", "80", ""}));
    EXPECT_EQ(url_from_text("localhost:8080"), (Url{"localhost", "8080", ""}));
    EXPECT_EQ(url_from_text("[::1]:8080/a"), (Url{"::1", "8080", "/a"}));
    EXPECT_EQ(url_from_text("http://example.org"), (Url{"example.org", "80", ""}));
    EXPECT_EQ(url_from_text("ws://127.0.0.1:8080/"), (Url{"127.0.0.1", "8080", ""}));
    EXPECT_EQ(url_from_text("http://h:1/a/b//"), (Url{"h", "1", "/a/b"}));
    EXPECT_EQ(url_from_text("http://[::1]:65535"), (Url{"::1", "65535", ""}));
    EXPECT_EQ(url_from_text("http://[::1]").authority(), "[::1]");
    EXPECT_EQ(url_from_text("http://h:8080").authority(), "h:8080");
    EXPECT_EQ(url_from_text("http://h:80").authority(), "h");
}

TEST(Urls, RefusesWhatIsNoServerUrl) {
    for (const char* text : {"",
                             "h:port",
                             "user@h",
                             "https://h",
                             "wss://h",
                             "ftp://h",
                             "http://",
                             "http://:80",
                             "http://h:",
                             "http://h:0",
                             "http://h:65536",
                             "http://h:80x",
                             "http://h:-1",
                             "http://u@h",
                             "http://h?x",
                             "http://h#x",
                             "http://[::1",
                             "http://[]",
                             "http://[::1]80",
                             "http://a b"}) {
        EXPECT_THROW(static_cast<void>(url_from_text(text)), program::UsageError) << text;
    }
}

TEST(Urls, PercentEncoding) {
    EXPECT_EQ(percent_encoded("A-z_0.9~"), "A-z_0.9~");
    EXPECT_EQ(percent_encoded("a b&c=d/é\xff"), "a%20b%26c%3Dd%2F%C3%A9%FF");
}

}  // namespace
}  // namespace relume::cli
