// A self-contained page: charts and pictures inside it, nothing loaded from elsewhere.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace relume::lab {

// Grows from top to bottom. Text is escaped.
class HtmlPage {
  public:
    explicit HtmlPage(const std::string& title);

    void heading(const std::string& text);
    void paragraph(const std::string& text);
    // For what a reader must not miss.
    void warning(const std::string& text);
    void table(const std::vector<std::string>& headings,
               const std::vector<std::vector<std::string>>& rows);
    // The content of an SVG file, its ids made the page's own, and a PNG file as a data URI.
    // Throw std::runtime_error when the file cannot be read.
    void svg(const std::filesystem::path& file);
    void png(const std::filesystem::path& file);

    // Whole or not at all.
    void write(const std::filesystem::path& file) const;

  private:
    std::string body_;
    std::string title_;
    std::size_t charts_ = 0;
};

}  // namespace relume::lab
