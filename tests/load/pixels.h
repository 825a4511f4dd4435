// Image files as the programs read and write them, value by value.
#pragma once

#include <filesystem>
#include <vector>

namespace relume::test {

struct Pixels {
    int channels = 0;
    std::vector<float> values;  // interleaved, row by row from the top
};

// Throws std::runtime_error.
[[nodiscard]] Pixels pixels_of(const std::filesystem::path& path);

// ‖b − a·scale‖ / ‖a·scale‖
[[nodiscard]] double relative_l2(const Pixels& a, const Pixels& b, double scale = 1);

// A Radiance file of one sun over a grey sky, lat-long. Throws std::runtime_error.
void write_environment(const std::filesystem::path& path);

}  // namespace relume::test
