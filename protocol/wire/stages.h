// What a change of a room's state makes a server do again.
//
// Pure functions on values.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string_view>

namespace relume::wire {

//   signal   what the transport is multiplied with: light is projected and relit
//   view     how pixels come of what is lit: composed again, nothing is relit
//   display  how a picture is developed: half images stand, being linear
//   policy   how images are worked out: nothing that shows changes by itself
enum class Stage : std::uint8_t { signal, view, display, policy };

[[nodiscard]] std::string_view name_from(Stage stage);

// A set of stages.
class Stages {
  public:
    constexpr Stages() = default;
    constexpr Stages(Stage stage) : bits_(bit(stage)) {}

    [[nodiscard]] constexpr bool has(Stage stage) const { return (bits_ & bit(stage)) != 0; }
    [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
    constexpr Stages& operator|=(Stages other) {
        bits_ = static_cast<std::uint8_t>(bits_ | other.bits_);
        return *this;
    }
    friend constexpr Stages operator|(Stages a, Stages b) { return a |= b; }
    friend constexpr bool operator==(Stages, Stages) = default;

  private:
    static constexpr std::uint8_t bit(Stage stage) {
        return static_cast<std::uint8_t>(1U << static_cast<unsigned>(stage));
    }

    std::uint8_t bits_ = 0;
};

constexpr Stages operator|(Stage a, Stage b) {
    return Stages(a) | Stages(b);
}

// The stages that the sections in `patch` touch, whether or not a value in them differs from
// what was. `patch` is an object; a key that is no section of the state touches nothing.
[[nodiscard]] Stages stages_of(const nlohmann::json& patch);

}  // namespace relume::wire
