#include "protocol/tripling/material_field.h"

namespace relume::tripling {

std::size_t MaterialField::byte_count() const {
    std::size_t bytes = 0;
    for (const WaveletStore& lobe : lobes) {
        bytes += lobe.byte_count();
    }
    return bytes;
}

FieldPlace place_in_field(const MaterialField& field,
                          const Imath::V3f& normal,
                          const Imath::V3f& reflection) {
    FieldPlace place;
    const auto reflections = field.reflections.nodes_near(reflection);
    for (const DirectionGrid::Node& of_normal : field.normals.nodes_near(normal)) {
        for (const DirectionGrid::Node& of_reflection : reflections) {
            const float weight = of_normal.weight * of_reflection.weight;
            if (weight != 0) {
                place.entries[place.count++] = {
                    .index = field.entry_index(of_normal.index, of_reflection.index),
                    .weight = weight};
            }
        }
    }
    return place;
}

}  // namespace relume::tripling
