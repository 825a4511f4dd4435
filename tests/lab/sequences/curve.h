// A number that changes from image to image.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace relume::lab {

// A function of the image's number and a seed alone. Any number of threads may read it.
class Curve {
  public:
    static constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

    // How a value gets from one key to the next.
    enum class Way : std::uint8_t {
        linear,
        slow_fast_slow,  // speed ∝ sin²
        geometric,       // equal ratios in equal times; both values above zero
        hold             // the earlier key's value until the later key
    };
    struct Key {
        std::uint32_t image = 0;
        double value = 0;
    };
    struct Keys {
        std::vector<Key> keys;  // ascending; before the first and after the last their values
        Way way = Way::linear;
    };
    // Recorded: a value an image; the last one stays.
    struct Samples {
        std::vector<double> values;
    };
    // Another value every few images.
    struct Random {
        double from = 0;
        double to = 1;
        std::uint32_t every = 1;
        bool geometric = false;    // equal ratios equally likely
        std::uint64_t stream = 0;  // tells the random curves of one sequence apart
    };

    Curve(double constant);  // NOLINT: a number is a curve
    explicit Curve(std::variant<Keys, Samples, Random> shape);

    [[nodiscard]] double at(std::uint32_t image, std::uint64_t seed) const;
    // The first image from which on it stays as it is; kNever.
    [[nodiscard]] std::uint32_t rests_from() const;

  private:
    std::variant<Keys, Samples, Random> shape_;
};

// A number, {"keys": [[image, value], …], "way": WAY}, {"samples": [value, …]} or
// {"random": {"from", "to", "every", "way"}} (README.md of this folder). Throws
// std::invalid_argument naming `where`, what was found and what is expected.
[[nodiscard]] Curve curve_from_json(const nlohmann::json& json,
                                    const std::string& where,
                                    std::uint64_t stream);

}  // namespace relume::lab
