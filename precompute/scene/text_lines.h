// A text file of one statement a line, as OBJ and MTL are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relume::scene {

// The whole file. Throws SceneError (corrupt_file, too_large).
[[nodiscard]] std::string text_of(const std::filesystem::path& path, std::uint64_t max_bytes);

// Statements one by one: without a byte order mark, comments, blanks at both ends and empty
// lines, whatever ends a line, and with lines that `\` continues put together.
class TextLines {
  public:
    explicit TextLines(std::string_view text);  // must outlive this

    // False at the end; else `keyword` and `rest` hold the next statement.
    bool next();
    [[nodiscard]] std::string_view keyword() const { return keyword_; }
    [[nodiscard]] std::string_view rest() const { return rest_; }
    // Of the statement's first line, from 1.
    [[nodiscard]] std::uint64_t number() const { return first_line_; }

  private:
    [[nodiscard]] std::string_view take_line();

    std::string_view text_;
    std::string joined_;
    std::string_view keyword_;
    std::string_view rest_;
    std::uint64_t line_ = 0;
    std::uint64_t first_line_ = 0;
};

[[nodiscard]] std::string_view trimmed(std::string_view text);
// The next word of `text`, which loses it; empty at the end.
[[nodiscard]] std::string_view take_word(std::string_view& text);
// Nothing where `word` is no number and nothing else.
[[nodiscard]] std::optional<double> number_from(std::string_view word);
// As many leading numbers of `text` as there are, at most `values.size()`; returns their count.
// `text` loses them.
[[nodiscard]] std::size_t take_numbers(std::string_view& text, std::span<double> values);

}  // namespace relume::scene
