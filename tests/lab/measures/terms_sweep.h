// One light at many numbers of terms [Ng03 §4.1].
#pragma once

#include "tests/lab/measures/experiment.h"

#include <string>
#include <vector>

namespace relume::lab {

// A method's first image at several numbers of terms, ascending.
struct TermsCurve {
    std::string name;
    std::vector<Record> records;
};

// Of the experiment's scene, environments and first image; `forms` are methods with {} where
// the number of terms goes. Numbers grow by about a half from 1 until all coefficients are in;
// a method that refuses one (spherical harmonics know squares alone) leaves it out. Throws
// std::invalid_argument when a method takes none.
[[nodiscard]] std::vector<TermsCurve> sweep_terms(const Experiment& experiment,
                                                  const std::vector<std::string>& forms);

}  // namespace relume::lab
