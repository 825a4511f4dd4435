#include "precompute/scene/builtin/drape.h"

#include "precompute/scene/builtin/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace relume::scene {
namespace {

constexpr float kTimeStep = 1.0F / 200;  // seconds
constexpr float kGravity = 9.81F;        // m/s²
constexpr float kDamping = 0.985F;       // of velocities, a step
constexpr float kFriction = 0.35F;       // part of what slides that is taken back
constexpr float kBendStiffness = 0.12F;  // part of a bend that is taken back, an iteration

struct Thread {
    std::size_t a = 0;
    std::size_t b = 0;
    float length = 0;
    float stiffness = 1;
};

std::vector<Thread> threads_of(const ClothDrop& drop) {
    struct Kind {
        std::uint32_t rows;
        std::uint32_t columns;
        bool falling;  // from the upper right to the lower left
        float stiffness;
    };
    constexpr std::array<Kind, 6> kKinds{{{0, 1, false, 1},
                                          {1, 0, false, 1},
                                          {1, 1, false, 0.5F},
                                          {1, 1, true, 0.5F},
                                          {0, 2, false, kBendStiffness},
                                          {2, 0, false, kBendStiffness}}};
    const float spacing = drop.side / static_cast<float>(drop.count - 1) * (1 + drop.slack);
    std::vector<Thread> threads;
    for (const Kind& kind : kKinds) {
        const float length = spacing * std::hypot(static_cast<float>(kind.rows),
                                                  static_cast<float>(kind.columns));
        for (std::uint32_t i = 0; i + kind.rows < drop.count; ++i) {
            for (std::uint32_t j = 0; j + kind.columns < drop.count; ++j) {
                const std::uint32_t from = kind.falling ? j + kind.columns : j;
                const std::uint32_t to = kind.falling ? j : j + kind.columns;
                threads.push_back({.a = std::size_t{i} * drop.count + from,
                                   .b = std::size_t{i + kind.rows} * drop.count + to,
                                   .length = length,
                                   .stiffness = kind.stiffness});
            }
        }
    }
    return threads;
}

void pull(const Thread& thread, std::vector<Imath::V3f>& points) {
    Imath::V3f& a = points[thread.a];
    Imath::V3f& b = points[thread.b];
    const Imath::V3f between = b - a;
    const float length = between.length();
    if (length > 0) {
        const Imath::V3f half =
            between * (0.5F * thread.stiffness * (length - thread.length) / length);
        a += half;
        b -= half;
    }
}

// Weights of four points that follow each other, at `t` in [0, 1] between the middle two.
std::array<float, 4> spline_weights(float t) {
    const float s = 1 - t;
    return {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
            (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6};
}

// Which four points of `count`, and how much of each: point `i` of `finer`.
struct SplinePlace {
    std::array<std::uint32_t, 4> point{};
    std::array<float, 4> weight{};
};
SplinePlace spline_place(std::uint32_t i, std::uint32_t finer, std::uint32_t count) {
    const float at =
        static_cast<float>(i) * static_cast<float>(count - 1) / static_cast<float>(finer - 1);
    const auto before = std::min(static_cast<std::uint32_t>(at), count - 2);
    SplinePlace place{.weight = spline_weights(at - static_cast<float>(before))};
    for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t beyond = before + k;  // by one
        place.point[k] = std::min(beyond > 0 ? beyond - 1 : 0, count - 1);
    }
    return place;
}

}  // namespace

Cloth draped_cloth(const ClothDrop& drop, const PushOut& push_out) {
    Cloth cloth{.count = drop.count, .points = {}};
    Random random(drop.seed);
    const float spacing = drop.side / static_cast<float>(drop.count - 1);
    for (std::uint32_t i = 0; i < drop.count; ++i) {
        for (std::uint32_t j = 0; j < drop.count; ++j) {
            const Imath::V3f flat(static_cast<float>(j) * spacing - drop.side / 2, drop.height,
                                  static_cast<float>(i) * spacing - drop.side / 2);
            const float wave =
                value_noise(flat * (12 / drop.side), static_cast<std::uint32_t>(drop.seed)) +
                random.uniform(-0.1F, 0.1F);
            cloth.points.push_back(flat + Imath::V3f(0, 1.5F * spacing * wave, 0));
        }
    }
    const std::vector<Thread> threads = threads_of(drop);
    std::vector<Imath::V3f> before = cloth.points;
    const Imath::V3f fall(0, -kGravity * kTimeStep * kTimeStep, 0);
    for (std::uint32_t step = 0; step < drop.steps; ++step) {
        std::vector<Imath::V3f> start = cloth.points;
        for (std::size_t i = 0; i < start.size(); ++i) {
            cloth.points[i] += (start[i] - before[i]) * kDamping + fall;
        }
        for (std::uint32_t iteration = 0; iteration < drop.iterations; ++iteration) {
            for (const Thread& thread : threads) {
                pull(thread, cloth.points);
            }
            for (std::size_t i = 0; i < start.size(); ++i) {
                Imath::V3f& point = cloth.points[i];
                const Imath::V3f free = push_out(point);
                if (free != point) {
                    const Imath::V3f out = (free - point).normalized();
                    const Imath::V3f moved = free - start[i];
                    point = free - (moved - out * moved.dot(out)) * kFriction;
                }
            }
        }
        before.swap(start);
    }
    return cloth;
}

Cloth smoothed_cloth(const Cloth& cloth, std::uint32_t count) {
    Cloth smooth{.count = count, .points = {}};
    for (std::uint32_t i = 0; i < count; ++i) {
        const SplinePlace rows = spline_place(i, count, cloth.count);
        for (std::uint32_t j = 0; j < count; ++j) {
            const SplinePlace columns = spline_place(j, count, cloth.count);
            Imath::V3f point(0, 0, 0);
            for (std::size_t k = 0; k < 4; ++k) {
                for (std::size_t l = 0; l < 4; ++l) {
                    point += cloth.at(rows.point[k], columns.point[l]) *
                             (rows.weight[k] * columns.weight[l]);
                }
            }
            smooth.points.push_back(point);
        }
    }
    return smooth;
}

}  // namespace relume::scene
