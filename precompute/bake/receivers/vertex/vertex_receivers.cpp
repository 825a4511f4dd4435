#include "precompute/bake/receivers/vertex/vertex_receivers.h"

#include "precompute/bake/receivers/vertex/vertex_places.h"
#include "protocol/brdf/local_frame.h"
#include "protocol/transport/hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace relume::bake {
namespace {

// Vertices close to each other are close in number, and so have close runs of the sequences;
// their rays go by Roberts' R2 sequence.
SequencePlace sequence_place(std::uint32_t run) {
    return {.run = run, .along = 0.7548776662466927 * run, .across = 0.5698402909980532 * run};
}

// The scene's vertex colours at a place; white where its mesh has none.
Imath::V3f colour_at(const scene::Scene& scene, const SurfacePlace& place) {
    const scene::Mesh& mesh = scene.meshes[place.mesh];
    if (mesh.colours.empty()) {
        return {1, 1, 1};
    }
    const scene::Triangle& corners = mesh.triangles[place.triangle];
    const Imath::V2f& at = place.barycentric;
    return mesh.colours[corners[0]] * (1 - at.x - at.y) + mesh.colours[corners[1]] * at.x +
           mesh.colours[corners[2]] * at.y;
}

float mean_edge(const RefinedSurface& surface, std::size_t vertex) {
    const std::span<const VertexNeighbour> neighbours = surface.neighbours_of(vertex);
    float sum = 0;
    for (const VertexNeighbour& neighbour : neighbours) {
        sum += neighbour.distance;
    }
    return neighbours.empty() ? 0 : sum / static_cast<float>(neighbours.size());
}

}  // namespace

VertexReceivers::VertexReceivers(const scene::Scene& scene,
                                 const RefinedSurface& surface,
                                 std::vector<const brdf::FactoredBrdf*> brdfs)
    : scene_(scene), surface_(surface), brdfs_(std::move(brdfs)) {}

std::size_t VertexReceivers::receiver_count() const {
    return surface_.vertex_count();
}

std::uint32_t VertexReceivers::cluster_count() const {
    return static_cast<std::uint32_t>(surface_.clusters.size());
}

std::uint32_t VertexReceivers::terms(std::uint32_t cluster) const {
    return brdfs_[surface_.clusters[cluster].material]->terms;
}

std::optional<std::size_t> VertexReceivers::receiver_at(std::uint32_t cluster,
                                                        std::uint32_t slot) const {
    const VertexCluster& of = surface_.clusters[cluster];
    return slot < of.count ? std::optional<std::size_t>(of.first + slot) : std::nullopt;
}

Receiver VertexReceivers::look(std::size_t receiver) const {
    return this->receiver(receiver, static_cast<std::uint32_t>(receiver));
}

std::vector<Receiver> VertexReceivers::points(std::size_t receiver, std::uint64_t seed) const {
    constexpr std::uint64_t kRuns = 65536;
    const std::uint64_t run = transport::mix_bits(seed + receiver) % kRuns;
    return {this->receiver(receiver, static_cast<std::uint32_t>(run))};
}

Receiver VertexReceivers::receiver(std::size_t vertex, std::uint32_t run) const {
    const std::array<SurfacePlace, kPacketSize> places = places_of_vertex(surface_, vertex);
    ReceiverSurface surface;
    surface.point = surface_point_at(scene_, places.front());
    surface.point.position = surface_.mesh.positions[vertex];
    const brdf::Frame frame = brdf::local_frame(surface_.mesh.normals[vertex]);
    surface.point.geometric_normal = frame.normal;
    surface.point.shading = {
        .tangent = frame.tangent, .bitangent = frame.bitangent, .normal = frame.normal};
    surface.point.wo = {0, 0, 1};
    surface.point.bsdf = scene::Bsdf::lambert({1, 1, 1});
    surface.share = 1;
    surface.footprint = mean_edge(surface_, vertex);
    surface.material = surface_.clusters[cluster_of(vertex)].material;
    for (std::size_t i = 0; i < places.size(); ++i) {
        surface.origins[i] = offset_origin(surface_point_at(scene_, places[i]));
    }
    surface.brdf = brdfs_[surface.material];
    surface.colour = colour_at(scene_, places.front());
    return {.index = vertex, .place = sequence_place(run), .surfaces = {std::move(surface)}};
}

