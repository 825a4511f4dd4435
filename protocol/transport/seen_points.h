// The points of edited materials that the pixels of an image see: points.bin. With what each of
// them sees of the light (visibility_field.h) they say how a pixel answers to another BRDF
// (protocol/README.md §2).
#pragma once

#include "protocol/transport/block_frames.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace relume::transport {

struct SeenPoint {
    std::uint8_t slot = 0;      // of the pixel in its block
    std::uint8_t material = 0;  // index into the manifest's materials.editable
    float share = 0;            // of the pixel, in (0, 1]; those of a pixel sum up to at most 1
    // Unit, in the world. `normal` is that of shading, on the viewer's side as the other is; wo
    // points to the viewer.
    Imath::V3f normal{0, 0, 1};
    Imath::V3f geometric_normal{0, 0, 1};
    Imath::V3f wo{0, 0, 1};
    Imath::V3f diffuse{0, 0, 0};  // colour of the diffuse part as baked, in [0, 1]

    friend bool operator==(const SeenPoint&, const SeenPoint&) = default;
};

// The point as the file holds it: directions to 7e-5, shares and colours as half floats, so
// that of the sum of a pixel's shares up to 1e-3 may be too much. A stored point stays as it
// is.
[[nodiscard]] SeenPoint stored_point(const SeenPoint& point);

// Decoded and checked when opened. Immutable and thread-safe.
class SeenPoints {
  public:
    // Of a file with so many blocks at most kMostPoints points are read.
    static constexpr std::uint64_t kMostPoints = std::uint64_t{1} << 25;

    // Does not keep the span. Throws TransportError naming `file`, what was found and what was
    // expected: points in the order of their slots, materials below `material_count`, shares,
    // their sums and colours in range.
    SeenPoints(std::span<const std::byte> bytes, std::string file, std::size_t material_count);

    [[nodiscard]] std::uint32_t block_count() const {
        return static_cast<std::uint32_t>(first_.size() - 1);
    }
    [[nodiscard]] std::size_t point_count() const { return points_.size(); }
    [[nodiscard]] std::uint32_t point_count(std::uint32_t block) const {
        return static_cast<std::uint32_t>(first_[block + 1] - first_[block]);
    }
    // In the order of visibility.bin.
    [[nodiscard]] std::span<const SeenPoint> of_block(std::uint32_t block) const {
        return std::span(points_).subspan(first_[block], first_[block + 1] - first_[block]);
    }
    [[nodiscard]] std::size_t memory_bytes() const {
        return points_.capacity() * sizeof(SeenPoint) + first_.capacity() * sizeof(first_[0]);
    }

  private:
    std::vector<SeenPoint> points_;
    std::vector<std::size_t> first_;  // [blocks + 1]
};

// Makes a points.bin, block by block as VisibilityFieldBuilder does.
class SeenPointsBuilder {
  public:
    explicit SeenPointsBuilder(std::uint32_t block_count);

    // At most 65,535 points in the order of their slots; TransportError for more. Keeps
    // stored_point of each.
    void set_block(std::uint32_t block, std::span<const SeenPoint> points);

    [[nodiscard]] std::uint64_t point_count() const { return frames_.record_count(); }
    [[nodiscard]] std::vector<std::byte> bytes() const { return frames_.bytes(); }
    [[nodiscard]] FileRecord write(const std::filesystem::path& directory) const {
        return frames_.write(directory, "points.bin");
    }

  private:
    BlockFramesBuilder frames_;
};

}  // namespace relume::transport
