// Tripling coefficients of pixels, Fourier series and spherical harmonics.
#include "protocol/basis/spherical_harmonics.h"
#include "protocol/tripling/fourier_tripling.h"
#include "protocol/tripling/pixel_tripling.h"
#include "protocol/tripling/sh_tripling.h"

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace relume::tripling {
namespace {

TEST(PixelTripling, JoinsATexelWithItselfAlone) {
    constexpr std::size_t kTexels = 9;
    std::uint64_t nonzero = 0;
    for (std::size_t u = 0; u < kTexels; ++u) {
        for (std::size_t v = 0; v < kTexels; ++v) {
            for (std::size_t w = 0; w < kTexels; ++w) {
                double sum = 0;
                for (std::size_t texel = 0; texel < kTexels; ++texel) {
                    sum += texel == u && texel == v && texel == w ? 1 : 0;
                }
                EXPECT_EQ(pixel_tripling(u, v, w), sum);
                nonzero += sum != 0 ? 1 : 0;
            }
        }
    }
    EXPECT_EQ(nonzero, pixel_tripling_count(kTexels));
}

std::vector<Frequency> frequencies_up_to(std::int32_t band_limit) {
    std::vector<Frequency> frequencies;
    for (std::int32_t row = -band_limit; row <= band_limit; ++row) {
        for (std::int32_t column = -band_limit; column <= band_limit; ++column) {
            frequencies.push_back({row, column});
        }
    }
    return frequencies;
}

std::complex<double> fourier_value(std::uint32_t n,
                                   const Frequency& f,
                                   std::uint32_t row,
                                   std::uint32_t column) {
    const double turn = (1.0 * f.along_rows * row + 1.0 * f.along_columns * column) / n;
    return std::polar(1.0 / n, 2 * std::numbers::pi * turn);
}

// Grids with room for the sums of frequencies, and one on which they wrap around.
TEST(FourierTripling, IsTheSumOverTheGridForEveryTriple) {
    for (const std::int32_t band_limit : {0, 1, 2}) {
        const auto frequencies = frequencies_up_to(band_limit);
        const auto enough = static_cast<std::uint32_t>(3 * band_limit + 1);
        for (const std::uint32_t n : {enough, static_cast<std::uint32_t>(2 * band_limit + 1)}) {
            std::uint64_t nonzero = 0;
            for (const Frequency& u : frequencies) {
                for (const Frequency& v : frequencies) {
                    for (const Frequency& w : frequencies) {
                        std::complex<double> sum = 0;
                        for (std::uint32_t i = 0; i < n * n; ++i) {
                            sum += fourier_value(n, u, i / n, i % n) *
                                   fourier_value(n, v, i / n, i % n) *
                                   std::conj(fourier_value(n, w, i / n, i % n));
                        }
                        const double expected = fourier_tripling(n, u, v, w);
                        ASSERT_NEAR(std::abs(sum - expected), 0, 1e-13);
                        nonzero += expected != 0 ? 1 : 0;
                    }
                }
            }
            const std::uint64_t count =
                fourier_tripling_count(static_cast<std::uint32_t>(band_limit));
            const std::uint64_t functions = frequencies.size();
            EXPECT_EQ(16 * count, (1 + 3 * functions) * (1 + 3 * functions));
            if (n == enough) {
                EXPECT_EQ(nonzero, count);
            } else {
                EXPECT_EQ(nonzero,
                          functions * functions);  // the grid's whole basis: one w each
            }
        }
    }
}

// Values of all real harmonics at the points of a rule that is exact for products of three,
// each times the cube root of the point's weight.
std::vector<std::vector<double>> harmonics_at_nodes(std::uint32_t order) {
    using Rule = boost::math::quadrature::gauss<double, 20>;  // exact up to degree 39
    constexpr int kAzimuths = 48;
    std::vector<std::vector<double>> values;
    for (std::size_t node = 0; node < Rule::abscissa().size(); ++node) {
        for (const int side : {-1, 1}) {
            const double z = side * Rule::abscissa()[node];
            const double radius = std::sqrt(1 - z * z);
            const double weight = Rule::weights()[node] * 2 * std::numbers::pi / kAzimuths;
            for (int step = 0; step < kAzimuths; ++step) {
                const double azimuth = 2 * std::numbers::pi * (step + 0.3) / kAzimuths;
                std::vector<double> at(basis::sh_count(order));
                basis::evaluate_sh(
                    order, {radius * std::cos(azimuth), radius * std::sin(azimuth), z}, at);
                for (double& value : at) {
                    value *= std::cbrt(weight);
                }
                values.push_back(std::move(at));
            }
        }
    }
    return values;
}

double quadrature(const std::vector<std::vector<double>>& values,
                  std::size_t u,
                  std::size_t v,
                  std::size_t w) {
    double sum = 0;
    for (const std::vector<double>& at : values) {
        sum += at[u] * at[v] * at[w];
    }
    return sum;
}

TEST(ShTripling, IsTheIntegralOverTheSphereForEveryTriple) {
    constexpr std::uint32_t kOrder = 4;
    const auto values = harmonics_at_nodes(kOrder);
    for (std::size_t u = 0; u < basis::sh_count(kOrder); ++u) {
        for (std::size_t v = 0; v <= u; ++v) {
            for (std::size_t w = 0; w <= v; ++w) {
                const double expected = quadrature(values, u, v, w);
                EXPECT_NEAR(sh_tripling(u, v, w), expected, 1e-13);
                EXPECT_NEAR(sh_tripling(v, w, u), expected, 1e-13);
                EXPECT_NEAR(sh_tripling(w, u, v), expected, 1e-13);
            }
        }
    }
}

TEST(ShTripling, KeepsItsDigitsUpToTheHighestOrder) {
    const auto values = harmonics_at_nodes(kMostTriplingOrder);
    const std::size_t count = basis::sh_count(kMostTriplingOrder);
    for (std::size_t step = 0; step < 400; ++step) {
        const std::size_t u = count - 1 - step % 23;
        const std::size_t v = (step * 37) % count;
        const std::size_t w = (step * 53 + 11) % count;
        EXPECT_NEAR(sh_tripling(u, v, w), quadrature(values, u, v, w), 1e-11)
            << u << ", " << v << ", " << w;
    }
}

TEST(ClebschGordan, IsOrthonormal) {
    // Σ over m1 of ⟨l1 m1 l2 m−m1 | l m⟩ ⟨l1 m1 l2 m−m1 | l' m⟩ = δ(l, l').
    for (std::uint32_t l = 1; l <= 7; ++l) {
        for (std::uint32_t other = 1; other <= 7; ++other) {
            for (const std::int32_t m : {-1, 0, 1}) {
                double sum = 0;
                for (std::int32_t m1 = -3; m1 <= 3; ++m1) {
                    sum += clebsch_gordan({3, m1}, {4, m - m1}, {l, m}) *
                           clebsch_gordan({3, m1}, {4, m - m1}, {other, m});
                }
                EXPECT_NEAR(sum, l == other ? 1 : 0, 1e-14);
            }
        }
    }
    EXPECT_NEAR(clebsch_gordan({1, 1}, {1, -1}, {0, 0}), 1 / std::sqrt(3.0), 1e-15);
    EXPECT_NEAR(clebsch_gordan({1, 0}, {1, 0}, {2, 0}), std::sqrt(2.0 / 3), 1e-15);
}

// The formula of [Ng04 App. B.2] counts what two constraints let through. A third one, and
// zeros of the Clebsch-Gordan coefficients themselves, leave fewer.
TEST(ShTripling, IsZeroMoreOftenThanThePapersCountSays) {
    for (std::uint32_t most_l = 0; most_l <= 4; ++most_l) {
        std::vector<Harmonic> harmonics;
        for (std::uint32_t l = 0; l <= most_l; ++l) {
            const auto signed_l = static_cast<std::int32_t>(l);
            for (std::int32_t m = -signed_l; m <= signed_l; ++m) {
                harmonics.push_back({.l = l, .m = m});
            }
        }
        std::uint64_t allowed = 0;
        std::uint64_t nonzero = 0;
        for (const Harmonic& u : harmonics) {
            for (const Harmonic& v : harmonics) {
                for (const Harmonic& w : harmonics) {
                    const std::uint32_t difference = u.l > v.l ? u.l - v.l : v.l - u.l;
                    allowed += w.m == u.m + v.m && difference <= w.l && w.l <= u.l + v.l;
                    nonzero += std::abs(complex_sh_tripling(u, v, w)) > 1e-12;
                }
            }
        }
        EXPECT_EQ(allowed, sh_tripling_bound(most_l));
        EXPECT_LE(nonzero, allowed);
        if (most_l >= 1) {
            EXPECT_LT(nonzero, allowed);
        }
        RecordProperty("nonzero_complex_l" + std::to_string(most_l), std::to_string(nonzero));
    }
}

}  // namespace
}  // namespace relume::tripling
