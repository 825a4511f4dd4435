// The node hierarchy of a document's scene: where everything stands in the world.
#pragma once

#include "precompute/scene/gltf/affine.h"
#include "precompute/scene/gltf/document.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace relume::scene::gltf {

class Nodes {
  public:
    // The default scene, else the first; a document without scenes shows all nodes. Throws
    // SceneError: corrupt_file where nodes form no trees, too_large above `max_nodes`.
    Nodes(const Document& document, std::uint32_t max_nodes);

    // Nodes of the scene, parents before their children, in the file's order.
    [[nodiscard]] const std::vector<std::size_t>& shown() const { return shown_; }
    // Which of the document's scenes it is; nothing where the document has none.
    [[nodiscard]] std::optional<std::size_t> scene() const { return scene_; }
    // From the node's coordinates to the world's; of any node, also one that is not shown.
    [[nodiscard]] const Affine& world(std::size_t node) const { return world_[node]; }
    // Names from the root to the node, by '/', escaped.
    [[nodiscard]] std::string path(std::size_t node) const;

  private:
    void find_parents();
    void find_shown();
    void place_all();

    const Document& document_;
    std::optional<std::size_t> scene_{};
    std::vector<std::optional<std::size_t>> parent_;
    std::vector<std::size_t> shown_{};
    std::vector<Affine> world_;
};

}  // namespace relume::scene::gltf
