#include "protocol/base/text/names.h"

#include "tests/unit/wire/vectors.h"

#include <gtest/gtest.h>

namespace relume::wire {
namespace {

TEST(Names, SharedCases) {
    const nlohmann::json cases = vectors_from_file("names");
    for (const auto& name : cases.at("valid")) {
        EXPECT_TRUE(text::is_name(name.get<std::string>())) << name;
    }
    for (const auto& name : cases.at("invalid")) {
        EXPECT_FALSE(text::is_name(name.get<std::string>())) << name;
    }
}

}  // namespace
}  // namespace relume::wire
