#include "protocol/tripling/material_field.h"

namespace relume::tripling {

std::size_t MaterialField::byte_count() const {
    std::size_t bytes = 0;
    for (const WaveletStore& lobe : lobes) {
        bytes += lobe.byte_count();
    }
    return bytes;
}

FieldPlace place_in_grids(const DirectionGrid& normals,
                          const DirectionGrid& reflections,
                          const Imath::V3f& normal,
                          const Imath::V3f& reflection) {
    FieldPlace place;
    const auto near_reflection = reflections.nodes_near(reflection);
    for (const DirectionGrid::Node& of_normal : normals.nodes_near(normal)) {
        for (const DirectionGrid::Node& of_reflection : near_reflection) {
            const float weight = of_normal.weight * of_reflection.weight;
            if (weight != 0) {
                place.entries[place.count++] = {
                    .index = of_normal.index * reflections.node_count() + of_reflection.index,
                    .weight = weight};
            }
        }
    }
    return place;
}

FieldPlace place_in_field(const MaterialField& field,
                          const Imath::V3f& normal,
                          const Imath::V3f& reflection) {
    return place_in_grids(field.normals, field.reflections, normal, reflection);
}

}  // namespace relume::tripling
