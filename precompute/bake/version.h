// Who made a transport directory. Change the version whenever the same input gives other bytes:
// it is part of the fingerprint, so that old shards are not taken for new ones.
#pragma once

#include <string_view>

namespace relume::bake {

[[nodiscard]] constexpr std::string_view generator() {
    return "relume-bake 0.4.4";
}

}  // namespace relume::bake
