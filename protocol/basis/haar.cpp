#include "protocol/basis/haar.h"

#include "protocol/basis/cubemap.h"

#include <algorithm>
#include <bit>

namespace relume::basis {

void haar_forward(std::uint32_t n, std::span<float> face, std::span<float> scratch) {
    for (std::size_t side = n; side > 1; side /= 2) {
        const std::size_t half = side / 2;
        for (std::size_t row = 0; row < half; ++row) {
            const float* upper = &face[2 * row * n];
            const float* lower = upper + n;
            float* average = &scratch[row * side];
            float* along_columns = average + half;
            float* along_rows = &scratch[(row + half) * side];
            float* along_both = along_rows + half;
            for (std::size_t column = 0; column < half; ++column) {
                const float p = upper[2 * column];
                const float q = upper[2 * column + 1];
                const float r = lower[2 * column];
                const float s = lower[2 * column + 1];
                average[column] = 0.5F * ((p + q) + (r + s));
                along_columns[column] = 0.5F * ((p - q) + (r - s));
                along_rows[column] = 0.5F * ((p + q) - (r + s));
                along_both[column] = 0.5F * ((p - q) - (r - s));
            }
        }
        for (std::size_t row = 0; row < side; ++row) {
            std::copy_n(&scratch[row * side], side, &face[row * n]);
        }
    }
}

void haar_inverse(std::uint32_t n, std::span<float> face, std::span<float> scratch) {
    for (std::size_t side = 2; side <= n; side *= 2) {
        const std::size_t half = side / 2;
        for (std::size_t row = 0; row < side; ++row) {
            std::copy_n(&face[row * n], side, &scratch[row * side]);
        }
        for (std::size_t row = 0; row < half; ++row) {
            const float* average = &scratch[row * side];
            const float* along_columns = average + half;
            const float* along_rows = &scratch[(row + half) * side];
            const float* along_both = along_rows + half;
            float* upper = &face[2 * row * n];
            float* lower = upper + n;
            for (std::size_t column = 0; column < half; ++column) {
                const float a = average[column];
                const float h = along_columns[column];
                const float v = along_rows[column];
                const float d = along_both[column];
                upper[2 * column] = 0.5F * ((a + h) + (v + d));
                upper[2 * column + 1] = 0.5F * ((a - h) + (v - d));
                lower[2 * column] = 0.5F * ((a + h) - (v + d));
                lower[2 * column + 1] = 0.5F * ((a - h) - (v - d));
            }
        }
    }
}

namespace {

template <typename Transform>
void for_each_face(std::uint32_t n, std::span<float> cubemap, Transform transform) {
    alignas(
        64) thread_local float scratch[std::size_t{kMaxFaceResolution} * kMaxFaceResolution];
    const std::size_t face_size = std::size_t{n} * n;
    for (std::size_t face = 0; face < kFaceCount; ++face) {
        transform(n, cubemap.subspan(face * face_size, face_size), std::span<float>(scratch));
    }
}

}  // namespace

void haar_forward_cubemap(std::uint32_t n, std::span<float> cubemap) {
    for_each_face(n, cubemap, haar_forward);
}

void haar_inverse_cubemap(std::uint32_t n, std::span<float> cubemap) {
    for_each_face(n, cubemap, haar_inverse);
}

std::uint32_t band_count(std::uint32_t n) {
    return static_cast<std::uint32_t>(std::countr_zero(n));
}

std::uint32_t band_from_coefficient(std::uint32_t n, std::size_t coefficient) {
    const Texel place = texel_from_index(n, coefficient);
    const std::uint32_t outer = std::max(place.row, place.column);
    return outer == 0 ? 0 : static_cast<std::uint32_t>(std::bit_width(outer)) - 1;
}

}  // namespace relume::basis
