// Methods by name.
#include "tests/lab/methods/method.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace relume::lab {
namespace {

std::string refusal_of(const std::string& text) {
    try {
        (void)method_from_text(text);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "not refused";
}

TEST(Method, ALabelNamesTheSameMethodAgain) {
    for (const char* text : {"nwa-30", "bi-100-none", "pbi-30-transport", "pbi-dealer-30",
                             "pbi-exhaustive-7-area", "pbi-l2-30", "pbi-dealer-l2-30",
                             "pbi-sh-25", "pbi-sh-filled-25", "guarded-400kB-benefit", "bi-2MB",
                             "full-product", "factored-k4-30", "cpca-c40-s16-30-transport"}) {
        const std::string label = method_from_text(text).label;
        EXPECT_EQ(method_from_text(label).label, label) << text;
        EXPECT_EQ(label.rfind(text, 0), 0U) << text;
    }
}

TEST(Method, PriorityIsAreaWhenLeftOut) {
    EXPECT_EQ(method_from_text("pbi-30").label, "pbi-30-area");
}

TEST(Method, TheFamilyWithTheLongestNameWins) {
    EXPECT_EQ(method_from_text("pbi-dealer-30").label, "pbi-dealer-30-area");
}

TEST(Method, WhatIsRefusedIsNamedWithWhatIsExpected) {
    for (const MethodFamily& family : method_families()) {
        EXPECT_NE(refusal_of("best-30").find(family.name), std::string::npos);
    }
    EXPECT_NE(refusal_of("pbi-0").find("number of coefficients"), std::string::npos);
    EXPECT_NE(refusal_of("pbi-30GB").find("kB or MB"), std::string::npos);
    EXPECT_NE(refusal_of("pbi-30-size").find("area"), std::string::npos);
    EXPECT_NE(refusal_of("pbi-dealer-30kB").find("not of bytes"), std::string::npos);
    EXPECT_NE(refusal_of("factored-30").find("number of terms"), std::string::npos);
    EXPECT_NE(refusal_of("factored-k0-30").find("number of terms"), std::string::npos);
    EXPECT_NE(refusal_of("cpca-c40-30").find("bases of a cluster"), std::string::npos);
    EXPECT_NE(refusal_of("cpca-c40-s16").find("bases of a cluster"), std::string::npos);
    EXPECT_NE(refusal_of("full-image").find("product"), std::string::npos);
    EXPECT_NE(refusal_of("pbi").find("expected"), std::string::npos);
    EXPECT_NE(refusal_of("").find("expected"), std::string::npos);
}

}  // namespace
}  // namespace relume::lab
