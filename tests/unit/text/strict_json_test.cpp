#include "protocol/base/text/strict_json.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace relume::text {
namespace {

constexpr std::size_t kPlenty = 1 << 22;

std::string fault_of(std::string_view text) {
    try {
        static_cast<void>(parse_strict_json(text, kPlenty));
        return "none";
    } catch (const JsonError& error) {
        return error.found();
    }
}

TEST(StrictJson, NamesLineAndColumnOfAFault) {
    EXPECT_EQ(fault_of("{\n  \"a\": 1,\n}"), "line 3, column 1: \"}\"");
    EXPECT_EQ(fault_of("{\n  \"ä\": ß}"), "line 2, column 8: \"ß\"");
    EXPECT_EQ(fault_of("{\"a\": [1, 2"), "line 1, column 12: the end of the text");
    EXPECT_EQ(fault_of(""), "line 1, column 1: the end of the text");
    EXPECT_EQ(fault_of("[1,\n 2]\n\n x"), "line 4, column 2: \"x\"");
    EXPECT_EQ(fault_of(std::string_view("[1,\n\0]", 6)), "line 2, column 1: a NUL");
    EXPECT_EQ(fault_of("{\"a\":1,\n \"a\":2}"),
              "line 2, column 4: the key \"a\" twice in one object");
    EXPECT_EQ(fault_of("{\"a\":\n1e999}"),
              "line 2, column 6: a number beyond double precision's range");
}

TEST(StrictJson, DepthIsBoundedHoweverLongTheText) {
    for (const std::size_t levels : {kMaxJsonDepth + 1, std::size_t{200'000}}) {
        const std::string arrays = std::string(levels, '[') + std::string(levels, ']');
        EXPECT_NE(fault_of(arrays).find("deeper nesting"), std::string::npos);
        std::string objects;
        for (std::size_t i = 0; i < levels; ++i) {
            objects += "{\"a\":";
        }
        EXPECT_NE(fault_of(objects).find("deeper nesting"), std::string::npos);
    }
    EXPECT_EQ(fault_of(std::string(kMaxJsonDepth, '[') + std::string(kMaxJsonDepth, ']')),
              "none");
}

}  // namespace
}  // namespace relume::text
