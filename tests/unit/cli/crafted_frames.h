// Frames as a server of a tiny scene sends them.
#pragma once

#include "protocol/wire/half_image.h"
#include "protocol/wire/image_header.h"
#include "protocol/wire/messages.h"

#include <algorithm>
#include <vector>

namespace relume::cli {

inline constexpr std::uint32_t kTinyWidth = 6;
inline constexpr std::uint32_t kTinyHeight = 4;

inline std::string tiny_snapshot(std::uint64_t revision = 5) {
    wire::RoomState state;
    state.image = {.width = kTinyWidth, .height = kTinyHeight};
    return wire::text_from_message(wire::Snapshot{.room = "r",
                                                  .scene = {.name = "tiny",
                                                            .width = kTinyWidth,
                                                            .height = kTinyHeight,
                                                            .face_resolution = 8},
                                                  .revision = revision,
                                                  .state = state,
                                                  .viewers = 1,
                                                  .limits = {}});
}

// Half planes of one grey; exact unless `relative_error` is above 0.
inline std::vector<std::byte> tiny_half_frame(std::uint64_t revision,
                                              std::uint64_t sequence,
                                              float grey,
                                              float relative_error = 0) {
    wire::HalfImage image{
        .width = kTinyWidth, .height = kTinyHeight, .has_alpha = false, .values = {}};
    image.values.assign(image.plane_count() * image.plane_size(), Imath::half(grey));
    std::vector<std::byte> frame(wire::kImageHeaderBytes);
    const std::size_t payload_bytes = wire::HalfImageEncoder().append_to(frame, image);
    const auto header =
        wire::encode_image_header({.encoding = wire::ImageEncoding::half_planes,
                                   .width = kTinyWidth,
                                   .height = kTinyHeight,
                                   .revision = revision,
                                   .sequence = sequence,
                                   .relative_error = relative_error,
                                   .exact = relative_error == 0,
                                   .payload_bytes = static_cast<std::uint32_t>(payload_bytes)});
    std::copy(header.begin(), header.end(), frame.begin());
    return frame;
}

// A frame whose payload says it is JPEG; nothing here looks into it.
inline std::vector<std::byte> tiny_jpeg_frame(std::uint64_t revision, std::uint64_t sequence) {
    constexpr std::size_t kPayloadBytes = 16;
    const auto header = wire::encode_image_header({.width = kTinyWidth,
                                                   .height = kTinyHeight,
                                                   .revision = revision,
                                                   .sequence = sequence,
                                                   .relative_error = 0.5F,
                                                   .payload_bytes = kPayloadBytes,
                                                   .coefficients_remaining = 9});
    std::vector<std::byte> frame(header.begin(), header.end());
    frame.resize(frame.size() + kPayloadBytes);
    return frame;
}

}  // namespace relume::cli
