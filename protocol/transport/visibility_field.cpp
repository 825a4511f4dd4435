#include "protocol/transport/visibility_field.h"

#include "protocol/basis/cubemap.h"
#include "protocol/transport/error.h"

#include <fmt/format.h>

#include <bit>

namespace relume::transport {
namespace {

// Words lie in the file as they lie in memory.
static_assert(std::endian::native == std::endian::little);

constexpr std::array<char, 8> kMagic{'R', 'E', 'L', 'U', 'M', 'E', 'V', 'F'};

std::uint32_t record_bytes(std::uint32_t face_resolution) {
    return static_cast<std::uint32_t>(words_of_visibility(face_resolution) *
                                      sizeof(std::uint64_t));
}

// Of the last word of a point: those that are no texel's.
std::uint64_t unused_bits(std::uint32_t face_resolution) {
    const std::uint32_t used = 6 * face_resolution * face_resolution % 64;
    return used == 0 ? 0 : ~((std::uint64_t{1} << used) - 1);
}

}  // namespace

VisibilityField::VisibilityField(std::span<const std::byte> bytes, std::string file)
    : frames_(bytes, std::move(file), kMagic) {
    const auto& [magic, n, bytes_of_point] = frames_.form();
    if (!basis::is_face_resolution(n)) {
        throw TransportError(fmt::format(
            "{}: face resolution: found {}, expected a power of two from {} to {}",
            frames_.file(), n, basis::kMinFaceResolution, basis::kMaxFaceResolution));
    }
    if (bytes_of_point != record_bytes(n)) {
        throw TransportError(fmt::format("{}: bytes of a point: found {}, expected {}",
                                         frames_.file(), bytes_of_point, record_bytes(n)));
    }
}

void VisibilityField::read(std::uint32_t block, std::vector<std::uint64_t>& bits) const {
    const std::size_t words = words_per_point();
    bits.resize(point_count(block) * words);
    frames_.read(block, std::as_writable_bytes(std::span(bits)));
    const std::uint64_t unused = unused_bits(face_resolution());
    for (std::size_t last = words - 1; unused != 0 && last < bits.size(); last += words) {
        if ((bits[last] & unused) != 0) {
            throw TransportError(
                fmt::format("{}: block {}: point {}: found a bit beyond the last texel, "
                            "expected zeroes",
                            frames_.file(), block, last / words));
        }
    }
}

VisibilityFieldBuilder::VisibilityFieldBuilder(std::uint32_t face_resolution,
                                               std::uint32_t block_count)
    : frames_({.magic = kMagic,
               .parameter = face_resolution,
               .record_bytes = record_bytes(face_resolution)},
              block_count) {}

void VisibilityFieldBuilder::set_block(std::uint32_t block,
                                       std::span<const std::uint64_t> bits) {
    frames_.set_block(block, std::as_bytes(bits));
}

}  // namespace relume::transport
