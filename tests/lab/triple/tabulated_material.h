// A material, tabulated in every way that is compared: with few wavelets, and by texels.
#pragma once

#include "precompute/materials/field_baker.h"
#include "precompute/materials/field_model.h"
#include "protocol/tripling/material_field.h"
#include "protocol/tripling/texel_store.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace relume::lab {

// Wavelets of a cubemap, without its scaling functions, times a fraction: at least one.
[[nodiscard]] std::size_t terms_of_fraction(std::uint32_t face_resolution, double fraction);

// Immutable and thread-safe. What has several lobes counts as one, each lobe by the mean of its
// colour.
class TabulatedMaterial {
  public:
    // `words` as materials::model_from_words has them. An entry has `texels` as they are, runs
    // of them that hold all but kLeftOff, and for each of `fractions` that part of its
    // wavelets, the largest ones, with all squares above them. Throws as model_from_words does.
    TabulatedMaterial(const std::string& words,
                      std::uint32_t face_resolution,
                      std::span<const double> fractions);
    static constexpr double kLeftOff = 1e-4;

    [[nodiscard]] const std::string& words() const { return words_; }
    // Of the i-th fraction; all have the same grids.
    [[nodiscard]] const tripling::MaterialField& field(std::size_t i) const {
        return fields_[i];
    }
    // In squares of 8×8 (texel_blocks.h): every run that is not zero, and what holds all but
    // kLeftOff.
    [[nodiscard]] const tripling::TexelStore& texels() const { return texels_; }
    [[nodiscard]] const tripling::TexelStore& runs() const { return runs_; }
    // The material itself at a point, not tabulated: 6·n² texels in the order of cubemap.h.
    [[nodiscard]] std::vector<float> at(const Imath::V3f& normal,
                                        const Imath::V3f& reflection) const;
    // Coefficients that are not zero over all, in the field of the i-th fraction.
    [[nodiscard]] double sparsity(std::size_t i) const { return sparsity_[i]; }
    [[nodiscard]] double seconds() const { return seconds_; }

  private:
    std::string words_;
    materials::FieldModel model_;
    materials::TexelSamples samples_;
    std::vector<tripling::MaterialField> fields_;
    std::vector<double> sparsity_;
    tripling::TexelStore texels_;
    tripling::TexelStore runs_;
    double seconds_ = 0;
};

}  // namespace relume::lab
