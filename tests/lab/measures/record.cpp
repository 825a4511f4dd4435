#include "tests/lab/measures/record.h"

namespace relume::lab {
const std::vector<RecordColumn>& record_columns() {
    static const std::vector<RecordColumn> columns{
        {"l2", "", "relative L2 error of the image", true,
         [](const Record& r) { return r.error.l2; }},
        {"h1", "", "relative H1 error of the image [Ng03 §4.1.2]", true,
         [](const Record& r) { return r.error.h1; }},
        {"peak", "", "largest error of a value over the RMS of the reference", true,
         [](const Record& r) { return r.error.peak; }},
        {"lighting_l1", "", "relative L1 error of the lighting, weighted by solid angle", true,
         [](const Record& r) { return r.lighting_l1; }},
        {"flicker", "", "change of the error since the image before, relative L2", true,
         [](const Record& r) { return r.flicker; }},
        {"delta_e", "dE*ab", "mean difference in CIELAB as shown; 2.3 is just noticeable", true,
         [](const Record& r) { return r.delta_e; }},
        {"stated", "", "relative L2 error as the method states it", true,
         [](const Record& r) { return r.stated_error; }},
        {"coefficients", "", "columns added", true,
         [](const Record& r) { return static_cast<double>(r.applied); }},
        {"bands_reset", "", "bit b: band b began anew", true,
         [](const Record& r) { return static_cast<double>(r.bands_reset); }},
        {"covered", "", "distinct columns added so far", true,
         [](const Record& r) { return static_cast<double>(r.covered); }},
        {"bytes", "B", "transport read", true,
         [](const Record& r) { return static_cast<double>(r.bytes); }},
        {"band_bytes", "B", "memory held so that bands can begin anew", true,
         [](const Record& r) { return static_cast<double>(r.band_bytes); }},
        {"microseconds", "us", "wall clock of the step", false,
         [](const Record& r) { return r.microseconds; }},
    };
    return columns;
}

}  // namespace relume::lab
