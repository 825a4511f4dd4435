#include "tests/laws/picture_comparison.h"

#include <OpenImageIO/imageio.h>
#include <boost/math/distributions/students_t.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>

namespace relume::test {
namespace {

using Imath::V3d;

double two_sided_p(double t, double degrees) {
    const boost::math::students_t distribution(std::max(1.0, degrees));
    return 2.0 * cdf(complement(distribution, std::abs(t)));
}

void write_image(const std::filesystem::path& path,
                 std::uint32_t width,
                 std::uint32_t height,
                 const std::vector<float>& rgb) {
    const auto output = OIIO::ImageOutput::create(path.string());
    const bool is_linear = path.extension() == ".exr";
    const OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height), 3,
                               is_linear ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
    if (!output || !output->open(path.string(), spec) ||
        !output->write_image(OIIO::TypeDesc::FLOAT, rgb.data()) || !output->close())
        throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

std::string PictureComparison::summary() const {
    double mean = 0;
    double square = 0;
    for (const V3d& value : z) {
        mean += value.x + value.y + value.z;
        square += value.length2();
    }
    const double count = 3.0 * static_cast<double>(z.size());
    return fmt::format(
        "{} of {} tests rejected; smallest p {:.3g}, threshold {:.3g}; z has mean {:.3f} and "
        "root mean square {:.3f}; relative L2 {:.4f}",
        rejections, tests, smallest_p, threshold, mean / count, std::sqrt(square / count),
        relative_l2);
}

PictureComparison compare(const Estimate& ours,
                          const reference::TracedImage& truth,
                          std::uint32_t truth_samples,
                          double significance,
                          double resolution) {
    PictureComparison result;
    result.tests = 3 * truth.mean.size();
    result.threshold =
        1.0 - std::pow(1.0 - significance, 1.0 / static_cast<double>(result.tests));
    result.relative_l2 = relative_l2(ours.mean, truth.mean);
    for (std::size_t p = 0; p < truth.mean.size(); ++p) {
        V3d z(0, 0, 0);
        for (int c = 0; c < 3; ++c) {
            const double difference = ours.mean[p][c] - truth.mean[p][c];
            const double tolerance = resolution * std::abs(truth.mean[p][c]);
            const double beyond = std::max(0.0, std::abs(difference) - tolerance);
            const double a = ours.variance[p][c];
            const double b = truth.variance[p][c];
            if (beyond == 0)
                continue;
            const double error = std::sqrt(a + b);
            // Welch and Satterthwaite's degrees of freedom.
            const double degrees =
                error > 0 ? (a + b) * (a + b) /
                                (a * a / (ours.seeds - 1.0) + b * b / (truth_samples - 1.0))
                          : 1;
            const double value = error > 0 ? beyond / error : 1e6;
            const double probability = error > 0 ? two_sided_p(value, degrees) : 0.0;
            z[c] = std::copysign(value, difference);
            result.smallest_p = std::min(result.smallest_p, probability);
            result.rejections += probability < result.threshold ? 1U : 0U;
        }
        result.z.push_back(z);
    }
    return result;
}

std::filesystem::path write_evidence(const std::string& name,
                                     const Estimate& ours,
                                     const reference::TracedImage& truth,
                                     const PictureComparison& comparison) {
    const char* wanted = std::getenv("RELUME_EVIDENCE");
    const std::filesystem::path folder = wanted != nullptr ? wanted : "evidence";
    std::filesystem::create_directories(folder);
    const auto write = [&](const std::string& what, const std::vector<V3d>& pixels,
                           auto display) {
        std::vector<float> linear;
        std::vector<float> shown;
        for (const V3d& pixel : pixels) {
            for (int c = 0; c < 3; ++c) {
                linear.push_back(static_cast<float>(pixel[c]));
                shown.push_back(static_cast<float>(std::clamp(display(pixel[c]), 0.0, 1.0)));
            }
        }
        for (const char* extension : {".exr", ".png"})
            write_image(folder / (name + "-" + what + extension), truth.width, truth.height,
                        extension == std::string(".exr") ? linear : shown);
    };
    const auto tone = [](double v) { return std::pow(std::max(0.0, v), 1.0 / 2.2); };
    write("ours", ours.mean, tone);
    write("reference", truth.mean, tone);
    // Grey is agreement; white and black are five standard errors.
    write("z", comparison.z, [](double v) { return 0.5 + v / 10.0; });
    return std::filesystem::absolute(folder);
}

}  // namespace relume::test
