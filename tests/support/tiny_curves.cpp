#include "tests/support/tiny_curves.h"

#include "protocol/curve/curve_brdf.h"
#include "protocol/curve/curve_json.h"

namespace relume::test {

void write_tiny_curves(const std::filesystem::path& directory,
                       const std::vector<std::string>& ids,
                       const TinyTransportOptions& options) {
    transport::CurvesSection section;
    for (const std::string& id : ids) {
        const float alpha = 0.1F * static_cast<float>(1 + section.curves.size());
        const auto brdf = curve::CurveBrdf::ggx(Imath::V3f(0.9F, 0.6F, 0.3F), 1, alpha);
        const std::size_t index = brdf.index_of(std::string_view("distribution"));
        section.curves.push_back({.id = id,
                                  .name = "Material " + id,
                                  .curve = "distribution",
                                  .angle = "half",
                                  .brdf = curve::json_from_curve_brdf(brdf),
                                  .baked = brdf.curves()[index].curve.rgb});
    }
    transport::Manifest manifest;
    manifest.generator = "relume tests";
    manifest.fingerprint = options.seed;
    manifest.kind = transport::Kind::curves;
    manifest.layout = transport::ReceiverLayout::pixel_tiles(
        {.width = options.width, .height = options.height});
    manifest.signal_basis = basis::CurveBasis(static_cast<std::uint32_t>(ids.size()));
    manifest.stating_rows = 256;
    manifest.choosing_rows = 64;
    manifest.colour.channels = 3;
    manifest.colour.matrix = {{{1, 0.5F, 0}, {1, -0.25F, 0.25F}, {1, 0, -0.5F}}};
    manifest.curves = std::move(section);
    write_random_transport(directory, manifest, options);
}

}  // namespace relume::test
