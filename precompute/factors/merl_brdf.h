// A measured isotropic BRDF in the .binary layout of the MERL database [Matusik03]: three i32,
// 90, 90 and 180, then three planes of doubles, red, green and blue, each [θh][θd][φd], to be
// multiplied by 1/1500, 1.15/1500 and 1.66/1500. θh and φh are the angles of the half vector,
// θd and φd those of ωi in the frame of the half vector. A cell of θh begins at 90°·(i/90)²,
// one of θd at i degrees, and one of φd at i degrees, 0 … 180: exchanging ωi and ωo adds 180°,
// and the BRDF is reciprocal.
//
// A value belongs to the middle of its cell, between which values are linear. A negative one
// says that nothing was measured there, and counts as 0. The cells of φd and 180° − φd, mirror
// images in the plane of half vector and normal, are averaged: what tells them apart in an
// isotropic material is the noise of the measurement.
#pragma once

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace relume::factors {

class MerlBrdf {
  public:
    static constexpr std::size_t kThetaHalf = 90;
    static constexpr std::size_t kThetaDifference = 90;
    static constexpr std::size_t kPhiDifference = 180;
    static constexpr std::size_t kCells = kThetaHalf * kThetaDifference * kPhiDifference;
    static constexpr std::size_t kFileBytes = 3 * 4 + 3 * 8 * kCells;

    // Throws FactorError, which begins with `file`, for other counts, another length, a value
    // that is not finite in single precision.
    MerlBrdf(std::string_view file, std::span<const std::byte> bytes);
    // Throws FactorError, also for what cannot be read; reads no more than a file may have.
    [[nodiscard]] static MerlBrdf read(const std::filesystem::path& path);

    // In 1/sr, rgb; both directions above the horizon. Thread-safe.
    [[nodiscard]] Imath::V3f evaluate(const Imath::V3f& wi, const Imath::V3f& wo) const;
    // Where the highlight straight on has fallen to half, as an angle between directions.
    [[nodiscard]] double width_rad() const;
    // Values of the file that were negative.
    [[nodiscard]] std::size_t unmeasured_count() const { return unmeasured_count_; }

  private:
    [[nodiscard]] const Imath::V3f& cell(std::size_t half,
                                         std::size_t difference,
                                         std::size_t phi) const {
        return (*cells_)[(half * kThetaDifference + difference) * kPhiDifference + phi];
    }

    std::shared_ptr<const std::vector<Imath::V3f>> cells_;
    std::size_t unmeasured_count_ = 0;
};

}  // namespace relume::factors
