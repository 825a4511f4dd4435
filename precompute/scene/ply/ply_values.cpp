#include "precompute/scene/ply/ply_values.h"

#include "precompute/scene/error.h"
#include "precompute/scene/shown_text.h"
#include "precompute/scene/text_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace relume::scene::ply {
namespace {

template <typename T>
double value_from(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return static_cast<double>(value);
}

}  // namespace

void Values::refuse(const std::string& why) const {
    throw SceneError(SceneFault::corrupt_file, fmt::format("scene '{}': {}", name_, why));
}

double Values::next_text() {
    constexpr std::string_view kBlanks = " \t\r\n\v\f";
    data_.remove_prefix(std::min(data_.find_first_not_of(kBlanks), data_.size()));
    const std::string_view word = data_.substr(0, data_.find_first_of(kBlanks));
    if (word.empty())
        refuse("the file ends before its last element; copy it again");
    const auto value = number_from(word);
    if (!value)
        refuse(fmt::format("'{}'; expected a number", shown_text(word.substr(0, 40))));
    data_.remove_prefix(word.size());
    return *value;
}

double Values::next(Type type) {
    if (encoding_ == Encoding::ascii)
        return next_text();
    const std::size_t size = size_of(type);
    if (data_.size() < size)
        refuse("the file ends before its last element; copy it again");
    std::array<char, 8> bytes{};
    std::copy_n(data_.begin(), size, bytes.begin());
    if ((encoding_ == Encoding::big_endian) != (std::endian::native == std::endian::big))
        std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    data_.remove_prefix(size);
    switch (type) {
        case Type::i8:
            return value_from<std::int8_t>(bytes.data());
        case Type::u8:
            return value_from<std::uint8_t>(bytes.data());
        case Type::i16:
            return value_from<std::int16_t>(bytes.data());
        case Type::u16:
            return value_from<std::uint16_t>(bytes.data());
        case Type::i32:
            return value_from<std::int32_t>(bytes.data());
        case Type::u32:
            return value_from<std::uint32_t>(bytes.data());
        case Type::f32:
            return value_from<float>(bytes.data());
        case Type::f64:
            break;
    }
    return value_from<double>(bytes.data());
}

std::uint64_t Values::next_whole(Type type) {
    const double value = next(type);
    if (!(value >= 0 && value <= 0xFFFFFFFFU) || value != std::floor(value))
        refuse(fmt::format(
            "{} where a count or an index stands; expected a whole number from 0", value));
    return static_cast<std::uint64_t>(value);
}

bool Values::can_hold(const Element& element) const {
    std::uint64_t least = 0;
    for (const Property& property : element.properties) {
        if (encoding_ == Encoding::ascii)
            least += 2;  // a digit and a blank
        else
            least += size_of(property.is_list ? property.count_type : property.type);
    }
    // The last number of a text needs no blank behind it.
    return least == 0 || element.count <= (data_.size() + 1) / least;
}

}  // namespace relume::scene::ply
