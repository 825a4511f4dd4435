#include "protocol/wire/errors.h"

#include <gtest/gtest.h>

#include <string>

namespace relume::wire {
namespace {

TEST(Errors, EveryCodeHasOneNameAndComesBackFromIt) {
    for (int i = 0; i <= static_cast<int>(ErrorCode::internal); ++i) {
        const auto code = static_cast<ErrorCode>(i);
        const std::string_view name = name_from_error_code(code);
        EXPECT_FALSE(name.empty()) << i;
        EXPECT_EQ(error_code_from_name(name), code);
    }
    EXPECT_EQ(error_code_from_name("no_such_code"), std::nullopt);
    EXPECT_EQ(error_code_from_name(""), std::nullopt);
}

TEST(Errors, CloseReasonsFitACloseFrame) {
    int known = 0;
    for (unsigned number = 0; number <= 5000; ++number) {
        if (const auto code = close_code_from_number(static_cast<std::uint16_t>(number))) {
            ++known;
            EXPECT_EQ(static_cast<unsigned>(*code), number);
            EXPECT_LE(reason_from_close_code(*code).size(), 123U);
        }
    }
    EXPECT_EQ(known, 11);
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
