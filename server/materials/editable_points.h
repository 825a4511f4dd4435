// What of a scene people may edit beside its light: materials, and the points of them that the
// pixels of its image see.
#pragma once

#include "protocol/brdf/diffuse_lobe.h"
#include "protocol/curve/curve_brdf.h"
#include "protocol/transport/curves_section.h"
#include "protocol/transport/transport.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace relume::materials {

struct EditableMaterial {
    std::string id;
    curve::CurveBrdf brdf;  // the specular part as baked
    std::optional<brdf::Coat> coat;
    std::vector<std::uint32_t> tiles;  // that have points of it, ascending
};

// One of a material's curves, which people edit under an ID of its own.
struct EditableCurve {
    std::size_t material = 0;
    std::size_t curve = 0;  // of the material's BRDF
};

// Immutable and thread-safe.
class EditablePoints {
  public:
    // Of a transport that has points. Throws curve::CurveError for a BRDF that is none.
    explicit EditablePoints(std::shared_ptr<const transport::Transport> transport);

    [[nodiscard]] const transport::TileGrid& image() const {
        return transport_->manifest().image();
    }
    [[nodiscard]] std::span<const EditableMaterial> materials() const { return materials_; }
    // As rooms call them: MATERIAL.CURVE.
    [[nodiscard]] std::span<const transport::CurveRecord> records() const { return records_; }
    // What each of the records is.
    [[nodiscard]] std::span<const EditableCurve> curves() const { return curves_; }

    // Of a tile, with what each of them sees.
    [[nodiscard]] std::span<const transport::SeenPoint> points(std::uint32_t tile) const {
        return transport_->seen_points()->of_block(tile);
    }
    [[nodiscard]] const transport::VisibilityField& visibility() const {
        return *transport_->visibility();
    }

    // Of memory, bits as they are in the file.
    [[nodiscard]] std::uint64_t bytes() const;

  private:
    std::shared_ptr<const transport::Transport> transport_;
    std::vector<EditableMaterial> materials_;
    std::vector<transport::CurveRecord> records_;
    std::vector<EditableCurve> curves_;
};

}  // namespace relume::materials
