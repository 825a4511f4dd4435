#include "precompute/scene/shown_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>

#include <string>

namespace relume::scene {
namespace {

TEST(ShownText, TextStaysAndOtherBytesAreEscaped) {
    EXPECT_EQ(shown_text("grün 木 🙂"), "grün 木 🙂");
    EXPECT_EQ(shown_text("gr\xfcn"), "gr\\xfcn");                       // Latin-1
    EXPECT_EQ(shown_text("a\nb\x1b[31m"), "a\\x0ab\\x1b[31m");          // a terminal's orders
    EXPECT_EQ(shown_text("\xc2\x85"), "\\xc2\\x85");                    // U+0085, next line
    EXPECT_EQ(shown_text("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // a surrogate
    EXPECT_EQ(shown_text("\xc0\xaf"), "\\xc0\\xaf");                    // overlong
    EXPECT_EQ(shown_text("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // above U+10FFFF
    EXPECT_EQ(shown_text("\xe2\x82"), "\\xe2\\x82");                    // cut
    EXPECT_EQ(shown_text(std::string("a\0b", 3)), "a\\x00b");
}

RC_GTEST_PROP(ShownText, AnyBytesBecomeJson, (const std::string& bytes)) {
    const std::string shown = shown_text(bytes);
    RC_ASSERT(nlohmann::json::parse(nlohmann::json(shown).dump()) == shown);
    RC_ASSERT(shown_text(shown) == shown);
}

}  // namespace
}  // namespace relume::scene
