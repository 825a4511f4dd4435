#include "tests/bench/figure.h"

#include "tests/bench/figure_groups.h"

namespace relume::bench {

bool Figure::reached(double value) const {
    switch (aim) {
        case Aim::at_least:
            return value >= target;
        case Aim::at_most:
            return value <= target;
        case Aim::reported:
            return true;
    }
    return false;
}

std::optional<double> Results::value(const std::string& key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? std::nullopt : std::optional(found->second);
}

const std::vector<FigureGroup>& figure_groups() {
    static const std::vector<FigureGroup> groups{
        bandwidth_figures(),   peer_figures(),  full_product_figures(),
        exact_image_figures(), batch_figures(), served_figures(),
        bytes_figures(),       drift_figures(), flagship_figures(),
    };
    return groups;
}

}  // namespace relume::bench
