// Where a shadow's edge passes in the texels of the light, by one ray through each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::bake {

// What a ray through a texel found. Two neighbours disagree when their states together have
// both bits.
struct TexelState {
    static constexpr std::uint8_t kUnknown = 0;  // no ray
    static constexpr std::uint8_t kBlocked = 1;
    static constexpr std::uint8_t kOpen = 2;
};

// Reused from point to point; one per thread.
class ShadowEdges {
  public:
    // All texels of 6×n×n unknown.
    void reset(std::size_t face_resolution);
    // Of a row-major texel. The one below it is row_stride() further on.
    [[nodiscard]] std::uint8_t* state(std::size_t texel);
    [[nodiscard]] std::size_t row_stride() const { return n_ + 2 * kBorder; }

    // Fills near() and around() by the states.
    void find();
    // Row-major texels with a ray whose four neighbours in the face disagree.
    [[nodiscard]] const std::vector<std::uint32_t>& near() const { return near_; }
    // The same where those agree, and the 24 around it do not.
    [[nodiscard]] const std::vector<std::uint32_t>& around() const { return around_; }

  private:
    // Columns and rows of unknown states around each face.
    static constexpr std::size_t kBorder = 2;

    // Where the states of a row of texels begin; rows count over all faces.
    [[nodiscard]] std::size_t first_state(std::size_t row) const {
        return (row + 2 * kBorder * (row / n_) + kBorder) * row_stride() + kBorder;
    }

    std::size_t n_ = 0;
    // By texel, with the border round each face: the state, and those that it has together with
    // its row's two texels on either side, with and without its own.
    std::vector<std::uint8_t> state_, joined_, beside_;
    std::vector<std::uint8_t> at_edge_;  // flags of one row of texels
    std::vector<std::uint32_t> near_, around_;
};

}  // namespace relume::bake
