#include "precompute/bake/rows/shadow_edges.h"

#include "protocol/basis/cpu_clones.h"
#include "protocol/basis/cubemap.h"

namespace relume::bake {
namespace {

// States that the texels of a row and two on either side have together; in `beside` without
// their own.
RELUME_CPU_CLONES void join_columns(const std::uint8_t* state,
                                    std::size_t count,
                                    std::uint8_t* joined,
                                    std::uint8_t* beside) {
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* at = state + i;
        beside[i] = static_cast<std::uint8_t>(*(at - 2) | *(at - 1) | at[1] | at[2]);
        joined[i] = static_cast<std::uint8_t>(beside[i] | *at);
    }
}

// Which texels of a row are at an edge, and how near. `side` is from row to row, of states and
// of `joined`.
RELUME_CPU_CLONES void flag_edges(const std::uint8_t* state,
                                  const std::uint8_t* joined,
                                  const std::uint8_t* beside,
                                  std::size_t side,
                                  std::size_t count,
                                  std::uint8_t* flags) {
    constexpr std::uint8_t kBoth = TexelState::kBlocked | TexelState::kOpen;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* at = state + i;
        const std::uint8_t* rows = joined + i;
        const auto four =
            static_cast<std::uint8_t>(at[1] | *(at - 1) | at[side] | *(at - side));
        const auto all = static_cast<std::uint8_t>(
            beside[i] | *(rows - 2 * side) | *(rows - side) | rows[side] | rows[2 * side]);
        const auto near = static_cast<std::uint8_t>(four == kBoth);
        const auto around = static_cast<std::uint8_t>(all == kBoth);
        flags[i] = *at == TexelState::kUnknown ? std::uint8_t{0}
                                               : static_cast<std::uint8_t>(near + around);
    }
}

}  // namespace

void ShadowEdges::reset(std::size_t face_resolution) {
    n_ = face_resolution;
    state_.assign(basis::kFaceCount * row_stride() * row_stride(), TexelState::kUnknown);
}

std::uint8_t* ShadowEdges::state(std::size_t texel) {
    return &state_[first_state(texel / n_) + texel % n_];
}

void ShadowEdges::find() {
    const std::size_t side = row_stride();
    const std::size_t rows = basis::kFaceCount * side;
    joined_.resize(rows * side);
    beside_.resize(rows * side);
    for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t first = row * side + kBorder;
        join_columns(&state_[first], n_, &joined_[first], &beside_[first]);
    }
    near_.clear();
    around_.clear();
    at_edge_.resize(n_);
    for (std::size_t row = 0; row < basis::kFaceCount * n_; ++row) {
        const std::size_t first = first_state(row);
        flag_edges(&state_[first], &joined_[first], &beside_[first], side, n_, at_edge_.data());
        for (std::size_t column = 0; column < n_; ++column) {
            if (at_edge_[column] != 0) {
                std::vector<std::uint32_t>& edges = at_edge_[column] == 1 ? around_ : near_;
                edges.push_back(static_cast<std::uint32_t>(row * n_ + column));
            }
        }
    }
}

}  // namespace relume::bake
