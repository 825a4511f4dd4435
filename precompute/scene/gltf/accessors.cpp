#include "precompute/scene/gltf/accessors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace relume::scene::gltf {
namespace {

// An accessor without bytes is zeros; no more of them than this.
constexpr std::size_t kMostZeros = std::size_t{1} << 24;

std::size_t bytes_of_component(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

// Columns of small matrices are padded to four bytes; none of those is asked for.
std::size_t width_of(int type) {
    switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
            return 4;
        case TINYGLTF_TYPE_MAT4:
            return 16;
        default:
            return 0;
    }
}

template <typename Value>
Value value_at(const std::uint8_t* place) {
    Value value;
    std::memcpy(&value, place, sizeof(value));
    return value;
}

// glTF 2.0 §3.11: c/127, c/255, c/32767, c/65535; the lowest signed value is −1 as well.
template <typename Value>
float number_from(const std::uint8_t* place, bool is_normalized) {
    const auto value = static_cast<float>(value_at<Value>(place));
    if (!is_normalized)
        return value;
    return std::max(value / static_cast<float>(std::numeric_limits<Value>::max()), -1.0F);
}

}  // namespace

Elements::Elements(std::vector<float> values, std::size_t width)
    : count_(values.size() / width),
      width_(width),
      component_type_(TINYGLTF_COMPONENT_TYPE_FLOAT),
      own_(std::move(values)) {}

const std::uint8_t* Elements::place(std::size_t i, std::size_t c) const {
    const auto found = std::lower_bound(replaced_.begin(), replaced_.end(), i);
    if (found != replaced_.end() && *found == i) {
        const auto at = static_cast<std::size_t>(found - replaced_.begin());
        return sparse_.data() + (at * width_ + c) * component_bytes_;
    }
    return dense_.empty() ? nullptr : dense_.data() + i * stride_ + c * component_bytes_;
}

float Elements::number(std::size_t i, std::size_t c) const {
    if (!own_.empty())
        return own_[i * width_ + c];
    const std::uint8_t* at = place(i, c);
    if (at == nullptr)
        return 0;
    switch (component_type_) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return number_from<std::int8_t>(at, is_normalized_);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return number_from<std::uint8_t>(at, is_normalized_);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return number_from<std::int16_t>(at, is_normalized_);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return number_from<std::uint16_t>(at, is_normalized_);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return number_from<std::uint32_t>(at, is_normalized_);
        default:
            return value_at<float>(at);
    }
}

std::uint32_t Elements::whole(std::size_t i, std::size_t c) const {
    if (!own_.empty()) {
        // Joints are shorts; what is none is an index that no skin has.
        const float value = own_[i * width_ + c];
        return value >= 0 && value <= 65535 ? static_cast<std::uint32_t>(value) : 65536U;
    }
    const std::uint8_t* at = place(i, c);
    if (at == nullptr)
        return 0;
    if (component_bytes_ == 1)
        return *at;
    return component_bytes_ == 2 ? value_at<std::uint16_t>(at) : value_at<std::uint32_t>(at);
}

