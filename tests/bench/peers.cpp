#include "tests/bench/peers.h"

#include "server/engine/sums/band_sums.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

namespace relume::bench {
namespace {

double relative_l2(std::span<const float> image, std::span<const float> reference) {
    double difference = 0;
    double norm = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        const double d = double{image[i]} - double{reference[i]};
        difference += d * d;
        norm += double{reference[i]} * double{reference[i]};
    }
    return std::sqrt(difference / norm);
}

}  // namespace

nlohmann::json to_json(const Peers& peers) {
    const double columns = static_cast<double>(peers.columns.size());
    return {{"nonzeros", peers.eigen.nonzeros()},
            {"nonzeros_per_column", static_cast<double>(peers.eigen.nonzeros()) / columns},
            {"eigen_bytes", peers.eigen.bytes()},
            {"ng03_entries", peers.ng03.entries()},
            {"ng03_extra_entries", peers.ng03.extra_entries()},
            {"ng03_bytes", peers.ng03.bytes()}};
}

nlohmann::json checked_differences(const Peers& peers,
                                   std::span<const ChangesOfImage> images,
                                   double allowed) {
    engine::BandSums sums(peers.columns.scene().stored_operator());
    Ng03Product ng03(peers.ng03);
    std::vector<std::unique_ptr<EigenProduct>> eigen;
    for (const EigenLayout layout : kEigenLayouts) {
        eigen.push_back(std::make_unique<EigenProduct>(peers.eigen, layout));
    }
    for (const ChangesOfImage& image : images) {
        sums.update(0, image);
        ng03.add(image);
        for (const auto& product : eigen) {
            product->add(image);
        }
    }
    const std::vector<float> ours = peers.columns.image_from_sums(sums.total());
    nlohmann::json differences;
    const auto check = [&](const std::string& name, const std::vector<float>& image) {
        const double difference = relative_l2(image, ours);
        differences[name] = difference;
        if (!(difference <= allowed)) {
            throw std::runtime_error(fmt::format(
                "the image of {}, {}, differs from ours by {:.3g}, expected at most "
                "{}",
                name, name_from(peers.columns.basis()), difference, allowed));
        }
    };
    check("ng03", ng03.sums());
    for (std::size_t i = 0; i < eigen.size(); ++i) {
        check(fmt::format("eigen {}", name_from(kEigenLayouts[i])), eigen[i]->sums());
    }
    return differences;
}

}  // namespace relume::bench
