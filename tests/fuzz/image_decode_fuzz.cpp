// Any bytes are either an image whose texels may be relied on, or refused with
// EnvironmentError.
//
// The first byte chooses whether a projection is asked for. OpenEXR itself
// comes uninstrumented from the distribution: in it this finds what crashes, not what reads
// amiss.
#include "protocol/light/environment_error.h"
#include "protocol/light/environment_import.h"

#include <OpenEXR/ImfThreading.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <utility>

using relume::light::EnvironmentError;
using relume::light::EnvironmentMap;
using relume::light::ImportedImage;
using relume::light::Projection;

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
    Imf::setGlobalThreadCount(0);
    return 0;
}

namespace {

// The map refuses texels that the import should have repaired, and that ends the run.
void check_usable(ImportedImage imported) noexcept {
    const EnvironmentMap map(std::move(imported.image), imported.projection);
    if (!(map.radiance({0.3F, 0.2F, 1}, 0.01F).x >= 0)) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) {
        return 0;
    }
    constexpr std::uint8_t kProjections = 5;
    const std::optional<Projection> projection =
        data[0] < kProjections ? std::optional(static_cast<Projection>(data[0])) : std::nullopt;
    constexpr std::size_t kMaxTexels = std::size_t{1} << 16;
    try {
        ImportedImage imported =
            relume::light::import_image(std::as_bytes(std::span(data, size)).subspan(1),
                                        {.projection = projection, .max_texels = kMaxTexels});
        if (std::size_t{imported.image.width} * imported.image.height > kMaxTexels) {
            std::abort();
        }
        check_usable(std::move(imported));
    } catch (const EnvironmentError& e) {
        if (*e.what() == '\0') {
            std::abort();
        }
    }
    return 0;
}
