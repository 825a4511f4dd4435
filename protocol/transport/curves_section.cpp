#include "protocol/transport/curves_section.h"

#include "protocol/base/text/names.h"
#include "protocol/curve/curve_json.h"

#include <fmt/format.h>

#include <set>

namespace relume::transport {
namespace {

using nlohmann::json;

CurveRecord::Samples samples(const ManifestReader& record) {
    const json& planes = record.member("samples");
    CurveRecord::Samples samples{};
    if (!planes.is_array() || planes.size() != samples.size()) {
        record.fail(
            "samples",
            planes.is_array() ? fmt::format("{} planes", planes.size()) : planes.type_name(),
            "three planes, red, green and blue");
    }
    for (std::size_t channel = 0; channel < samples.size(); ++channel) {
        const json& plane = planes[channel];
        if (!plane.is_array() || plane.size() != CurveRecord::kSamples) {
            record.fail(
                "samples",
                plane.is_array() ? fmt::format("{} samples", plane.size()) : plane.type_name(),
                fmt::format("{} numbers", CurveRecord::kSamples));
        }
        for (std::size_t k = 0; k < CurveRecord::kSamples; ++k) {
            if (!is_single(plane[k]) || plane[k].get<double>() < 0) {
                record.fail("samples", plane[k].dump(), "numbers that are not negative");
            }
            samples[channel][k] = plane[k].get<float>();
        }
    }
    return samples;
}

CurveRecord curve_record(const ManifestReader& record) {
    CurveRecord curve{.id = record.string("id"),
                      .name = record.string("name"),
                      .curve = record.string("curve"),
                      .angle = record.string("angle"),
                      .brdf = record.notes("brdf"),
                      .baked = samples(record)};
    try {
        const curve::CurveBrdf brdf =
            curve::curve_brdf_from_json(curve.brdf, record.place() + ".brdf");
        const std::size_t index = brdf.index_of(std::string_view(curve.curve));
        record.expect_text("angle", curve::kCurveAngleNames.name(brdf.curves()[index].angle));
    } catch (const curve::CurveError& error) {
        throw TransportError(error.what());
    }
    if (!text::is_name(curve.id)) {
        record.fail("id", text::quote(curve.id), std::string(text::kNameRule));
    }
    return curve;
}

}  // namespace

json json_from(const std::vector<CurveRecord>& curves) {
    json list = json::array();
    for (const CurveRecord& curve : curves) {
        list.push_back({{"id", curve.id},
                        {"name", curve.name},
                        {"curve", curve.curve},
                        {"angle", curve.angle},
                        {"brdf", curve.brdf},
                        {"samples", curve.baked}});
    }
    return list;
}

CurvesSection curves_section(const ManifestReader& top) {
    const json& list = top.member("curves");
    if (!list.is_array() || list.empty() || list.size() > CurvesSection::kMostCurves) {
        top.fail("curves", list.is_array() ? std::to_string(list.size()) : list.type_name(),
                 fmt::format("an array of 1 to {}", CurvesSection::kMostCurves));
    }
    CurvesSection section{.curves = {}, .light = top.notes("light")};
    std::set<std::string> ids;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const ManifestReader record(list[i], fmt::format("{}.curves[{}]", top.place(), i));
        section.curves.push_back(curve_record(record));
        if (!ids.insert(section.curves.back().id).second) {
            record.fail("id", text::quote(section.curves.back().id), "each id once");
        }
    }
    return section;
}

}  // namespace relume::transport
