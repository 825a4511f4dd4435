#include "server/net/peers/address_quota.h"

#include "server/net/peers/client_address.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace relume::net {
namespace {

using boost::asio::ip::make_address;

TEST(AddressQuota, OneHoldsSoManyAndTheOthersAsMany) {
    AddressQuota quota(2);
    AddressQuota::Place first = quota.take("a");
    const AddressQuota::Place second = quota.take("a");
    EXPECT_NE(first, nullptr);
    EXPECT_NE(second, nullptr);
    EXPECT_EQ(quota.take("a"), nullptr);
    EXPECT_NE(quota.take("b"), nullptr);
    first.reset();
    EXPECT_NE(quota.take("a"), nullptr);
}

TEST(AddressQuota, APlaceMayOutliveIt) {
    AddressQuota::Place place;
    {
        AddressQuota quota(1);
        place = quota.take("a");
    }
    place.reset();
}

TEST(QuotaKey, IsAnIpv4AddressOrAnIpv6Network) {
    const auto key = [](const char* address) { return quota_key(make_address(address)); };
    EXPECT_EQ(key("10.1.2.3"), "10.1.2.3");
    EXPECT_EQ(key("::ffff:10.1.2.3"), "10.1.2.3");
    EXPECT_NE(key("10.1.2.3"), key("10.1.2.4"));
    EXPECT_EQ(key("2001:db8:1:2::1"), key("2001:db8:1:2:ffff::9"));
    EXPECT_NE(key("2001:db8:1:2::1"), key("2001:db8:1:3::1"));
}

struct Forwarded {
    const char* peer;
    const char* field;
    const char* client;
};

TEST(TrustedProxies, TheLastAddressNotTheirOwnIsTheClients) {
    const TrustedProxies proxies({"127.0.0.1", "10.0.0.1"});
    for (const Forwarded& c : {
             Forwarded{"1.2.3.4", "5.6.7.8", "1.2.3.4"},  // no proxy of ours: made up
             Forwarded{"127.0.0.1", "5.6.7.8", "5.6.7.8"},
             Forwarded{"::ffff:127.0.0.1", "5.6.7.8", "5.6.7.8"},
             Forwarded{"127.0.0.1", "9.9.9.9, 5.6.7.8", "5.6.7.8"},
             Forwarded{"127.0.0.1", "9.9.9.9,5.6.7.8 , 10.0.0.1", "5.6.7.8"},
             Forwarded{"127.0.0.1", "2001:db8::1", "2001:db8::1"},
             Forwarded{"127.0.0.1", "", "127.0.0.1"},
             Forwarded{"127.0.0.1", "unknown", "127.0.0.1"},
             Forwarded{"127.0.0.1", "5.6.7.8, nonsense", "127.0.0.1"},
             Forwarded{"127.0.0.1", "10.0.0.1", "10.0.0.1"},
         }) {
        EXPECT_EQ(proxies.client_of(make_address(c.peer), c.field), make_address(c.client))
            << c.peer << " " << c.field;
    }
    EXPECT_THROW(TrustedProxies({"proxy.example"}), std::runtime_error);
}

}  // namespace
}  // namespace relume::net
