// Bytes of files with something in them changed.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace relume::test {

[[nodiscard]] inline std::vector<std::byte> with_number(std::vector<std::byte> bytes,
                                                        std::size_t offset,
                                                        std::uint32_t value) {
    std::memcpy(bytes.data() + offset, &value, sizeof(value));
    return bytes;
}

inline void expect_refusal(const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos)
        << "found '" << message << "', expected '" << part << "' in it";
}

// Calls check(bytes) with up to four bytes changed at random and sometimes an end cut off,
// `count` times.
template <typename Check>
void for_each_broken(const std::vector<std::byte>& whole, int count, Check check) {
    std::mt19937_64 random(7);
    for (int i = 0; i < count; ++i) {
        std::vector<std::byte> bytes = whole;
        for (std::uint64_t changes = 1 + random() % 4; changes > 0; --changes) {
            bytes[random() % bytes.size()] = static_cast<std::byte>(random() % 256);
        }
        if (random() % 8 == 0) {
            bytes.resize(random() % bytes.size());
        }
        check(std::span<const std::byte>(bytes));
    }
}

}  // namespace relume::test
