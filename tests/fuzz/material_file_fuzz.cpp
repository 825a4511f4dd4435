// Whatever a file of a material holds: it is refused, or what is read can be written and is the
// same. The checksum is made right first, so that the rest of the reader is reached.
#include "protocol/tripling/material_file.h"

#include <xxhash.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::byte> bytes(size);
    if (size < sizeof(std::uint64_t)) {
        return 0;
    }
    std::memcpy(bytes.data(), data, size);
    const std::size_t covered = size - sizeof(std::uint64_t);
    const std::uint64_t checksum = XXH3_64bits(bytes.data(), covered);
    std::memcpy(&bytes[covered], &checksum, sizeof(checksum));
    try {
        const auto field = relume::tripling::field_from_bytes("fuzz", bytes);
        if (relume::tripling::bytes_from_field(field) != bytes) {
            std::abort();
        }
    } catch (const relume::tripling::MaterialFileError&) {
        return 0;
    }
    return 0;
}
