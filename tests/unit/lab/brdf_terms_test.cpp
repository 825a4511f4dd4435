#include "tests/lab/measures/brdf_terms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace relume::lab {
namespace {

TEST(BrdfTerms, TellsOfEveryMethodAndLight) {
    const std::vector<LabBrdf> brdfs = lab_brdfs();
    const std::vector<BrdfTerms> rows = measure_brdf_terms(brdfs.front());
    ASSERT_EQ(rows.size(), 3U);
    for (const BrdfTerms& row : rows) {
        EXPECT_EQ(row.brdf, "Phong, exponent 10");
        ASSERT_EQ(row.errors.size(), 10U);
        EXPECT_TRUE(std::is_sorted(row.errors.rbegin(), row.errors.rend()));
    }
    const auto& [natural, svd, nmf] = std::tie(rows[0], rows[1], rows[2]);
    EXPECT_EQ(natural.light, "natural");
    EXPECT_EQ(nmf.method, "nmf");
    for (std::size_t k = 0; k < 10; ++k) {
        EXPECT_LT(natural.errors[k], svd.errors[k]);
        EXPECT_GE(nmf.errors[k], svd.errors[k] - 1e-3);
    }
    EXPECT_GT(svd.largest_negative_of_5, 0);
    EXPECT_EQ(nmf.largest_negative_of_5, 0);
}

TEST(BrdfTerms, NamesTheFirstThatIsAsGood) {
    BrdfTerms row;
    row.errors = {0.5, 0.2, 0.1, 0.1};
    EXPECT_EQ(terms_for(row, 0.6), 1U);
    EXPECT_EQ(terms_for(row, 0.2), 2U);
    EXPECT_EQ(terms_for(row, 0.15), 3U);
    EXPECT_EQ(terms_for(row, 0.05), 0U);
}

}  // namespace
}  // namespace relume::lab
