// Error of an image against the number of terms.
#pragma once

#include "tests/lab/geometry/view_terms.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relume::lab {

struct ViewTermsPanel {
    std::string title;
    std::vector<std::string> lights;
    std::vector<ViewTerms> found;  // of each light
};

// STEM.svg and .png: panels side by side, a curve a light. Throws as draw_chart does.
void draw_view_terms_chart(const std::filesystem::path& stem,
                           const std::vector<ViewTermsPanel>& panels);

}  // namespace relume::lab
