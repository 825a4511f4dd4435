// U = W·P by largest changes against all of it.
#include "tests/lab/cpca/second_step.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace relume::lab {
namespace {

constexpr std::size_t kPlanes = 3;
constexpr std::size_t kComponents = 8;

Eigen::MatrixXf orthonormal_weights() {
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    const Eigen::MatrixXf any =
        Eigen::MatrixXf::NullaryExpr(20, kComponents, [&] { return normal(random); });
    return any.householderQr().householderQ() * Eigen::MatrixXf::Identity(20, kComponents);
}

std::vector<float> some_answers(unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    std::vector<float> answers(kComponents * kPlanes);
    for (float& answer : answers) {
        answer = normal(random);
    }
    return answers;
}

double distance(const SecondStep& a, const SecondStep& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.vertices().size(); ++i) {
        const double off = double{a.vertices()[i]} - double{b.vertices()[i]};
        sum += off * off;
    }
    return std::sqrt(sum);
}

TEST(SecondStep, OfAllChangesIsAllOfIt) {
    SecondStep full(orthonormal_weights(), kPlanes);
    SecondStep incremental(orthonormal_weights(), kPlanes);
    for (unsigned image = 0; image < 20; ++image) {
        full.compute_all(some_answers(image));
        incremental.add_largest(some_answers(image), kComponents);
        EXPECT_LT(distance(full, incremental), 1e-4);
    }
}

TEST(SecondStep, AtRestIsAllOfItAfterAsManyImagesAsTheShare) {
    SecondStep full(orthonormal_weights(), kPlanes);
    SecondStep incremental(orthonormal_weights(), kPlanes);
    full.compute_all(some_answers(1));
    double before = distance(full, incremental);
    for (int image = 0; image < 4; ++image) {
        incremental.add_largest(some_answers(1), kComponents / 4);
        EXPECT_LT(distance(full, incremental), before);
        before = distance(full, incremental);
    }
    EXPECT_LT(before, 1e-5);
}

TEST(SecondStep, AddsTheLargestChanges) {
    SecondStep full(orthonormal_weights(), kPlanes);
    SecondStep incremental(orthonormal_weights(), kPlanes);
    const std::vector<float> answers = some_answers(2);
    std::vector<double> energies(kComponents);
    for (std::size_t i = 0; i < answers.size(); ++i) {
        energies[i / kPlanes] += double{answers[i]} * answers[i];
    }
    std::sort(energies.begin(), energies.end());
    full.compute_all(answers);
    incremental.add_largest(answers, kComponents - 2);
    EXPECT_NEAR(distance(full, incremental), std::sqrt(energies[0] + energies[1]), 1e-5);
    // More than there are: all.
    incremental.add_largest(answers, 2 * kComponents);
    EXPECT_LT(distance(full, incremental), 1e-5);
}

}  // namespace
}  // namespace relume::lab
