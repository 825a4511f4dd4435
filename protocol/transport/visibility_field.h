// What points of the scene see of the light: visibility.bin. A point has a bit for each texel
// of a cubemap, 1 where nothing of the scene lies between the point and that texel of the
// environment and the texel lies above the point's surface (protocol/README.md §2).
#pragma once

#include "protocol/transport/block_frames.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace relume::transport {

// 64-bit words that hold the 6·n² bits of a point: texel t of the cubemap's order
// (basis/cubemap.h) is bit t mod 64 of word t div 64, and bits beyond the last texel are 0.
[[nodiscard]] constexpr std::size_t words_of_visibility(std::uint32_t face_resolution) {
    return (std::size_t{6} * face_resolution * face_resolution + 63) / 64;
}

// Of kind `image` the points of a block are those of points.bin (seen_points.h); of kind `mesh`
// a block is a cluster and its points are the cluster's vertices, in the order of their slots.
// Thread-safe; holds the bits compressed, as they are in the file.
class VisibilityField {
  public:
    // Keeps the span, whose bytes outlive the object. Throws TransportError naming `file`.
    VisibilityField(std::span<const std::byte> bytes, std::string file);

    // Of the cubemap, n: a power of two from 4 to 256.
    [[nodiscard]] std::uint32_t face_resolution() const { return frames_.form().parameter; }
    [[nodiscard]] std::uint32_t block_count() const { return frames_.block_count(); }
    [[nodiscard]] std::uint32_t point_count(std::uint32_t block) const {
        return frames_.record_count(block);
    }
    [[nodiscard]] std::uint64_t point_count() const {
        return frames_.first_record(frames_.block_count());
    }
    [[nodiscard]] std::size_t words_per_point() const {
        return words_of_visibility(face_resolution());
    }
    // Replaces `bits` by those of the block, [point_count(block)][words_per_point()]. Throws
    // TransportError where the file's frame is broken or sets a bit beyond the last texel.
    void read(std::uint32_t block, std::vector<std::uint64_t>& bits) const;

  private:
    BlockFrames frames_;
};

[[nodiscard]] inline bool is_open(std::span<const std::uint64_t> bits_of_point,
                                  std::size_t texel) {
    return ((bits_of_point[texel / 64] >> (texel % 64)) & 1U) != 0;
}

// Makes a visibility.bin, block by block in any order; different blocks from several threads
// at a time. Holds what is compressed of it until it is written.
class VisibilityFieldBuilder {
  public:
    VisibilityFieldBuilder(std::uint32_t face_resolution, std::uint32_t block_count);

    [[nodiscard]] std::uint32_t face_resolution() const { return frames_.form().parameter; }
    // [points][words_of_visibility(face_resolution)], at most 65,535 points and 256 MiB;
    // TransportError else. A block that is never set has no points.
    void set_block(std::uint32_t block, std::span<const std::uint64_t> bits);

    [[nodiscard]] std::uint64_t point_count() const { return frames_.record_count(); }
    [[nodiscard]] std::vector<std::byte> bytes() const { return frames_.bytes(); }
    [[nodiscard]] FileRecord write(const std::filesystem::path& directory) const {
        return frames_.write(directory, "visibility.bin");
    }

  private:
    BlockFramesBuilder frames_;
};

}  // namespace relume::transport
