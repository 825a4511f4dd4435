// What was measured of one method's image.
#pragma once

#include "tests/lab/measures/image_error.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace relume::lab {

// Of the lighting coefficients of one band, all colours.
struct BandRecord {
    std::uint32_t updated = 0;   // columns added in this image
    double residual_energy = 0;  // Σ (L − L̃)² after it
    double residual_l1 = 0;      // Σ |L − L̃| after it
    double light_l1 = 0;         // Σ |L|
    double change_energy = 0;    // Σ (L − L of the image before)²
};

struct Record {
    std::string method;
    std::uint32_t image = 0;
    ImageError error;
    double lighting_l1 = 0;  // lighting_error.h
    double flicker = 0;      // image_error.h, error_change
    double delta_e = 0;      // perceptual_difference.h
    double stated_error = 0;
    std::uint32_t applied = 0;
    std::uint32_t bands_reset = 0;  // bit b
    std::uint32_t covered = 0;      // distinct columns added so far
    std::uint64_t bytes = 0;
    std::uint64_t band_bytes = 0;
    double microseconds = 0;  // of the step, wall clock
    std::vector<BandRecord> bands;
};

// A number of a record, as tables and charts know it. One line in record.cpp adds one.
struct RecordColumn {
    std::string_view name;     // heading of CSV and key of JSON
    std::string_view unit;     // "" for ratios
    std::string_view meaning;  // a line
    bool reproducible;         // to the last digit from the seed
    // NaN where there is none: a method that states nothing.
    double (*value)(const Record&);
};
[[nodiscard]] const std::vector<RecordColumn>& record_columns();

}  // namespace relume::lab
