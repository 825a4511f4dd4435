#include "protocol/light/padded_cubemap.h"

#include <algorithm>

namespace relume::light {

basis::Texel texel_past_edge(std::uint32_t n, basis::Face face, int row, int column) {
    const float step = 2.0F / static_cast<float>(n);
    // Half a texel past the edge lies in the neighbour's outermost row, still beside this
    // texel.
    const auto coordinate = [&](int i) {
        const float outside = 1 + step / 2;
        if (i < 0) {
            return -outside;
        }
        return i >= static_cast<int>(n) ? outside : (static_cast<float>(i) + 0.5F) * step - 1;
    };
    return basis::texel_from_direction(
        n, basis::cube_point_from_face_point(
               {.face = face, .u = coordinate(column), .v = coordinate(row)}));
}

// edge(border, inner) and corner(border, own, beside, above); the latter two are border texels
// of the edges next to the corner.
template <typename Edge, typename Corner>
void PaddedCubemap::for_each_border_texel(Edge edge, Corner corner) const {
    const int end = static_cast<int>(m_);
    for (std::uint32_t f = 0; f < basis::kFaceCount; ++f) {
        const auto face = static_cast<basis::Face>(f);
        const auto visit = [&](int row, int column) {
            const basis::Texel past = texel_past_edge(m_, face, row, column);
            edge(at(face, row, column),
                 at(past.face, static_cast<int>(past.row), static_cast<int>(past.column)));
        };
        const auto visit_corner = [&](int row, int column) {
            const int inner_row = std::clamp(row, 0, end - 1);
            const int inner_column = std::clamp(column, 0, end - 1);
            corner(at(face, row, column), at(face, inner_row, inner_column),
                   at(face, inner_row, column), at(face, row, inner_column));
        };
        for (const int row : {-1, end}) {
            for (const int column : {-1, end}) {
                visit_corner(row, column);
            }
        }
        for (int i = 0; i < end; ++i) {
            visit(i, -1);
            visit(i, end);
            visit(-1, i);
            visit(end, i);
        }
    }
}

void PaddedCubemap::fill_borders() const {
    for_each_border_texel(
        [&](float* border, const float* inner) { std::copy_n(inner, channels_, border); },
        [](auto...) {});
    for_each_border_texel(
        [](auto...) {},
        [&](float* border, const float* own, const float* beside, const float* above) {
            for (std::size_t c = 0; c < channels_; ++c) {
                border[c] = (own[c] + beside[c] + above[c]) / 3;
            }
        });
}

void PaddedCubemap::fold_borders() const {
    for_each_border_texel([](auto...) {},
                          [&](const float* border, float* own, float* beside, float* above) {
                              for (std::size_t c = 0; c < channels_; ++c) {
                                  own[c] += border[c] / 3;
                                  beside[c] += border[c] / 3;
                                  above[c] += border[c] / 3;
                              }
                          });
    for_each_border_texel(
        [&](const float* border, float* inner) {
            for (std::size_t c = 0; c < channels_; ++c) {
                inner[c] += border[c];
            }
        },
        [](auto...) {});
}

}  // namespace relume::light
