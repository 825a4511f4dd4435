#include "protocol/transport/file_record.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <filesystem>

namespace relume::transport {
namespace {

bool is_safe_relative(const std::string& name) {
    constexpr std::size_t kLongest = 255;
    const auto is_control = [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    };
    if (name.empty() || name.size() > kLongest || name.front() == '/' || name.back() == '/' ||
        name.find("//") != std::string::npos ||
        std::any_of(name.begin(), name.end(), is_control)) {
        return false;
    }
    const std::filesystem::path path(name);
    return std::none_of(path.begin(), path.end(),
                        [](const auto& part) { return part == ".." || part == "."; });
}

}  // namespace

std::string file_name(const ManifestReader& record) {
    std::string name = record.string("file");
    if (!is_safe_relative(name)) {
        record.fail("file", text::quote(name),
                    "a relative path of up to 255 bytes, without '..', empty parts or control "
                    "characters");
    }
    return name;
}

nlohmann::json json_from(const FileRecord& record) {
    return {{"file", record.file},
            {"bytes", record.bytes},
            {"xxh3", text_from_checksum(record.checksum)}};
}

FileRecord file_record(const ManifestReader& record) {
    return {.file = file_name(record),
            .bytes = record.integer("bytes", 0, std::uint64_t{1} << 40),
            .checksum = record.digits("xxh3")};
}

}  // namespace relume::transport
