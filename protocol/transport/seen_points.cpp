#include "protocol/transport/seen_points.h"

#include "protocol/transport/error.h"
#include "protocol/transport/format.h"
#include "protocol/transport/octahedral.h"

#include <Imath/half.h>
#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <type_traits>

namespace relume::transport {
namespace {

// Numbers lie in the file as they lie in memory.
static_assert(std::endian::native == std::endian::little);

constexpr std::array<char, 8> kMagic{'R', 'E', 'L', 'U', 'M', 'E', 'S', 'P'};

using HalfColour = std::array<Imath::half, 3>;

// A point as the file holds it. In the file each member has a plane of its own.
struct PackedPoint {
    std::uint8_t slot = 0;
    std::uint8_t material = 0;
    Imath::half share;
    OctahedralDirection normal{};
    OctahedralDirection geometric_normal{};
    OctahedralDirection wo{};
    HalfColour diffuse{};
};
constexpr std::uint32_t kRecordBytes = 22;

PackedPoint packed(const SeenPoint& point) {
    return {.slot = point.slot,
            .material = point.material,
            .share = Imath::half(point.share),
            .normal = octahedral_from_direction(point.normal),
            .geometric_normal = octahedral_from_direction(point.geometric_normal),
            .wo = octahedral_from_direction(point.wo),
            .diffuse = {Imath::half(point.diffuse.x), Imath::half(point.diffuse.y),
                        Imath::half(point.diffuse.z)}};
}

SeenPoint unpacked(const PackedPoint& point) {
    return {.slot = point.slot,
            .material = point.material,
            .share = point.share,
            .normal = direction_from_octahedral(point.normal),
            .geometric_normal = direction_from_octahedral(point.geometric_normal),
            .wo = direction_from_octahedral(point.wo),
            .diffuse = {point.diffuse[0], point.diffuse[1], point.diffuse[2]}};
}

// Calls visit(member of every point) for each plane of a block in turn.
template <typename Visit>
void for_each_plane(Visit visit) {
    visit(&PackedPoint::slot);
    visit(&PackedPoint::material);
    visit(&PackedPoint::share);
    visit(&PackedPoint::normal);
    visit(&PackedPoint::geometric_normal);
    visit(&PackedPoint::wo);
    visit(&PackedPoint::diffuse);
}

std::vector<std::byte> bytes_from_points(std::span<const PackedPoint> points) {
    std::vector<std::byte> bytes(points.size() * kRecordBytes);
    std::byte* at = bytes.data();
    for_each_plane([&](auto member) {
        for (const PackedPoint& point : points) {
            std::memcpy(at, &(point.*member), sizeof(point.*member));
            at += sizeof(point.*member);
        }
    });
    return bytes;
}

void points_from_bytes(std::span<const std::byte> bytes, std::vector<PackedPoint>& points) {
    points.resize(bytes.size() / kRecordBytes);
    const std::byte* at = bytes.data();
    for_each_plane([&](auto member) {
        for (PackedPoint& point : points) {
            std::memcpy(static_cast<void*>(&(point.*member)), at, sizeof(point.*member));
            at += sizeof(point.*member);
        }
    });
}

// Holds the points of a block to what they may say.
class PointCheck {
  public:
    PointCheck(const std::string& file, std::uint32_t block, std::size_t material_count)
        : file_(file), block_(block), material_count_(material_count) {}

    void take(const SeenPoint& point) {
        if (point.slot < slot_) {
            fail("slot", fmt::format("{}", point.slot),
                 fmt::format("at least {}, that of the point before", slot_));
        }
        if (point.material >= material_count_) {
            fail("material", fmt::format("{}", point.material),
                 fmt::format("one of {}", material_count_));
        }
        if (!(point.share > 0 && point.share <= 1)) {
            fail("share", fmt::format("{}", point.share), "a number above 0 and at most 1");
        }
        shares_ = point.slot == slot_ ? shares_ + point.share : point.share;
        slot_ = point.slot;
        // What rounding to half floats may add.
        constexpr float kMostShares = 1.001F;
        if (!(shares_ <= kMostShares)) {
            fail("share", fmt::format("{} in one pixel", shares_), "at most 1");
        }
        for (int c = 0; c < 3; ++c) {
            if (!(point.diffuse[c] >= 0 && point.diffuse[c] <= 1)) {
                fail("diffuse", fmt::format("{}", point.diffuse[c]), "numbers from 0 to 1");
            }
        }
        ++index_;
    }

  private:
    [[noreturn]] void fail(const char* what,
                           const std::string& found,
                           const std::string& expected) const {
        throw TransportError(fmt::format("{}: block {}: point {}: {}: found {}, expected {}",
                                         file_, block_, index_, what, found, expected));
    }

    const std::string& file_;
    std::uint32_t block_;
    std::size_t material_count_;
    std::size_t index_ = 0;
    std::uint8_t slot_ = 0;
    float shares_ = 0;
};

}  // namespace

SeenPoint stored_point(const SeenPoint& point) {
    return unpacked(packed(point));
}

SeenPoints::SeenPoints(std::span<const std::byte> bytes,
                       std::string file,
                       std::size_t material_count) {
    const BlockFrames frames(bytes, std::move(file), kMagic);
    const auto require = [&](const char* what, std::uint64_t found, std::uint64_t expected) {
        if (found != expected) {
            throw TransportError(fmt::format("{}: {}: found {}, expected {}", frames.file(),
                                             what, found, expected));
        }
    };
    require("reserved part", frames.form().parameter, 0);
    require("bytes of a point", frames.form().record_bytes, kRecordBytes);
    const std::uint32_t blocks = frames.block_count();
    if (frames.first_record(blocks) > kMostPoints) {
        throw TransportError(fmt::format("{}: count of points: found {}, expected at most {}",
                                         frames.file(), frames.first_record(blocks),
                                         kMostPoints));
    }
    first_.reserve(std::size_t{blocks} + 1);
    first_.push_back(0);
    std::vector<std::byte> of_block;
    std::vector<PackedPoint> points;
    for (std::uint32_t block = 0; block < blocks; ++block) {
        of_block.resize(frames.bytes_of_block(block));
        frames.read(block, of_block);
        points_from_bytes(of_block, points);
        PointCheck check(frames.file(), block, material_count);
        for (const PackedPoint& point : points) {
            points_.push_back(unpacked(point));
            check.take(points_.back());
        }
        first_.push_back(points_.size());
    }
    points_.shrink_to_fit();
}

SeenPointsBuilder::SeenPointsBuilder(std::uint32_t block_count)
    : frames_({.magic = kMagic, .parameter = 0, .record_bytes = kRecordBytes}, block_count) {}

void SeenPointsBuilder::set_block(std::uint32_t block, std::span<const SeenPoint> points) {
    std::vector<PackedPoint> stored;
    stored.reserve(points.size());
    for (const SeenPoint& point : points) {
        stored.push_back(packed(point));
    }
    frames_.set_block(block, bytes_from_points(stored));
}

}  // namespace relume::transport
