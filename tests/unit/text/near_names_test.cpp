#include "protocol/base/text/near_names.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace relume::text {
namespace {

using Names = std::vector<std::string>;

TEST(NearNames, DistanceCountsChangesAndExchanges) {
    EXPECT_EQ(edit_distance("", ""), 0U);
    EXPECT_EQ(edit_distance("table", "table"), 0U);
    EXPECT_EQ(edit_distance("table", "Table"), 0U);
    EXPECT_EQ(edit_distance("tabel", "table"), 1U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
    EXPECT_EQ(edit_distance("", "abc"), 3U);
    EXPECT_EQ(edit_distance("ca", "abc"), 3U);  // a pair exchanged is not edited again
}

RC_GTEST_PROP(NearNamesLaws, DistanceIsSymmetricAndBounded, (std::string a, std::string b)) {
    const std::size_t distance = edit_distance(a, b);
    RC_ASSERT(distance == edit_distance(b, a));
    RC_ASSERT(distance <= std::max(a.size(), b.size()));
    RC_ASSERT(distance + std::min(a.size(), b.size()) >= std::max(a.size(), b.size()));
}

TEST(NearNames, FindsWhatWasMeant) {
    const Names known{"table", "tablet", "plant", "studio-night", "sphere"};
    EXPECT_EQ(near_names("tabel", known), (Names{"table"}));
    EXPECT_EQ(near_names("TABLE", known), (Names{"table", "tablet"}));
    EXPECT_EQ(near_names("studio", known), (Names{"studio-night"}));
    EXPECT_EQ(near_names("night", known), (Names{"studio-night"}));
    EXPECT_TRUE(near_names("castle-in-the-air", known).empty());
    EXPECT_TRUE(near_names("", known).empty());
    EXPECT_TRUE(near_names(std::string(100'000, 't'), known).empty());
}

TEST(NearNames, SaysWhatThereIs) {
    EXPECT_EQ(expected_name("tabel", Names{"table", "plane"}, "scenes"),
              "one of the scenes; did you mean table?");
    EXPECT_EQ(expected_name("castle", Names{"table", "plane"}, "scenes"),
              "one of the scenes table, plane");
    EXPECT_EQ(expected_name("x", {}, "scenes"), "one of the scenes, and there are none");
    const std::string many = expected_name("nothing-like-it", Names(1000, "scene"), "scenes");
    EXPECT_EQ(many.find("one of 1000 scenes such as scene, scene"), 0U) << many;
    EXPECT_LT(many.size(), 120U);
}

}  // namespace
}  // namespace relume::text