std::size_t VertexReceivers::cluster_of(std::size_t vertex) const {
    const auto after = std::upper_bound(
        surface_.clusters.begin(), surface_.clusters.end(), vertex,
        [](std::size_t value, const VertexCluster& cluster) { return value < cluster.first; });
    return static_cast<std::size_t>(after - surface_.clusters.begin()) - 1;
}

std::size_t VertexReceivers::first_of_group(std::size_t group) const {
    const std::size_t cluster = group * kClustersPerGroup;
    return cluster < surface_.clusters.size() ? surface_.clusters[cluster].first
                                              : surface_.vertex_count();
}

void VertexReceivers::find_neighbours(std::size_t receiver,
                                      std::uint32_t radius,
                                      std::vector<Neighbour>& neighbours) const {
    const std::size_t group = cluster_of(receiver) / kClustersPerGroup;
    const std::size_t first = first_of_group(group);
    const std::size_t last = first_of_group(group + 1);
    const float step = mean_edge(surface_, receiver);
    const Imath::V3f centre = surface_.mesh.positions[receiver];
    neighbours.assign({{.receiver = receiver, .squared_distance = 0}});
    std::size_t ring = 0;  // where the last ring begins
    for (std::uint32_t edges = 0; edges < radius; ++edges) {
        const std::size_t end = neighbours.size();
        for (std::size_t i = ring; i < end; ++i) {
            for (const VertexNeighbour& next : surface_.neighbours_of(neighbours[i].receiver)) {
                const bool is_new = std::none_of(
                    neighbours.begin(), neighbours.end(),
                    [&](const Neighbour& known) { return known.receiver == next.vertex; });
                if (!is_new || next.vertex < first || next.vertex >= last) {
                    continue;
                }
                const float distance =
                    (surface_.mesh.positions[next.vertex] - centre).length() / step;
                neighbours.push_back(
                    {.receiver = next.vertex, .squared_distance = distance * distance});
            }
        }
        ring = end;
    }
}

std::vector<ReceiverRun> VertexReceivers::reach(std::uint32_t first_cluster,
                                                std::uint32_t cluster_count,
                                                std::uint32_t radius) const {
    const std::size_t last_cluster = first_cluster + cluster_count - 1;
    if (radius == 0) {
        const VertexCluster& last = surface_.clusters[last_cluster];
        return {{.first = surface_.clusters[first_cluster].first,
                 .last = std::size_t{last.first} + last.count}};
    }
    return {{.first = first_of_group(first_cluster / kClustersPerGroup),
             .last = first_of_group(last_cluster / kClustersPerGroup + 1)}};
}

std::size_t VertexReceivers::first_in_reach(std::uint32_t first_cluster,
                                            std::uint32_t /*radius*/) const {
    return first_of_group(first_cluster / kClustersPerGroup);
}

ReachBound VertexReceivers::most_in_reach(std::uint32_t /*radius*/) const {
    constexpr std::uint64_t kMost = std::uint64_t{kClustersPerGroup} * transport::kBlockSize;
    const std::uint64_t most = std::min<std::uint64_t>(kMost, surface_.vertex_count());
    return {.receivers = most,
            .shown = fmt::format("{} vertices", most),
            .remedy = "fewer vertices"};
}

std::size_t VertexReceivers::middle_of_cluster(std::uint32_t cluster) const {
    return surface_.clusters[cluster].first + surface_.clusters[cluster].count / 2;
}

std::vector<std::size_t> VertexReceivers::spread_over_all(std::size_t count) const {
    const std::size_t all = surface_.vertex_count();
    const std::size_t spread = std::min(count, all);
    std::vector<std::size_t> receivers;
    for (std::size_t i = 0; i < spread; ++i) {
        receivers.push_back(i * all / spread);
    }
    return receivers;
}

ClusterPatch VertexReceivers::patch() const {
    return {.slots = {0, 1, 2, 3}, .neighbours = {{0, 1}, {2, 3}, {1, 2}}};
}

}  // namespace relume::bake
