// Charts drawn by gnuplot.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace relume::lab {

struct Chart {
    std::uint32_t width = 960;  // in pixels of the SVG; the PNG has 1.5 times as many
    std::uint32_t height = 480;
    std::string data = {};      // data blocks, `$name << EOD … EOD`
    std::string commands = {};  // what draws; run once for each format
};

// Writes STEM.svg and STEM.png, each whole or not at all. Throws std::runtime_error when
// gnuplot is missing or fails.
void draw_chart(const std::filesystem::path& stem, const Chart& chart);
// STEM.png alone, for charts that are pictures.
void draw_picture(const std::filesystem::path& stem, const Chart& chart);

// The n-th of eight colours that colour-blind people tell apart too [Okabe02]; then again.
[[nodiscard]] const char* chart_colour(std::size_t n);
// gnuplot's number of the dashes with which the n-th line is drawn: solid ones, and others each
// time that the colours begin again.
[[nodiscard]] std::size_t chart_dashes(std::size_t n);
// The n-th of gnuplot's filled and open point types.
[[nodiscard]] int chart_point(std::size_t n);
// As gnuplot takes it in single quotes, without enhanced text in it.
[[nodiscard]] std::string chart_text(const std::string& text);

// What all line charts share: border, ticks, a faint grid.
[[nodiscard]] std::string chart_style();

}  // namespace relume::lab
