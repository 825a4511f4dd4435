#include "server/triple/triple_session.h"

#include "protocol/base/timing/stopwatch.h"
#include "protocol/tripling/texel_blocks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace relume::triple {
namespace {

// The next of a sequence of numbers that look random [Steele14].
std::uint64_t next_random(std::uint64_t& state) {
    state += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
}

double squared(const Radiance& radiance) {
    double sum = 0;
    for (const float value : radiance) {
        sum += double{value} * double{value};
    }
    return sum;
}

double squared_distance(const Radiance& a, const Radiance& b) {
    return squared({a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

}  // namespace

TripleSession::TripleSession(std::shared_ptr<const LitSurface> surface)
    : surface_(std::move(surface)),
      materials_(surface_->material_count()),
      weights_(surface_->vertex_count(), 1.0F),
      is_stale_(surface_->vertex_count(), true),
      radiance_(surface_->vertex_count(), Radiance{}) {
    const std::vector<float> black(basis::texel_count(surface_->face_resolution()), 0.0F);
    set_light({black, black, black});
}

void TripleSession::set_light(const std::array<std::span<const float>, 3>& texels) {
    const std::size_t expected = basis::texel_count(surface_->face_resolution());
    for (std::size_t c = 0; c < texels.size(); ++c) {
        if (texels[c].size() != expected) {
            throw std::invalid_argument("light of " + std::to_string(texels[c].size()) +
                                        " texels, expected " + std::to_string(expected));
        }
        light_[c] = tripling::values_in_blocks(surface_->face_resolution(), texels[c]);
    }
    make_stale([](std::size_t /*vertex*/) { return true; });
}

void TripleSession::set_material(std::uint32_t material, Finish finish) {
    if (material >= materials_.size()) {
        throw std::invalid_argument("material " + std::to_string(material) +
                                    ", expected one below " +
                                    std::to_string(materials_.size()));
    }
    if (finish.material &&
        finish.material->face_resolution() != surface_->face_resolution()) {
        throw std::invalid_argument("a material field of face resolution " +
                                    std::to_string(finish.material->face_resolution()) +
                                    ", expected " +
                                    std::to_string(surface_->face_resolution()) +
                                    ", as the visibility has");
    }
    materials_[material] = std::move(finish);
    make_stale([&](std::size_t vertex) { return surface_->material(vertex) == material; });
}

// A vertex that is not seen stays stale until it is; one whose material does not depend on the
// view keeps what it has.
void TripleSession::set_view(const Imath::V3f& eye,
                             std::span<const std::uint32_t> seen,
                             std::span<const float> weights) {
    if (!weights.empty() && weights.size() != seen.size()) {
        throw std::invalid_argument(std::to_string(weights.size()) + " weights, expected " +
                                    std::to_string(seen.size()) + ", one a vertex");
    }
    for (const std::uint32_t vertex : seen) {
        if (vertex >= surface_->vertex_count()) {
            throw std::invalid_argument("vertex " + std::to_string(vertex) +
                                        ", expected one below " +
                                        std::to_string(surface_->vertex_count()));
        }
    }
    const bool has_moved = eye != eye_;
    eye_ = eye;
    seen_.assign(seen.begin(), seen.end());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        weights_[seen[i]] = weights.empty() ? 1.0F : weights[i];
    }
    make_stale([&](std::size_t vertex) {
        return has_moved && materials_[surface_->material(vertex)].depends_on_view();
    });
}

template <typename IsStale>
void TripleSession::make_stale(const IsStale& is_stale) {
    for (std::size_t vertex = 0; vertex < is_stale_.size(); ++vertex) {
        if (is_stale(vertex)) {
            is_stale_[vertex] = true;
        }
    }
    begin_estimate();
}

void TripleSession::begin_estimate() {
    stale_.clear();
    first_stale_ = 0;
    squared_change_ = made_norm_ = norm_ = 0;
    for (const std::uint32_t vertex : seen_) {
        norm_ += double{weights_[vertex]} * squared(radiance_[vertex]);
        if (is_stale_[vertex]) {
            stale_.push_back(vertex);
        }
    }
}

Radiance TripleSession::integrate(std::uint32_t vertex) const {
    const Finish& finish = materials_[surface_->material(vertex)];
    if (!finish.material) {
        return {};
    }
    const auto radiance_of = [&](const TexelMaterial& material) {
        return material.radiance(surface_->normal(vertex), surface_->reflection(vertex, eye_),
                                 surface_->open(vertex),
                                 {light_[0].data(), light_[1].data(), light_[2].data()},
                                 finish.colours);
    };
    Radiance radiance = radiance_of(*finish.material);
    if (finish.next) {
        const Radiance next = radiance_of(*finish.next);
        for (std::size_t c = 0; c < radiance.size(); ++c) {
            radiance[c] += finish.amount_of_next * (next[c] - radiance[c]);
        }
    }
    return radiance;
}

bool TripleSession::advance_by(std::size_t vertices) {
    const std::size_t count = std::min(vertices, stale_count());
    if (count == 0) {
        return false;
    }
    // Those to be made come first, drawn from all that are left.
    for (std::size_t i = first_stale_; i < first_stale_ + count; ++i) {
        std::swap(stale_[i], stale_[i + next_random(random_) % (stale_.size() - i)]);
    }
    std::vector<Radiance> made(count);
    tbb::parallel_for(std::size_t{0}, count,
                      [&](std::size_t i) { made[i] = integrate(stale_[first_stale_ + i]); });
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t vertex = stale_[first_stale_ + i];
        const double weight = weights_[vertex];
        squared_change_ += weight * squared_distance(made[i], radiance_[vertex]);
        made_norm_ += weight * (squared(made[i]) - squared(radiance_[vertex]));
        radiance_[vertex] = made[i];
        is_stale_[vertex] = false;
    }
    first_stale_ += count;
    return true;
}

bool TripleSession::advance(double milliseconds) {
    constexpr std::size_t kLeastRun = 64;
    constexpr double kPartOfRest = 0.5;  // so that a wrong guess is found out in time
    const timing::Stopwatch watch;
    bool has_changed = false;
    double left = 1e-3 * milliseconds;
    while (!exact() && (left > 0 || !has_changed)) {
        const double fits = kPartOfRest * left / seconds_per_vertex_;
        const std::size_t run =
            std::max(kLeastRun, static_cast<std::size_t>(std::clamp(fits, 0.0, 1e9)));
        const std::size_t count = std::min(run, stale_count());
        const double before = watch.seconds();
        has_changed = advance_by(count) || has_changed;
        seconds_per_vertex_ = (watch.seconds() - before) / static_cast<double>(count);
        left = 1e-3 * milliseconds - watch.seconds();
    }
    return has_changed;
}

double TripleSession::stated_error() const {
    if (exact()) {
        return 0;
    }
    if (first_stale_ == 0) {
        return 1;
    }
    const auto made = static_cast<double>(first_stale_);
    const auto left = static_cast<double>(stale_count());
    const double squared_error = squared_change_ / made * left;
    // What all will be, as far as those that are made tell.
    const double norm = norm_ + made_norm_ * (1 + left / made);
    return norm > 0 ? std::sqrt(squared_error / norm) : 1;
}

}  // namespace relume::triple
