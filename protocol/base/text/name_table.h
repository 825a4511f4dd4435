// Enumerators and their words, in one place each.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace relume::text {

template <typename Enum, std::size_t Count>
class NameTable {
  public:
    using Entry = std::pair<Enum, std::string_view>;

    constexpr explicit NameTable(const std::array<Entry, Count>& entries) : entries_(entries) {}

    [[nodiscard]] constexpr std::string_view name(Enum value) const {
        for (const Entry& entry : entries_) {
            if (entry.first == value) {
                return entry.second;
            }
        }
        return {};
    }
    [[nodiscard]] constexpr std::optional<Enum> value(std::string_view name) const {
        for (const Entry& entry : entries_) {
            if (entry.second == name) {
                return entry.first;
            }
        }
        return std::nullopt;
    }
    [[nodiscard]] constexpr std::array<std::string_view, Count> words() const {
        std::array<std::string_view, Count> words;
        for (std::size_t i = 0; i < Count; ++i) {
            words[i] = entries_[i].second;
        }
        return words;
    }
    // "one of a, b, c", for error messages; "a" where there is no other.
    [[nodiscard]] std::string alternatives() const {
        std::string text = Count == 1 ? "" : "one of ";
        for (std::size_t i = 0; i < Count; ++i) {
            text.append(i == 0 ? "" : ", ").append(entries_[i].second);
        }
        return text;
    }

  private:
    std::array<Entry, Count> entries_;
};

}  // namespace relume::text
