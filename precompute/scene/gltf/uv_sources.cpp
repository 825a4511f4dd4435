#include "precompute/scene/gltf/uv_sources.h"

#include "precompute/scene/material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace relume::scene::gltf {
namespace {

constexpr const char* kTransform = "KHR_texture_transform";

}  // namespace

Imath::V2f UvSource::uv_from_file(float u, float v) const {
    return {static_cast<float>(map[0] * u + map[1] * v + map[2]),
            static_cast<float>(1.0 - (map[3] * u + map[4] * v + map[5]))};
}

UvSource uv_source_of(int texcoord,
                      const tinygltf::ExtensionMap& extensions,
                      const FileName& file,
                      const std::string& who) {
    UvSource source{.texcoord = texcoord};
    const auto found = extensions.find(kTransform);
    if (found != extensions.end() && found->second.IsObject()) {
        const tinygltf::Value& transform = found->second;
        const auto pair = [&](const char* member, double otherwise) {
            const tinygltf::Value& list = transform.Get(std::string(member));
            if (!list.IsArray())
                return Imath::V2d(otherwise, otherwise);
            if (list.ArrayLen() != 2)
                file.refuse(SceneFault::corrupt_file,
                            fmt::format("{}: {} of {} has {} numbers; expected 2", who, member,
                                        kTransform, list.ArrayLen()));
            return Imath::V2d(list.Get(0).GetNumberAsDouble(), list.Get(1).GetNumberAsDouble());
        };
        const Imath::V2d offset = pair("offset", 0);
        const Imath::V2d scale = pair("scale", 1);
        const double angle = transform.Get(std::string("rotation")).GetNumberAsDouble();
        // Counter-clockwise as seen, v downwards: so say the extension's words, and so do all
        // programs, though the sign in its example is the other one.
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        source.map = {c * scale.x, s * scale.y, offset.x, -s * scale.x, c * scale.y, offset.y};
        if (const auto& set = transform.Get(std::string("texCoord")); set.IsNumber())
            source.texcoord = set.GetNumberAsInt();
    }
    const bool is_finite = std::all_of(source.map.begin(), source.map.end(),
                                       [](double number) { return std::isfinite(number); });
    if (source.texcoord < 0 || !is_finite)
        file.refuse(SceneFault::corrupt_file,
                    fmt::format("{}: texture coordinates {} moved by numbers that are not "
                                "finite or none; expected TEXCOORD_0 or above",
                                who, source.texcoord));
    return source;
}

std::uint32_t uv_set_of(const UvSource& source,
                        UvSources& sources,
                        const FileName& file,
                        const std::string& who) {
    const auto found = std::find(sources.begin(), sources.end(), source);
    const auto place = static_cast<std::uint32_t>(found - sources.begin());
    if (found == sources.end()) {
        if (sources.size() >= kMaxUvSets)
            file.refuse(
                SceneFault::too_large,
                fmt::format("{}: more than {} sets of texture coordinates", who, kMaxUvSets));
        sources.push_back(source);
    }
    return place;
}

}  // namespace relume::scene::gltf
