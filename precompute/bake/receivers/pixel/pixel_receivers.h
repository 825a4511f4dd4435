// Pixels of an image, seen by the scene's camera: receiver y·width + x is pixel (x, y), a
// cluster is a tile of 16×16, and steps are pixels.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/bake/receivers/pixel/pixel_view.h"
#include "precompute/bake/receivers/receivers.h"
#include "precompute/scene/camera.h"
#include "protocol/transport/receiver_layout.h"

#include <array>
#include <span>

namespace relume::bake {

// Paths along a Morton curve, so that any aligned square of pixels has an aligned run of the
// sequence [Ahmed20]; rays by Roberts' R2 sequence along both axes.
[[nodiscard]] SequencePlace sequence_place_from_pixel(std::uint32_t x, std::uint32_t y);

class PixelReceivers final : public Receivers {
  public:
    // An image of the scene, seen by its own camera. Of the parameters the size, the samples of
    // a pixel and the seed count. Keeps a reference to the caster. Throws SceneError.
    PixelReceivers(const RayCaster& caster, const BakeParameters& parameters);

    [[nodiscard]] const transport::TileGrid& image() const { return image_; }
    [[nodiscard]] const scene::Camera& camera() const { return camera_; }
    [[nodiscard]] PixelView view(std::uint32_t x, std::uint32_t y) const;

    [[nodiscard]] std::size_t receiver_count() const override;
    [[nodiscard]] std::uint32_t cluster_count() const override { return image_.block_count(); }
    [[nodiscard]] std::uint32_t terms(std::uint32_t /*cluster*/) const override { return 1; }
    [[nodiscard]] std::span<const transport::BlockBasis> block_bases() const override {
        static constexpr std::array kBases{transport::BlockBasis::haar_tile};
        return kBases;
    }
    // Whole tile rows where one fits into a shard, else a part of a row.
    [[nodiscard]] std::uint32_t clusters_per_shard() const override;
    [[nodiscard]] std::optional<std::size_t> receiver_at(std::uint32_t cluster,
                                                         std::uint32_t slot) const override;
    [[nodiscard]] Receiver look(std::size_t receiver) const override;
    // Pixels of an image that is finer by kFiner, each seen at its middle alone: one at random
    // of every quarter of the pixel, of every sixteenth where an edge passes.
    [[nodiscard]] std::vector<Receiver> points(std::size_t receiver,
                                               std::uint64_t seed) const override;
    // A square; row by row.
    void find_neighbours(std::size_t receiver,
                         std::uint32_t radius,
                         std::vector<Neighbour>& neighbours) const override;
    // Runs are parts of pixel rows.
    [[nodiscard]] std::vector<ReceiverRun> reach(std::uint32_t first_cluster,
                                                 std::uint32_t cluster_count,
                                                 std::uint32_t radius) const override;
    [[nodiscard]] std::size_t first_in_reach(std::uint32_t first_cluster,
                                             std::uint32_t radius) const override;
    [[nodiscard]] ReachBound most_in_reach(std::uint32_t radius) const override;
    [[nodiscard]] std::size_t middle_of_cluster(std::uint32_t cluster) const override;
    [[nodiscard]] std::vector<std::size_t> spread_over_all(std::size_t count) const override;
    // The 2×2 pixels in the middle of a tile.
    [[nodiscard]] ClusterPatch patch() const override;

  private:
    static constexpr std::uint32_t kFiner = 8;

    // Columns [left, right) and rows [top, bottom) of pixels.
    struct Box {
        std::uint32_t left = 0;
        std::uint32_t top = 0;
        std::uint32_t right = 0;
        std::uint32_t bottom = 0;
    };
    struct Pixel {
        std::uint32_t x = 0;
        std::uint32_t y = 0;
    };

    [[nodiscard]] Box tile(std::uint32_t cluster) const;
    // The part of it that is in the image.
    [[nodiscard]] Box grown(const Box& box, std::uint32_t radius) const;
    [[nodiscard]] Pixel pixel_from_receiver(std::size_t receiver) const;
    [[nodiscard]] std::size_t receiver_from_pixel(std::uint32_t x, std::uint32_t y) const;

    const RayCaster& caster_;
    transport::TileGrid image_;
    scene::Camera camera_;
    scene::Camera finer_camera_;
    std::uint32_t pixel_samples_;
    std::uint64_t seed_;
};

}  // namespace relume::bake
