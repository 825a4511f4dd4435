#include "precompute/scene/gltf/nodes.h"

#include "precompute/scene/gltf/json_text.h"
#include "precompute/scene/shown_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace relume::scene::gltf {
namespace {

Affine local_map(const tinygltf::Node& node, std::size_t index, const FileName& file) {
    const auto check = [&](const std::vector<double>& numbers, std::size_t count,
                           const char* member) {
        if (!numbers.empty() && numbers.size() != count)
            file.refuse(SceneFault::corrupt_file,
                        fmt::format("node {}: {} has {} numbers; expected {}", index, member,
                                    numbers.size(), count));
        return !numbers.empty();
    };
    if (check(node.matrix, 16, "matrix")) {
        Affine map;
        for (std::size_t i = 0; i < 16; ++i)
            map[static_cast<int>(i / 4)][i % 4] = node.matrix[i];
        return map;
    }
    Imath::V3d translation(0, 0, 0);
    Imath::V4d rotation(0, 0, 0, 1);
    Imath::V3d scale(1, 1, 1);
    if (const auto& t = node.translation; check(t, 3, "translation"))
        translation = {t[0], t[1], t[2]};
    if (const auto& r = node.rotation; check(r, 4, "rotation"))
        rotation = {r[0], r[1], r[2], r[3]};
    if (const auto& s = node.scale; check(s, 3, "scale"))
        scale = {s[0], s[1], s[2]};
    return affine_from(translation, rotation, scale);
}

}  // namespace

Nodes::Nodes(const Document& document, std::uint32_t max_nodes) : document_(document) {
    const std::size_t count = document.model.nodes.size();
    if (count > max_nodes)
        document.file.refuse(SceneFault::too_large,
                             fmt::format("{} nodes; expected at most {}", count, max_nodes));
    parent_.resize(count);
    world_.resize(count);
    find_parents();
    find_shown();
    place_all();
}

void Nodes::find_parents() {
    const auto& nodes = document_.model.nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (const int child : nodes[i].children) {
            const std::size_t c = document_.file.checked_index(
                child, nodes.size(), fmt::format("node {}", i), "node");
            if (parent_[c])
                document_.file.refuse(
                    SceneFault::corrupt_file,
                    fmt::format("node {} is a child of node {} and of node {}; expected one "
                                "parent",
                                c, *parent_[c], i));
            parent_[c] = i;
        }
    }
    // With one parent each, a way up that is longer than all nodes goes round and round.
    std::vector<bool> is_sound(nodes.size(), false);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::size_t steps = 0;
        std::vector<std::size_t> way;
        for (std::optional<std::size_t> up = i; up && !is_sound[*up]; up = parent_[*up]) {
            if (++steps > nodes.size())
                document_.file.refuse(SceneFault::corrupt_file,
                                      fmt::format("node {} is its own ancestor", i));
            way.push_back(*up);
        }
        for (const std::size_t node : way)
            is_sound[node] = true;
    }
}

void Nodes::find_shown() {
    const tinygltf::Model& model = document_.model;
    std::vector<std::size_t> open;
    if (model.scenes.empty()) {
        for (std::size_t i = 0; i < parent_.size(); ++i) {
            if (!parent_[i])
                open.push_back(i);
        }
    } else {
        scene_ = document_.file.checked_index(std::max(model.defaultScene, 0),
                                              model.scenes.size(), "the document", "scene");
        for (const int root : model.scenes[*scene_].nodes) {
            open.push_back(document_.file.checked_index(
                root, model.nodes.size(), fmt::format("scene {}", *scene_), "node"));
        }
    }
    // A scene starts at its roots, whatever else has them for children.
    for (const std::size_t root : open)
        parent_[root].reset();
    std::reverse(open.begin(), open.end());
    std::vector<bool> is_shown(parent_.size(), false);
    while (!open.empty()) {
        const std::size_t node = open.back();
        open.pop_back();
        if (is_shown[node])
            continue;
        is_shown[node] = true;
        shown_.push_back(node);
        const std::vector<int>& children = model.nodes[node].children;
        for (auto child = children.rbegin(); child != children.rend(); ++child)
            open.push_back(static_cast<std::size_t>(*child));
    }
}

void Nodes::place_all() {
    const auto& nodes = document_.model.nodes;
    std::vector<bool> is_placed(nodes.size(), false);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::vector<std::size_t> way;
        for (std::optional<std::size_t> up = i; up && !is_placed[*up]; up = parent_[*up])
            way.push_back(*up);
        for (auto node = way.rbegin(); node != way.rend(); ++node) {
            world_[*node] = local_map(nodes[*node], *node, document_.file);
            if (parent_[*node])
                world_[*node] = world_[*node] * world_[*parent_[*node]];
            is_placed[*node] = true;
        }
    }
}

std::string Nodes::path(std::size_t node) const {
    // Deeper than this a path is no help to anybody.
    constexpr std::size_t kMostNames = 32;
    std::vector<std::string> names;
    for (std::optional<std::size_t> up = node; up && names.size() < kMostNames;
         up = parent_[*up]) {
        const std::string& name = document_.model.nodes[*up].name;
        names.push_back(name.empty() ? fmt::format("node {}", *up)
                                     : shown_text(original_bytes(name)));
    }
    std::reverse(names.begin(), names.end());
    return fmt::format("{}", fmt::join(names, "/"));
}

}  // namespace relume::scene::gltf
