#include "protocol/tripling/direction_grid.h"

#include "protocol/basis/cubemap.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace relume::tripling {
namespace {

constexpr float kEighthTurn = std::numbers::pi_v<float> / 4;

}  // namespace

DirectionGrid::DirectionGrid(std::uint32_t side) : side_(side) {
    if (side < 1 || side > kMostSide) {
        throw std::invalid_argument(std::to_string(side) +
                                    " nodes along a face of directions, expected 1 to " +
                                    std::to_string(kMostSide));
    }
}

Imath::V3f DirectionGrid::direction(std::size_t node) const {
    if (side_ == 1) {
        return {0, 0, 1};
    }
    const auto place = [&](std::size_t i) {
        return std::tan(kEighthTurn *
                        (2 * static_cast<float>(i) / static_cast<float>(side_ - 1) - 1));
    };
    const std::size_t face_nodes = std::size_t{side_} * side_;
    const basis::FacePoint point{.face = static_cast<basis::Face>(node / face_nodes),
                                 .u = place(node % side_),
                                 .v = place(node % face_nodes / side_)};
    return basis::cube_point_from_face_point(point).normalized();
}

std::array<DirectionGrid::Node, 4> DirectionGrid::nodes_near(
    const Imath::V3f& direction) const {
    if (side_ == 1) {
        return {{{.index = 0, .weight = 1}, {}, {}, {}}};
    }
    const basis::FacePoint point = basis::face_point_from_direction(direction);
    struct Place {
        std::uint32_t cell = 0;
        float fraction = 0;
    };
    const auto place = [&](float along_face) {
        const float angle = std::atan(std::clamp(along_face, -1.0F, 1.0F)) / kEighthTurn;
        const float at = 0.5F * (angle + 1) * static_cast<float>(side_ - 1);
        const auto cell = std::min(static_cast<std::uint32_t>(at), side_ - 2);
        return Place{cell, std::min(at - static_cast<float>(cell), 1.0F)};
    };
    const Place column = place(point.u);
    const Place row = place(point.v);
    std::array<Node, 4> nodes;
    for (std::uint32_t corner = 0; corner < nodes.size(); ++corner) {
        const std::uint32_t right = corner % 2;
        const std::uint32_t lower = corner / 2;
        nodes[corner] = {
            .index = (static_cast<std::size_t>(point.face) * side_ + row.cell + lower) * side_ +
                     column.cell + right,
            .weight = (lower == 1 ? row.fraction : 1 - row.fraction) *
                      (right == 1 ? column.fraction : 1 - column.fraction)};
    }
    return nodes;
}

}  // namespace relume::tripling
