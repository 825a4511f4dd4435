// A file of a transport as it is, to be compared.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace relume::bake {

// Empty where there is none.
[[nodiscard]] inline std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace relume::bake
