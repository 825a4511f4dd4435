// The short form: every failure, its scene and its bounds.
#include "tests/stability/failures.h"
#include "tests/stability/findings_text.h"

#include <gtest/gtest.h>

#include <iostream>

namespace relume::stability {
namespace {

class Stability : public testing::TestWithParam<Failure> {};

TEST_P(Stability, KeepsItsBounds) {
    Workbench workbench({.cache = RELUME_STABILITY_CACHE});
    const Result result{GetParam(), GetParam().provoke(workbench)};
    std::cout << text_from(result);
    for (const Finding& finding : result.outcome.findings) {
        EXPECT_TRUE(finding.holds()) << line_from(finding) << "\n  " << finding.reason;
    }
}

INSTANTIATE_TEST_SUITE_P(Failures,
                         Stability,
                         testing::ValuesIn(failures().begin(), failures().end()),
                         [](const auto& failure) { return std::string(failure.param.name); });

}  // namespace
}  // namespace relume::stability
