// What was measured, an image a row, as CSV.
#pragma once

#include "tests/lab/image_error.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace relume::lab {

struct Record {
    std::string method;
    std::uint32_t image = 0;
    ImageError error;
    double stated_error = 0;
    std::uint32_t applied = 0;
    std::uint32_t bands_reset = 0;
    std::uint64_t bytes_touched = 0;
    double microseconds = 0;
};

// Written whole or not at all.
void write_csv(const std::filesystem::path& file, const std::vector<Record>& records);

}  // namespace relume::lab
