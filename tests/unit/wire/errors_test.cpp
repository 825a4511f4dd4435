#include "protocol/wire/errors.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>

namespace relume::wire {
namespace {

TEST(Errors, EveryCodeHasOneNameAndComesBackFromIt) {
    std::set<std::string_view> names;
    for (int i = 0; i <= static_cast<int>(ErrorCode::internal); ++i) {
        const auto code = static_cast<ErrorCode>(i);
        const std::string_view name = name_from_error_code(code);
        EXPECT_FALSE(name.empty()) << i;
        EXPECT_TRUE(names.insert(name).second) << name;
        EXPECT_EQ(error_code_from_name(name), code);
    }
    EXPECT_EQ(error_code_from_name("no_such_code"), std::nullopt);
    EXPECT_EQ(error_code_from_name(""), std::nullopt);
}

TEST(Errors, CloseCodesMayBeSentAndHaveOneReasonThatFits) {
    std::set<std::string_view> reasons;
    for (unsigned number = 0; number <= 5000; ++number) {
        if (const auto code = close_code_from_number(static_cast<std::uint16_t>(number))) {
            EXPECT_EQ(static_cast<unsigned>(*code), number);
            const std::string_view reason = reason_from_close_code(*code);
            EXPECT_LE(reason.size(), 123U);
            EXPECT_TRUE(reasons.insert(reason).second) << "two codes say " << reason;
            // What RFC 6455 §7.4 defines, or leaves to who agrees on it.
            const bool is_defined = number >= 1000 && number <= 1011 && number != 1004 &&
                                    number != 1005 && number != 1006;
            EXPECT_TRUE(is_defined || (number >= 4000 && number <= 4999)) << number;
        }
    }
    EXPECT_TRUE(reasons.contains(reason_from_close_code(CloseCode::too_many_rooms)));
}

TEST(Errors, TheMessageNamesCodePathFoundAndExpected) {
    const WireError error(ErrorCode::out_of_range, "/environment/gain", "-1", "a number 0 … 5");
    EXPECT_STREQ(error.what(),
                 "out_of_range at /environment/gain: found -1, expected a number 0 … 5");
    EXPECT_EQ(error.edit_id(), std::nullopt);
    EXPECT_EQ(error.with_edit_id(7).edit_id(), 7U);
    EXPECT_EQ(error.with_edit_id(7).path(), error.path());
}

}  // namespace
}  // namespace relume::wire
