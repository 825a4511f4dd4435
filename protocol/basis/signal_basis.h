// The basis of a transport's signal: of light on a cubemap, or of curves.
#pragma once

#include "protocol/basis/bands.h"
#include "protocol/basis/cubemap_basis.h"
#include "protocol/basis/curve_basis.h"

#include <cstddef>
#include <cstdint>
#include <variant>

namespace relume::basis {

// A value, one of the two.
class SignalBasis {
  public:
    SignalBasis(const CubemapBasis& basis) : basis_(basis) {}
    SignalBasis(const CurveBasis& basis) : basis_(basis) {}
    // Haar of the smallest cubemap.
    SignalBasis() = default;

    [[nodiscard]] bool is_of_light() const {
        return std::holds_alternative<CubemapBasis>(basis_);
    }
    // Throws std::bad_variant_access for the other one, as curves() does.
    [[nodiscard]] const CubemapBasis& cubemap() const { return std::get<CubemapBasis>(basis_); }
    [[nodiscard]] const CurveBasis& curves() const { return std::get<CurveBasis>(basis_); }

    [[nodiscard]] std::size_t coefficient_count() const {
        return std::visit([](const auto& basis) { return basis.coefficient_count(); }, basis_);
    }
    [[nodiscard]] Bands bands() const {
        return std::visit([](const auto& basis) { return basis.bands(); }, basis_);
    }

    friend bool operator==(const SignalBasis&, const SignalBasis&) = default;

  private:
    std::variant<CubemapBasis, CurveBasis> basis_;
};

}  // namespace relume::basis
