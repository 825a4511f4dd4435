// What a manifest says of the visibility of its points, and of the materials that people edit
// under any light.
#pragma once

#include "protocol/transport/file_record.h"
#include "protocol/transport/manifest_reader.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace relume::transport {

// visibility.bin, and the n of its cubemap.
struct VisibilityRecord {
    std::uint32_t face_resolution = 0;
    FileRecord file;
};

// The dielectric over a diffuse layer: with T(c) = 1 − f0 − (f90 − f0)(1 − c)⁵ the diffuse part
// of a BRDF is diffuse/π · T(cos θi)·T(cos θo) / (1 − f0 − (f90 − f0)/21) [Shirley97],
// and nothing where the denominator is at most 1e-4.
struct CoatRecord {
    float f0 = 0;  // 0 ≤ f0 ≤ f90 ≤ 1
    float f90 = 1;

    friend bool operator==(const CoatRecord&, const CoatRecord&) = default;
};

// A material that people edit.
struct EditableRecord {
    std::string id;    // by which rooms call it; a name, used once
    std::string name;  // in the scene's file
    // Its specular part as baked, as protocol/curve has it; null where it is all diffuse.
    nlohmann::json brdf = nullptr;
    std::optional<CoatRecord> coat;  // none: the diffuse part is diffuse/π

    friend bool operator==(const EditableRecord&, const EditableRecord&) = default;
};

struct MaterialsSection {
    static constexpr std::size_t kMostMaterials = 16;

    VisibilityRecord visibility;
    FileRecord points;
    std::vector<EditableRecord> editable;  // 1 … kMostMaterials
};

// The sections `visibility` and `materials` of a manifest. Reading throws TransportError naming
// the key, what was found and what was expected.
[[nodiscard]] nlohmann::json json_from(const VisibilityRecord& visibility);
[[nodiscard]] VisibilityRecord visibility_record(const ManifestReader& object);
[[nodiscard]] nlohmann::json json_from(const MaterialsSection& materials);
[[nodiscard]] MaterialsSection materials_section(const ManifestReader& object);

}  // namespace relume::transport
