#include "precompute/scene/gltf/skins.h"

#include <fmt/format.h>

#include <optional>

namespace relume::scene::gltf {

std::vector<Affine> joint_maps(const Document& document,
                               std::size_t skin_index,
                               const Nodes& nodes,
                               Accessors& accessors) {
    const tinygltf::Skin& skin = document.model.skins[skin_index];
    const std::string self = label("skin", skin_index, skin.name);
    if (skin.joints.empty())
        document.file.refuse(SceneFault::corrupt_file,
                             self + " has no joints; expected at least one");
    std::optional<Elements> inverses;
    if (skin.inverseBindMatrices >= 0) {
        inverses = accessors.elements(skin.inverseBindMatrices, {16},
                                      "inverseBindMatrices of " + self);
        if (inverses->count() < skin.joints.size())
            document.file.refuse(SceneFault::corrupt_file,
                                 fmt::format("{} has {} inverse bind matrices; expected {}",
                                             self, inverses->count(), skin.joints.size()));
    }
    std::vector<Affine> maps;
    maps.reserve(skin.joints.size());
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
        const std::size_t node = document.file.checked_index(
            skin.joints[j], document.model.nodes.size(), self, "node");
        Affine inverse;
        for (std::size_t i = 0; inverses && i < 16; ++i)
            inverse[static_cast<int>(i / 4)][i % 4] = inverses->number(j, i);
        maps.push_back(inverse * nodes.world(node));
    }
    return maps;
}

std::vector<Affine> vertex_maps(const Influences& influences,
                                const std::vector<Affine>& joints,
                                const FileName& file,
                                const std::string& who) {
    const std::size_t per_vertex = influences.per_vertex;
    const std::size_t count = influences.joints.size() / per_vertex;
    std::vector<Affine> maps;
    maps.reserve(count);
    for (std::size_t v = 0; v < count; ++v) {
        Affine sum(0.0);
        double total = 0;
        for (std::size_t k = v * per_vertex; k < (v + 1) * per_vertex; ++k) {
            const double weight = influences.weights[k];
            if (weight == 0)
                continue;
            sum +=
                joints[file.checked_index(influences.joints[k], joints.size(), who, "joint")] *
                weight;
            total += weight;
        }
        // Weights that were rounded to bytes need not have the sum of one.
        maps.push_back(total > 0 ? sum * (1.0 / total)
                                 : joints[file.checked_index(influences.joints[v * per_vertex],
                                                             joints.size(), who, "joint")]);
    }
    return maps;
}

}  // namespace relume::scene::gltf
