#include "protocol/transport/mesh_section.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace relume::transport {
namespace {

using nlohmann::json;

constexpr std::size_t kMostLobes = 4;
constexpr std::size_t kMostTextures = 4096;

json array_from(const Imath::V3f& v) {
    return {v.x, v.y, v.z};
}

FrameRecord frame_record(const ManifestReader& object) {
    const json& origin = object.member("origin");
    const auto is_finite = [](const json& value) {
        return value.is_number() && std::isfinite(value.get<double>());
    };
    if (!origin.is_array() || origin.size() != 3 ||
        !std::all_of(origin.begin(), origin.end(), is_finite)) {
        object.fail("origin", text::quote(origin), "three finite numbers");
    }
    const json& unit = object.member("unit");
    if (!is_finite(unit) || !(unit.get<double>() > 0)) {
        object.fail("unit", text::quote(unit), "a positive number");
    }
    return {
        .origin = {origin[0].get<double>(), origin[1].get<double>(), origin[2].get<double>()},
        .unit = unit.get<double>()};
}

// The objects of an array of 1 … `most`, each with its place.
template <typename Take>
void for_each_object(const ManifestReader& of, const char* key, std::size_t most, Take take) {
    const json& list = of.member(key);
    if (!list.is_array() || list.empty() || list.size() > most) {
        of.fail(key,
                list.is_array() ? fmt::format("{} entries", list.size()) : list.type_name(),
                fmt::format("an array of 1 to {}", most));
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
        take(ManifestReader(list[i], fmt::format("{}.{}[{}]", of.place(), key, i)));
    }
}

LobeRecord lobe_record(const ManifestReader& object) {
    LobeRecord lobe{.colour = object.vector("colour"), .texture = {}};
    for (int c = 0; c < 3; ++c) {
        if (lobe.colour[c] < 0) {
            object.fail("colour", fmt::format("{}", lobe.colour[c]),
                        "numbers that are not negative");
        }
    }
    if (object.has("texture")) {
        lobe.texture = object.integer32("texture", 0, kMostTextures - 1);
    }
    return lobe;
}

CutoutRecord cutout_record(const ManifestReader& object) {
    const json& cutoff = object.member("cutoff");
    if (!is_single(cutoff)) {
        object.fail("cutoff", text::quote(cutoff), "a finite number");
    }
    return {.texture = object.integer32("texture", 0, kMostTextures - 1),
            .cutoff = cutoff.get<float>()};
}

}  // namespace

json json_from(const MeshSection& mesh, const VertexClusters& clusters) {
    json materials = json::array();
    for (const MaterialRecord& material : mesh.materials) {
        json lobes = json::array();
        for (const LobeRecord& lobe : material.lobes) {
            json object{{"colour", array_from(lobe.colour)}};
            if (lobe.texture) {
                object["texture"] = *lobe.texture;
            }
            lobes.push_back(std::move(object));
        }
        json& object = materials.emplace_back(json{
            {"name", material.name}, {"brdf", material.brdf}, {"lobes", std::move(lobes)}});
        if (material.cutout) {
            object["cutout"] = {{"texture", material.cutout->texture},
                                {"cutoff", material.cutout->cutoff}};
        }
    }
    json list = json::array();
    for (const Cluster& cluster : clusters.clusters()) {
        list.push_back({cluster.vertices, cluster.terms, cluster.material});
    }
    const Imath::V3d& origin = mesh.frame.origin;
    return {{"frame", {{"origin", {origin.x, origin.y, origin.z}}, {"unit", mesh.frame.unit}}},
            {"view", {{"width", mesh.view.width}, {"height", mesh.view.height}}},
            {"materials", std::move(materials)},
            {"clusters", std::move(list)}};
}

MeshSection mesh_section(const ManifestReader& object) {
    MeshSection mesh;
    mesh.frame = frame_record(object.object("frame"));
    const ManifestReader view = object.object("view");
    mesh.view = {.width = view.integer32("width", 1, kMaxImageSide),
                 .height = view.integer32("height", 1, kMaxImageSide)};
    for_each_object(
        object, "materials", MeshSection::kMostMaterials, [&](const ManifestReader& entry) {
            MaterialRecord material{
                .name = entry.string("name"),
                .brdf = entry.integer32("brdf", 0, MeshSection::kMostMaterials - 1),
                .lobes = {}};
            for_each_object(entry, "lobes", kMostLobes, [&](const ManifestReader& lobe) {
                material.lobes.push_back(lobe_record(lobe));
            });
            if (entry.has("cutout")) {
                material.cutout = cutout_record(entry.object("cutout"));
            }
            mesh.materials.push_back(std::move(material));
        });
    return mesh;
}

VertexClusters vertex_clusters(const ManifestReader& object, std::size_t material_count) {
    const json& list = object.member("clusters");
    if (!list.is_array() || list.empty()) {
        object.fail("clusters", list.is_array() ? "none" : list.type_name(),
                    "an array of [vertices, terms, material]");
    }
    std::vector<Cluster> clusters;
    for (const json& entry : list) {
        const auto is_count = [](const json& value) {
            return value.is_number_unsigned() && value.get<std::uint64_t>() <= kBlockSize * 16;
        };
        if (!entry.is_array() || entry.size() != 3 ||
            !std::all_of(entry.begin(), entry.end(), is_count)) {
            object.fail("clusters", text::quote(entry), "[vertices, terms, material]");
        }
        clusters.push_back({.vertices = entry[0].get<std::uint32_t>(),
                            .terms = entry[1].get<std::uint32_t>(),
                            .material = entry[2].get<std::uint32_t>()});
        if (clusters.back().material >= material_count) {
            object.fail("clusters", text::quote(entry),
                        fmt::format("a material below {}", material_count));
        }
    }
    return VertexClusters(std::move(clusters));
}

}  // namespace relume::transport
