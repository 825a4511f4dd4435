#include "tests/unit/wire/vectors.h"

#include <charconv>
#include <fstream>
#include <stdexcept>

namespace relume::wire {

nlohmann::json vectors_from_file(const std::string& name) {
    const std::string path = std::string(RELUME_WIRE_VECTORS) + "/" + name + ".json";
    std::ifstream file(path);
    if (!file) {
        throw std::runtime_error(path + ": cannot be read");
    }
    nlohmann::json vectors = nlohmann::json::parse(file);
    if (vectors.empty()) {
        throw std::runtime_error(path + ": holds no case");
    }
    return vectors;
}

std::vector<std::byte> bytes_from_hex(std::string_view hex) {
    std::vector<std::byte> bytes;
    bytes.reserve(hex.size() / 2);
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
        unsigned value = 0;
        const char* end = hex.data() + i + 2;
        if (std::from_chars(hex.data() + i, end, value, 16).ptr != end) {
            throw std::runtime_error("not hexadecimal: " + std::string(hex));
        }
        bytes.push_back(static_cast<std::byte>(value));
    }
    return bytes;
}

}  // namespace relume::wire
