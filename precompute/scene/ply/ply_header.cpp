#include "precompute/scene/ply/ply_header.h"

#include "precompute/scene/error.h"
#include "precompute/scene/shown_text.h"
#include "precompute/scene/text_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

namespace relume::scene::ply {
namespace {

constexpr std::size_t kLongestHeader = 1U << 20U;
constexpr std::size_t kMostProperties = 4096;  // of a file

std::optional<Type> type_called(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, Type>, 16> kTypes{{
        {"char", Type::i8},
        {"int8", Type::i8},
        {"uchar", Type::u8},
        {"uint8", Type::u8},
        {"short", Type::i16},
        {"int16", Type::i16},
        {"ushort", Type::u16},
        {"uint16", Type::u16},
        {"int", Type::i32},
        {"int32", Type::i32},
        {"uint", Type::u32},
        {"uint32", Type::u32},
        {"float", Type::f32},
        {"float32", Type::f32},
        {"double", Type::f64},
        {"float64", Type::f64},
    }};
    const auto found = std::find_if(kTypes.begin(), kTypes.end(),
                                    [&](const auto& entry) { return entry.first == name; });
    return found != kTypes.end() ? std::optional(found->second) : std::nullopt;
}

class Reader {
  public:
    Reader(std::string_view file, const std::string& name)
        : name_(name), text_(file.substr(0, kLongestHeader)) {}

    Header read() {
        find_line_end();
        if (take_line() != "ply")
            refuse("expected 'ply' in the first line");
        bool has_format = false;
        while (true) {
            std::string_view rest = take_line();
            const std::string_view keyword = take_word(rest);
            if (keyword == "end_header")
                break;
            if (keyword == "format") {
                format(rest);
                has_format = true;
            } else if (keyword == "element") {
                element(rest);
            } else if (keyword == "property") {
                property(rest);
            } else if (keyword == "comment") {
                if (take_word(rest) == "TextureFile")
                    header_.pictures.emplace_back(trimmed(rest));
            } else if (keyword != "obj_info" && !keyword.empty()) {
                refuse("expected format, element, property, comment or end_header");
            }
        }
        if (!has_format)
            refuse("expected a format before end_header");
        header_.bytes = at_;
        return std::move(header_);
    }

  private:
    [[noreturn]] void refuse(const std::string& why) const {
        throw SceneError(SceneFault::corrupt_file,
                         fmt::format("scene '{}': PLY header, line {} '{}': {}", name_, number_,
                                     shown_text(line_.substr(0, 60)), why));
    }

    void find_line_end() {
        const std::size_t end = text_.find_first_of("\r\n");
        if (end == std::string_view::npos || text_.substr(0, 3) != "ply")
            throw SceneError(
                SceneFault::corrupt_file,
                fmt::format(
                    "scene '{}' has no PLY header; expected 'ply' … 'end_header' in its "
                    "first {} bytes",
                    name_, kLongestHeader));
        line_end_ = text_.substr(end, text_.substr(end, 2) == "\r\n" ? 2 : 1);
    }

    std::string_view take_line() {
        const std::size_t end = text_.find(line_end_, at_);
        if (end == std::string_view::npos)
            throw SceneError(SceneFault::corrupt_file,
                             fmt::format("scene '{}': its PLY header has no end; expected "
                                         "'end_header' in its first {} bytes",
                                         name_, kLongestHeader));
        line_ = text_.substr(at_, end - at_);
        at_ = end + line_end_.size();
        ++number_;
        // A header of mixed line ends; not where data could be meant.
        while (line_.ends_with('\r'))
            line_.remove_suffix(1);
        return line_ = trimmed(line_);
    }

    void format(std::string_view rest) {
        const std::string_view encoding = take_word(rest);
        if (encoding == "ascii")
            header_.encoding = Encoding::ascii;
        else if (encoding == "binary_little_endian")
            header_.encoding = Encoding::little_endian;
        else if (encoding == "binary_big_endian")
            header_.encoding = Encoding::big_endian;
        else
            refuse("expected ascii, binary_little_endian or binary_big_endian");
        if (trimmed(rest) != "1.0")
            refuse("expected version 1.0");
    }

    void element(std::string_view rest) {
        Element element{.name = std::string(take_word(rest))};
        const std::string_view count = trimmed(rest);
        const auto [end, error] =
            std::from_chars(count.data(), count.data() + count.size(), element.count);
        if (error != std::errc{} || end != count.data() + count.size() || element.name.empty())
            refuse("expected a name and a whole number");
        if (header_.elements.size() == kMostProperties)
            refuse("too many elements");
        header_.elements.push_back(std::move(element));
    }

    void property(std::string_view rest) {
        if (header_.elements.empty())
            refuse("expected an element first");
        Property property;
        std::string_view type = take_word(rest);
        if (type == "list") {
            property.is_list = true;
            const auto count_type = type_called(take_word(rest));
            if (!count_type || is_float(*count_type))
                refuse("expected a whole type for the length of a list");
            property.count_type = *count_type;
            type = take_word(rest);
        }
        const auto known = type_called(type);
        property.name = trimmed(rest);
        if (!known || property.name.empty())
            refuse("expected a type such as float or uchar, and a name");
        property.type = *known;
        if (++property_count_ > kMostProperties)
            refuse("too many properties");
        header_.elements.back().properties.push_back(std::move(property));
    }

    const std::string& name_;
    std::string_view text_;
    std::string_view line_end_;
    std::string_view line_;
    std::size_t at_ = 0;
    std::size_t number_ = 0;
    std::size_t property_count_ = 0;
    Header header_;
};

}  // namespace

std::size_t size_of(Type type) {
    switch (type) {
        case Type::i8:
        case Type::u8:
            return 1;
        case Type::i16:
        case Type::u16:
            return 2;
        case Type::f64:
            return 8;
        default:
            return 4;
    }
}

bool is_float(Type type) {
    return type == Type::f32 || type == Type::f64;
}

Header header_from(std::string_view file, const std::string& name) {
    return Reader(file, name).read();
}

}  // namespace relume::scene::ply
