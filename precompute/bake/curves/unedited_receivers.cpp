#include "precompute/bake/curves/unedited_receivers.h"

#include <utility>

namespace relume::bake {

UneditedReceivers::UneditedReceivers(const PixelReceivers& pixels, std::vector<bool> is_edited)
    : pixels_(pixels), is_edited_(std::move(is_edited)) {}

Receiver UneditedReceivers::look(std::size_t receiver) const {
    Receiver left = pixels_.look(receiver);
    leave_out_edited(left);
    return left;
}

std::vector<Receiver> UneditedReceivers::points(std::size_t receiver,
                                                std::uint64_t seed) const {
    std::vector<Receiver> points = pixels_.points(receiver, seed);
    for (Receiver& point : points) {
        leave_out_edited(point);
    }
    return points;
}

void UneditedReceivers::leave_out_edited(Receiver& receiver) const {
    std::erase_if(receiver.surfaces,
                  [&](const ReceiverSurface& surface) { return is_edited_[surface.material]; });
}

}  // namespace relume::bake
