// What a manifest says of a file beside it.
#pragma once

#include "protocol/transport/manifest_reader.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>

namespace relume::transport {

struct FileRecord {
    std::string file;  // relative to the manifest's folder
    std::uint64_t bytes = 0;
    std::uint64_t checksum = 0;
};

// The record's key `file`: a name that means one file within the directory to every program.
// Its parts are neither empty nor "." nor "..", and no byte of it is a control character.
// Throws TransportError, as all readers of the manifest do.
[[nodiscard]] std::string file_name(const ManifestReader& record);

// {"file", "bytes", "xxh3"}.
[[nodiscard]] nlohmann::json json_from(const FileRecord& record);
[[nodiscard]] FileRecord file_record(const ManifestReader& record);

}  // namespace relume::transport
