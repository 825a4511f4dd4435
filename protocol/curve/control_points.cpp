#include "protocol/curve/control_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace relume::curve {
namespace {

void require_points(std::span<const ControlPoint> points, ValueScale scale) {
    if (points.empty() || points.size() > kMostControlPoints) {
        throw CurveError(fmt::format("control points: found {}, expected 1 … {}", points.size(),
                                     kMostControlPoints));
    }
    const double lowest = scale == ValueScale::logarithmic ? kLeastLogarithmicValue : 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ControlPoint& point = points[i];
        if (!(point.u >= 0 && point.u <= 1)) {
            throw CurveError(
                fmt::format("control point {}: found u {}, expected 0 … 1", i, point.u));
        }
        if (i > 0 && !(point.u > points[i - 1].u)) {
            throw CurveError(fmt::format("control point {}: found u {} after {}, expected more",
                                         i, point.u, points[i - 1].u));
        }
        for (int c = 0; c < 3; ++c) {
            if (!(point.value[c] >= lowest &&
                  point.value[c] <= static_cast<double>(kMostCurveValue))) {
                throw CurveError(fmt::format("control point {}: found {}, expected {} … {}", i,
                                             point.value[c], lowest, kMostCurveValue));
            }
        }
    }
}

// One colour's interpolant through (x, y), x strictly rising.
class MonotoneCubic {
  public:
    MonotoneCubic(std::vector<double> x, std::vector<double> y)
        : x_(std::move(x)), y_(std::move(y)), tangents_(x_.size(), 0.0) {
        const std::size_t count = x_.size();
        if (count < 2) {
            return;
        }
        tangents_.front() = secant(0);
        tangents_.back() = secant(count - 2);
        for (std::size_t i = 1; i + 1 < count; ++i) {
            const double before = secant(i - 1);
            const double after = secant(i);
            tangents_[i] = before * after > 0 ? 0.5 * (before + after) : 0.0;
        }
        for (std::size_t i = 0; i + 1 < count; ++i) {
            limit_tangents(i);
        }
    }

    [[nodiscard]] double at(double x) const {
        const auto after = std::upper_bound(x_.begin(), x_.end(), x);
        if (after == x_.begin()) {
            return y_.front();
        }
        if (after == x_.end()) {
            return y_.back();
        }
        const auto i = static_cast<std::size_t>(after - x_.begin()) - 1;
        const double h = x_[i + 1] - x_[i];
        const double t = (x - x_[i]) / h;
        const double s = 1 - t;
        return s * s * (1 + 2 * t) * y_[i] + s * s * t * h * tangents_[i] +
               t * t * (1 + 2 * s) * y_[i + 1] - t * t * s * h * tangents_[i + 1];
    }

  private:
    [[nodiscard]] double secant(std::size_t i) const {
        return (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]);
    }
    // Into the disc of radius 3 in units of the secant, where the cubic is monotone.
    void limit_tangents(std::size_t i) {
        const double slope = secant(i);
        if (slope == 0) {
            tangents_[i] = tangents_[i + 1] = 0;
            return;
        }
        const double length = std::hypot(tangents_[i] / slope, tangents_[i + 1] / slope);
        if (length > 3) {
            tangents_[i] *= 3 / length;
            tangents_[i + 1] *= 3 / length;
        }
    }

    std::vector<double> x_;
    std::vector<double> y_;
    std::vector<double> tangents_;
};

MonotoneCubic cubic_of(std::span<const ControlPoint> points, ValueScale scale, int colour) {
    std::vector<double> x;
    std::vector<double> y;
    for (const ControlPoint& point : points) {
        const double value = point.value[colour];
        x.push_back(point.u);
        y.push_back(scale == ValueScale::logarithmic ? std::log(value) : value);
    }
    return {std::move(x), std::move(y)};
}

}  // namespace

Curve curve_from_points(std::span<const ControlPoint> points, ValueScale scale) {
    require_points(points, scale);
    const MonotoneCubic colours[]{cubic_of(points, scale, 0), cubic_of(points, scale, 1),
                                  cubic_of(points, scale, 2)};
    return curve_from_function([&](double u) {
        const auto value = [&](const MonotoneCubic& cubic) {
            const double y =
                scale == ValueScale::logarithmic ? std::exp(cubic.at(u)) : cubic.at(u);
            // Rounding may leave the range by an ulp.
            return std::clamp(y, 0.0, static_cast<double>(kMostCurveValue));
        };
        return Imath::V3d(value(colours[0]), value(colours[1]), value(colours[2]));
    });
}

}  // namespace relume::curve
