// Methods in spherical harmonics: sh, linear; pbi-sh, the engine's PBI; pbi-sh-filled, the
// thesis' own.
#include "protocol/relighting/strategy.h"
#include "protocol/transport/transport.h"
#include "tests/lab/methods/band_filling.h"
#include "tests/lab/methods/families.h"
#include "tests/lab/methods/session_contestant.h"
#include "tests/lab/methods/wavelet_terms.h"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

namespace relume::lab {
namespace {

using Kind = basis::CubemapBasis::Kind;

// The lab's scene as it was baked in spherical harmonics of `order` or more.
std::shared_ptr<const served::Scene> sh_scene(const LabScene& scene, std::uint32_t order) {
    if (scene.sh_transport.empty()) {
        throw std::runtime_error(
            "methods in spherical harmonics need --sh-transport, the same view baked with "
            "relume-bake --basis sh");
    }
    auto baked =
        std::make_shared<const served::Scene>(transport::Transport::open(scene.sh_transport));
    const basis::CubemapBasis& found = baked->projection().basis();
    if (found.kind() != Kind::spherical_harmonics || found.order() < order) {
        throw std::runtime_error(fmt::format(
            "{}: basis {}, expected spherical harmonics of order {} or more",
            scene.sh_transport.string(), transport::json_from(found).dump(), order));
    }
    const transport::TileGrid image = baked->image();
    const transport::TileGrid expected = scene.haar->image();
    if (image.width != expected.width || image.height != expected.height ||
        found.face_resolution() != scene.haar->face_resolution()) {
        throw std::runtime_error(fmt::format(
            "{}: {}×{} pixels under 6×{n}×{n} lights, expected {}×{} under 6×{m}×{m}",
            scene.sh_transport.string(), image.width, image.height, expected.width,
            expected.height, fmt::arg("n", found.face_resolution()),
            fmt::arg("m", scene.haar->face_resolution())));
    }
    return baked;
}

std::uint32_t order_from_text(std::string_view text) {
    std::uint32_t order = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), order);
    if (error != std::errc() || end != text.data() + text.size() || order < 1 ||
        order > basis::kMaxShOrder) {
        throw std::invalid_argument(
            fmt::format("order '{}', expected 1 to {}", text, basis::kMaxShOrder));
    }
    return order;
}

// All coefficients of the order, each image anew.
Method linear_method(std::string_view rest) {
    const std::uint32_t order = order_from_text(rest);
    return {.label = fmt::format("sh-{}", order), .enter = [order](const LabScene& scene) {
                const auto baked = sh_scene(scene, order);
                const auto count = static_cast<std::uint32_t>(basis::sh_count(order));
                return session_over(
                    baked,
                    {.method = relighting::Method::nwa, .priority = relighting::Priority::none},
                    engine::SelectionBudget{.columns = count, .bytes = ~std::uint64_t{0}},
                    count);
            }};
}

// All bands there are, the budget's worth of differences an image.
Method incremental_method(std::string_view rest) {
    const WaveletTerms terms = wavelet_terms_from_text(rest);
    return {.label = "pbi-sh-" + terms.text, .enter = [terms](const LabScene& scene) {
                const auto baked = sh_scene(scene, 1);
                const std::size_t count = baked->columns().count();
                return session_over(
                    baked, {.method = relighting::Method::pbi, .priority = terms.priority},
                    terms.budget, count);
            }};
}

// The same, bands filled from the lowest.
Method filled_method(std::string_view rest) {
    std::uint32_t columns = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), columns);
    if (error != std::errc() || end != rest.data() + rest.size() || columns == 0) {
        throw std::invalid_argument(
            fmt::format("budget '{}', expected a number of coefficients", rest));
    }
    return {.label = fmt::format("pbi-sh-filled-{}", columns),
            .enter = [columns](const LabScene& scene) {
                return std::make_unique<PlannedContestant>(sh_scene(scene, 1),
                                                           make_band_filling(columns));
            }};
}

}  // namespace

void add_sh_families(std::vector<MethodFamily>& families) {
    families.push_back({.name = "sh",
                        .form = "ORDER",
                        .summary = "spherical harmonics, order² terms, anew each image",
                        .parse = linear_method});
    families.push_back({.name = "pbi-sh",
                        .form = std::string(kWaveletTermsForm),
                        .summary = "pbi in spherical harmonics, a band an l",
                        .parse = incremental_method});
    families.push_back(
        {.name = "pbi-sh-filled",
         .form = "COLUMNS",
         .summary = "the same, bands filled from the lowest [Overbeck06T fig. 8.1]",
         .parse = filled_method});
}

}  // namespace relume::lab
