#include "server/triple/finish.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace relume::triple {

Finish::Finish(SharedMaterial only, std::optional<std::vector<Imath::V3f>> lobe_colours)
    : material(std::move(only)) {
    if (!material) {
        throw std::invalid_argument("no material, expected one");
    }
    colours = lobe_colours ? std::move(*lobe_colours) : material->colours();
    if (colours.size() != material->lobe_count()) {
        throw std::invalid_argument(std::to_string(colours.size()) + " colours, expected " +
                                    std::to_string(material->lobe_count()) +
                                    ", one a lobe of the material");
    }
}

Finish::Finish(SharedMaterial first,
               SharedMaterial second,
               float amount,
               std::optional<std::vector<Imath::V3f>> lobe_colours)
    : Finish(std::move(first), std::move(lobe_colours)) {
    if (!second || second->face_resolution() != material->face_resolution() ||
        second->lobe_count() != material->lobe_count()) {
        throw std::invalid_argument("materials of different resolutions or lobes, expected "
                                    "two steps of one family");
    }
    if (amount > 0) {
        next = std::move(second);
        amount_of_next = amount;
    }
}

bool Finish::depends_on_view() const {
    return (material && material->depends_on_view()) || (next && next->depends_on_view());
}

}  // namespace relume::triple
