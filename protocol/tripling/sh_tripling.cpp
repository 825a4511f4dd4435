#include "protocol/tripling/sh_tripling.h"

#include "protocol/basis/spherical_harmonics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <numbers>

namespace relume::tripling {
namespace {

using Complex = std::complex<double>;

// n! for every sum of l that occurs.
long double factorial(std::int64_t n) {
    constexpr std::size_t kCount = 3 * kMostTriplingOrder + 2;
    static const auto table = [] {
        std::array<long double, kCount> values{};
        values[0] = 1;
        for (std::size_t i = 1; i < kCount; ++i) {
            values[i] = values[i - 1] * static_cast<long double>(i);
        }
        return values;
    }();
    return table.at(static_cast<std::size_t>(n));
}

// A real harmonic as a sum of two complex ones: weight of Y(l, |m|) and of Y(l, −|m|).
struct ComplexPair {
    Complex of_positive;
    Complex of_negative;
};

// The real harmonics have no Condon–Shortley sign: with s = (−1)^m,
//     √2 N|P| cos mφ = (s·Y(l, m) + Y(l, −m))/√2,  √2 N|P| sin mφ = (s·Y(l, m) − Y(l,
//     −m))/(i√2).
ComplexPair complex_pair(std::int32_t m) {
    const double size = 1 / std::numbers::sqrt2;
    const double sign = m % 2 == 0 ? 1 : -1;
    if (m > 0) {
        return {sign * size, size};
    }
    if (m < 0) {
        return {Complex(0, -sign * size), Complex(0, size)};
    }
    return {1, 0};
}

Harmonic harmonic_from_index(std::size_t index) {
    const std::uint32_t l = basis::sh_band_from_index(index);
    const auto m = static_cast<std::int64_t>(index) - std::int64_t{l} * l - l;
    return {.l = l, .m = static_cast<std::int32_t>(m)};
}

bool satisfies_triangle(const Harmonic& u, const Harmonic& v, const Harmonic& w) {
    const std::uint32_t difference = u.l > v.l ? u.l - v.l : v.l - u.l;
    return difference <= w.l && w.l <= u.l + v.l;
}

}  // namespace

double clebsch_gordan(const Harmonic& first, const Harmonic& second, const Harmonic& product) {
    const auto l1 = std::int64_t{first.l}, l2 = std::int64_t{second.l},
               l = std::int64_t{product.l};
    const auto m1 = std::int64_t{first.m}, m2 = std::int64_t{second.m},
               m = std::int64_t{product.m};
    if (m != m1 + m2 || !satisfies_triangle(first, second, product) || std::abs(m1) > l1 ||
        std::abs(m2) > l2 || std::abs(m) > l) {
        return 0;
    }
    const long double triangle = factorial(l1 + l2 - l) * factorial(l1 - l2 + l) *
                                 factorial(l2 - l1 + l) / factorial(l1 + l2 + l + 1);
    const long double sizes = factorial(l1 + m1) * factorial(l1 - m1) * factorial(l2 + m2) *
                              factorial(l2 - m2) * factorial(l + m) * factorial(l - m);
    const std::int64_t lowest = std::max({std::int64_t{0}, l2 - l - m1, l1 + m2 - l});
    const std::int64_t highest = std::min({l1 + l2 - l, l1 - m1, l2 + m2});
    long double sum = 0;
    for (std::int64_t k = lowest; k <= highest; ++k) {
        const long double below = factorial(k) * factorial(l1 + l2 - l - k) *
                                  factorial(l1 - m1 - k) * factorial(l2 + m2 - k) *
                                  factorial(l - l2 + m1 + k) * factorial(l - l1 - m2 + k);
        sum += (k % 2 == 0 ? 1 : -1) / below;
    }
    const long double scale =
        std::sqrt(static_cast<long double>(2 * l + 1)) * std::sqrt(triangle) * std::sqrt(sizes);
    return static_cast<double>(scale * sum);
}

double complex_sh_tripling(const Harmonic& u, const Harmonic& v, const Harmonic& w) {
    if ((u.l + v.l + w.l) % 2 != 0) {
        return 0;
    }
    const double scale =
        std::sqrt((2.0 * u.l + 1) * (2.0 * v.l + 1) / (4 * std::numbers::pi * (2.0 * w.l + 1)));
    const Harmonic u0{.l = u.l, .m = 0}, v0{.l = v.l, .m = 0}, w0{.l = w.l, .m = 0};
    return scale * clebsch_gordan(u0, v0, w0) * clebsch_gordan(u, v, w);
}

double sh_tripling(std::size_t u, std::size_t v, std::size_t w) {
    const Harmonic a = harmonic_from_index(u);
    const Harmonic b = harmonic_from_index(v);
    const Harmonic c = harmonic_from_index(w);
    // The third function is real, and so its own conjugate: Y_w = Σ conj(weight)·Y*(l, ±|m|).
    Complex sum = 0;
    for (const bool a_negative : {false, true}) {
        for (const bool b_negative : {false, true}) {
            for (const bool c_negative : {false, true}) {
                const auto weight = [](const Harmonic& real, bool negative) {
                    const ComplexPair pair = complex_pair(real.m);
                    return negative ? pair.of_negative : pair.of_positive;
                };
                const auto part = [](const Harmonic& real, bool negative) {
                    const std::int32_t m = std::abs(real.m);
                    return Harmonic{.l = real.l, .m = negative ? -m : m};
                };
                sum += weight(a, a_negative) * weight(b, b_negative) *
                       std::conj(weight(c, c_negative)) *
                       complex_sh_tripling(part(a, a_negative), part(b, b_negative),
                                           part(c, c_negative));
            }
        }
    }
    return sum.real();
}

std::uint64_t sh_tripling_bound(std::uint32_t most_l) {
    const std::uint64_t l = most_l;
    return ((((9 * l + 45) * l + 95) * l + 105) * l + 66) * l / 20 + 1;
}

}  // namespace relume::tripling
