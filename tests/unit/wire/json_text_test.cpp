#include "protocol/wire/json_text.h"

#include "protocol/wire/limits.h"
#include "tests/unit/wire/vectors.h"

#include <gtest/gtest.h>

namespace relume::wire {
namespace {

constexpr std::size_t kPlenty = 1 << 20;

ErrorCode code_for(std::string_view text, std::size_t max_bytes = kPlenty) {
    return wire_error_of([&] { return parse_json(text, max_bytes); }).code();
}

std::string nested(std::size_t levels) {
    return std::string(levels, '[') + std::string(levels, ']');
}

TEST(JsonText, TakesWhatIsStrictJson) {
    EXPECT_EQ(parse_json(R"({"a":[1,2.5e3,"é",null,true],"b":{"a":{}}})", kPlenty),
              nlohmann::json::parse(R"({"a":[1,2.5e3,"é",null,true],"b":{"a":{}}})"));
    EXPECT_EQ(parse_json(" 7 ", 3), 7);
}

TEST(JsonText, RefusesWhatIsNotJson) {
    for (const char* text : {"",           " ",    "{",
                             "{\"a\":1,}", "[1,]", "{a:1}",
                             "'a'",        "NaN",  "Infinity",
                             "-Infinity",  "01",   "+1",
                             ".5",         "1.",   "// comment\n1",
                             "/**/1",      "1 2",  "{} x",
                             "\"\\q\"",    "tru",  "\"tab\there\"",
                             "\"\\ud800\""}) {
        EXPECT_EQ(code_for(text), ErrorCode::malformed_json) << text;
    }
    EXPECT_EQ(code_for(std::string_view("1\0", 2)), ErrorCode::malformed_json);
    EXPECT_EQ(code_for(std::string_view("{}\0{", 4)), ErrorCode::malformed_json);
}

TEST(JsonText, RefusesInvalidUtf8) {
    for (const char* text : {"\"\xff\"", "\"\xc3\"", "\"\xc0\xaf\"", "\"\xed\xa0\x80\"",
                             "\"\xf4\x90\x80\x80\"", "{\"\xfe\":1}"}) {
        EXPECT_EQ(code_for(text), ErrorCode::malformed_json);
    }
}

TEST(JsonText, RefusesRepeatedKeysAtAnyLevelButNotInSiblings) {
    EXPECT_EQ(code_for(R"({"a":1,"a":1})"), ErrorCode::malformed_json);
    EXPECT_EQ(code_for(R"({"x":[{"a":1,"b":{},"a":2}]})"), ErrorCode::malformed_json);
    EXPECT_EQ(code_for("{\"a\":1,\"\\u0061\":2}"), ErrorCode::malformed_json);
    EXPECT_NO_THROW(static_cast<void>(parse_json(R"([{"a":1},{"a":{"a":1}}])", kPlenty)));
}

TEST(JsonText, BoundsNestingAndLength) {
    EXPECT_NO_THROW(static_cast<void>(parse_json(nested(kMaxJsonDepth), kPlenty)));
    EXPECT_EQ(code_for(nested(kMaxJsonDepth + 1)), ErrorCode::malformed_json);
    EXPECT_EQ(code_for(nested(200'000)), ErrorCode::malformed_json);
    EXPECT_EQ(code_for("[1,2]", 4), ErrorCode::too_large);
    EXPECT_NO_THROW(static_cast<void>(parse_json("[1,2]", 5)));
}

TEST(JsonText, RefusesNumbersBeyondDouble) {
    EXPECT_EQ(code_for("1e999"), ErrorCode::out_of_range);
    EXPECT_EQ(code_for(R"({"gain":-1e400})"), ErrorCode::out_of_range);
    EXPECT_EQ(parse_json("1e-999", kPlenty), 0.0);
}

TEST(JsonText, QuotesShortlyAndInValidUtf8) {
    EXPECT_EQ(quote("a\nb"), R"("a\nb")");
    EXPECT_EQ(quote(nullptr), "null");
    EXPECT_EQ(quote(0.05), "0.05");
    std::string umlauts;
    for (int i = 0; i < 1000; ++i) {
        umlauts += "ü";
    }
    for (const std::string& text : {umlauts, "x" + umlauts}) {
        const std::string quoted = quote(text);
        EXPECT_LT(quoted.size(), 80U);
        EXPECT_NO_THROW(static_cast<void>(nlohmann::json(quoted).dump()));
    }
    EXPECT_EQ(quote(nlohmann::json::parse(nested(10))), "an array of 1");
}

TEST(JsonText, EscapesPointerSteps) {
    EXPECT_EQ(pointer_step("/lights", "a/b~c"), "/lights/a~1b~0c");
    EXPECT_EQ(pointer_step("", ""), "/");
    EXPECT_EQ(pointer_step("/a", std::string(128, 'k')), "/a/" + std::string(128, 'k'));
    EXPECT_EQ(pointer_step("/a", std::string(129, 'k')), "/a/" + std::string(128, 'k') + "…");
    EXPECT_EQ(pointer_step("", std::string(127, 'k') + "éé"),
              "/" + std::string(127, 'k') + "…");
}

}  // namespace
}  // namespace relume::wire
