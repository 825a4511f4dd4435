// Finished parts of a bake's visibility: partial/*.fields, from which an interrupted bake goes
// on. They are gone when the bake is whole.
#pragma once

#include "protocol/transport/seen_points.h"
#include "protocol/transport/visibility_field.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace relume::bake {

// Blocks that are baked and kept together.
struct FieldPart {
    std::uint32_t first_block = 0;
    std::uint32_t block_count = 0;
};

struct FieldCounts {
    std::uint64_t points = 0;
    std::uint64_t open = 0;  // bits that are 1
    std::uint64_t rays = 0;

    friend bool operator==(const FieldCounts&, const FieldCounts&) = default;
};

struct FinishedPart {
    FieldCounts counts;
    std::vector<std::byte> visibility;  // a file of the part's blocks alone
    std::vector<std::byte> points;      // the same; of kind `mesh` none of its blocks has any
};

class FieldPartsFolder {
  public:
    // In `transport_directory`, of the bake with this fingerprint. Throws BakeError where the
    // folder cannot be made.
    FieldPartsFolder(const std::filesystem::path& transport_directory,
                     std::uint64_t fingerprint);

    // Throws files::FileError.
    void write(const FieldPart& part, const FinishedPart& finished) const;
    // None where there is none, or another bake's, or a broken one.
    [[nodiscard]] std::optional<FinishedPart> read(const FieldPart& part) const;

  private:
    [[nodiscard]] std::filesystem::path path(const FieldPart& part) const;

    std::filesystem::path folder_;
    std::uint64_t fingerprint_;
};

}  // namespace relume::bake