Elements Accessors::elements(int index,
                             std::initializer_list<std::size_t> widths,
                             const std::string& who) {
    const auto& accessors = document_.model.accessors;
    const std::size_t checked =
        document_.file.checked_index(index, accessors.size(), who, "accessor");
    const tinygltf::Accessor& accessor = accessors[checked];
    const std::string self = fmt::format("accessor {}", checked);
    const auto refuse = [&](const std::string& why) {
        document_.file.refuse(SceneFault::corrupt_file,
                              fmt::format("{} of {}: {}", self, who, why));
    };
    Elements elements;
    elements.count_ = accessor.count;
    elements.width_ = width_of(accessor.type);
    elements.component_type_ = accessor.componentType;
    elements.component_bytes_ = bytes_of_component(accessor.componentType);
    elements.is_normalized_ = accessor.normalized;
    if (elements.component_bytes_ == 0)
        refuse(fmt::format("componentType {}; expected 5120, 5121, 5122, 5123, 5125 or 5126",
                           accessor.componentType));
    if (std::find(widths.begin(), widths.end(), elements.width_) == widths.end())
        refuse(fmt::format("elements of {} numbers; expected {}", elements.width_,
                           fmt::join(widths.begin(), widths.end(), " or ")));
    if (accessor.count == 0)
        refuse("no elements; expected at least one");
    const std::size_t element_bytes = elements.width_ * elements.component_bytes_;
    if (accessor.bufferView >= 0) {
        const auto bytes = views_.bytes(accessor.bufferView, self);
        const std::size_t stated = views_.stride(accessor.bufferView);
        elements.stride_ = stated == 0 ? element_bytes : stated;
        if (elements.stride_ < element_bytes)
            refuse(
                fmt::format("elements of {} bytes, {} apart", element_bytes, elements.stride_));
        const std::size_t room =
            bytes.size() > accessor.byteOffset ? bytes.size() - accessor.byteOffset : 0;
        const std::size_t most =
            room < element_bytes ? 0 : (room - element_bytes) / elements.stride_ + 1;
        if (accessor.count > most)
            refuse(
                fmt::format("{} elements of {} bytes, {} apart, at {} of buffer view {}, "
                            "which has {} bytes; expected at most {}",
                            accessor.count, element_bytes, elements.stride_,
                            accessor.byteOffset, accessor.bufferView, bytes.size(), most));
        elements.dense_ = bytes.subspan(accessor.byteOffset);
    } else if (accessor.count > kMostZeros) {
        refuse(fmt::format("{} elements without a buffer view; expected at most {}",
                           accessor.count, kMostZeros));
    }
    if (accessor.sparse.isSparse)
        read_sparse(accessor, self, elements);
    return elements;
}

void Accessors::read_sparse(const tinygltf::Accessor& accessor,
                            const std::string& self,
                            Elements& elements) {
    const auto& sparse = accessor.sparse;
    const auto refuse = [&](const std::string& why) {
        document_.file.refuse(SceneFault::corrupt_file,
                              fmt::format("{}: sparse: {}", self, why));
    };
    if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count)
        refuse(fmt::format("{} of {} elements", sparse.count, accessor.count));
    const auto count = static_cast<std::size_t>(sparse.count);
    const auto tight = [&](int view, int offset, std::size_t element_bytes) {
        const auto bytes = views_.bytes(view, self);
        const auto from = static_cast<std::size_t>(std::max(offset, 0));
        if (offset < 0 || from > bytes.size() || count > (bytes.size() - from) / element_bytes)
            refuse(fmt::format("{} elements of {} bytes at {} of buffer view {}, which has {}",
                               count, element_bytes, offset, view, bytes.size()));
        return bytes.subspan(from);
    };
    const std::size_t index_bytes = bytes_of_component(sparse.indices.componentType);
    if (sparse.indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        sparse.indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        sparse.indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        refuse(fmt::format("indices of componentType {}; expected 5121, 5123 or 5125",
                           sparse.indices.componentType));
    Elements indices;
    indices.component_bytes_ = index_bytes;
    indices.stride_ = index_bytes;
    indices.width_ = 1;
    indices.dense_ = tight(sparse.indices.bufferView, sparse.indices.byteOffset, index_bytes);
    elements.replaced_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t index = indices.whole(i, 0);
        if (index >= accessor.count || (i > 0 && index <= elements.replaced_.back()))
            refuse(fmt::format("index {} is {}; expected ascending ones below {}", i, index,
                               accessor.count));
        elements.replaced_.push_back(index);
    }
    elements.sparse_ = tight(sparse.values.bufferView, sparse.values.byteOffset,
                             elements.width_ * elements.component_bytes_);
}

}  // namespace relume::scene::gltf
