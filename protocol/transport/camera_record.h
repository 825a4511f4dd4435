// The camera whose pixels are a transport's receivers.
#pragma once

#include "protocol/transport/manifest_reader.h"
#include "protocol/transport/receiver_layout.h"

#include <Imath/ImathVec.h>
#include <nlohmann/json_fwd.hpp>

namespace relume::transport {

// Pinhole camera; right, up and forward are orthonormal.
struct CameraRecord {
    Imath::V3f eye{0, 0, 0};
    Imath::V3f right{1, 0, 0};
    Imath::V3f up{0, 1, 0};
    Imath::V3f forward{0, 0, -1};
    float tan_half_width = 1;
    float tan_half_height = 1;

    // Unit direction through the point (x, y) of the image, in pixels. The centre of the first
    // pixel is (0.5, 0.5).
    [[nodiscard]] Imath::V3f direction_from_pixel(float x,
                                                  float y,
                                                  const TileGrid& image) const;
};

// The manifest's section `camera`. Reading throws TransportError naming the key, what was found
// and what was expected.
[[nodiscard]] nlohmann::json json_from(const CameraRecord& camera);
[[nodiscard]] CameraRecord camera_record(const ManifestReader& object);

}  // namespace relume::transport
