#include "server/net/http/decoder_check.h"

#include "protocol/light/environment_error.h"
#include "server/decoder/sandboxed_decoder.h"

#include <fmt/format.h>

#include <span>
#include <stdexcept>
#include <string_view>

namespace relume::net {

namespace {

// Radiance HDR, two texels of radiance 0.5.
constexpr std::string_view kImage =
    "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"
    "\x80\x80\x80\x80\x80\x80\x80\x80";

}  // namespace

void check_decoder(const std::filesystem::path& decoder) {
    decoder::DecodeLimits limits;
    limits.program = decoder;
    try {
        static_cast<void>(
            decoder::decode_in_child(std::as_bytes(std::span(kImage)), {}, limits));
    } catch (const light::EnvironmentError& failure) {
        throw std::runtime_error(fmt::format(
            "--decoder: {}: {}",
            decoder.empty() ? "relume-decode beside this program" : decoder.string(),
            failure.what()));
    }
}

}  // namespace relume::net
