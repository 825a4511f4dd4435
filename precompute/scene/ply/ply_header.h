// The header of a PLY file: which elements follow, and what each is made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace relume::scene::ply {

enum class Encoding : std::uint8_t { ascii, little_endian, big_endian };
enum class Type : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

[[nodiscard]] std::size_t size_of(Type type);
[[nodiscard]] bool is_float(Type type);

struct Property {
    std::string name{};
    Type type = Type::f32;  // of the value, or of a list's values
    bool is_list = false;
    Type count_type = Type::u8;  // of a list's length
};

struct Element {
    std::string name{};
    std::uint64_t count = 0;
    std::vector<Property> properties{};
};

struct Header {
    Encoding encoding = Encoding::ascii;
    std::vector<Element> elements{};
    std::vector<std::string> pictures{};  // of `comment TextureFile NAME`
    std::size_t bytes = 0;                // of the header; the data begin there
};

// `file` is the whole file; `name` is for errors. The line end after `end_header` is what ends
// the first line, so that data may begin with any byte. Throws SceneError (corrupt_file).
[[nodiscard]] Header header_from(std::string_view file, const std::string& name);

}  // namespace relume::scene::ply
