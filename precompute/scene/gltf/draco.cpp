#include "precompute/scene/gltf/draco.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace relume::scene::gltf {
namespace {

constexpr const char* kExtension = "KHR_draco_mesh_compression";

// The largest value of an integer attribute, to divide by where it is normalized; 0 for floats.
double largest_of(draco::DataType type) {
    switch (type) {
        case draco::DT_INT8:
            return std::numeric_limits<std::int8_t>::max();
        case draco::DT_UINT8:
            return std::numeric_limits<std::uint8_t>::max();
        case draco::DT_INT16:
            return std::numeric_limits<std::int16_t>::max();
        case draco::DT_UINT16:
            return std::numeric_limits<std::uint16_t>::max();
        case draco::DT_INT32:
            return std::numeric_limits<std::int32_t>::max();
        case draco::DT_UINT32:
            return std::numeric_limits<std::uint32_t>::max();
        default:
            return 0;
    }
}

// One value of an attribute, of up to four components. False where it cannot be had.
bool read_value(const draco::PointAttribute& attribute,
                draco::AttributeValueIndex index,
                bool is_normalized,
                std::vector<float>& out) {
    const auto width = static_cast<std::int8_t>(attribute.num_components());
    const double largest = largest_of(attribute.data_type());
    if (largest == 0) {
        float numbers[4] = {};
        if (!attribute.ConvertValue<float>(index, width, numbers))
            return false;
        out.insert(out.end(), numbers, numbers + width);
        return true;
    }
    std::int64_t whole[4] = {};
    if (!attribute.ConvertValue<std::int64_t>(index, width, whole))
        return false;
    for (int c = 0; c < width; ++c) {
        const auto value = static_cast<double>(whole[c]);
        out.push_back(
            static_cast<float>(is_normalized ? std::max(value / largest, -1.0) : value));
    }
    return true;
}

}  // namespace

bool is_draco(const tinygltf::Primitive& primitive) {
    return primitive.extensions.contains(kExtension);
}

DracoMesh decode_draco(const tinygltf::Primitive& primitive,
                       const Document& document,
                       BufferViews& views,
                       const std::string& who) {
    const auto refuse = [&](const std::string& why) {
        document.file.refuse(SceneFault::corrupt_file,
                             fmt::format("{}: {}: {}", who, kExtension, why));
    };
    const tinygltf::Value& extension = primitive.extensions.at(kExtension);
    const tinygltf::Value nothing;
    const auto member = [&](const char* name) -> const tinygltf::Value& {
        return extension.IsObject() ? extension.Get(std::string(name)) : nothing;
    };
    if (!member("bufferView").IsNumber() || !member("attributes").IsObject())
        refuse("no bufferView and attributes");
    const auto packed = views.bytes(member("bufferView").GetNumberAsInt(), who);
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(packed.data()), packed.size());
    draco::Decoder decoder;
    auto result = decoder.DecodeMeshFromBuffer(&buffer);
    if (!result.ok())
        refuse(fmt::format("{} bytes that are no mesh of Draco's: {}", packed.size(),
                           result.status().error_msg()));
    const std::unique_ptr<draco::Mesh> mesh = std::move(result).value();
    DracoMesh out;
    out.indices.reserve(std::size_t{3} * mesh->num_faces());
    for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f) {
        for (const draco::PointIndex& corner : mesh->face(f))
            out.indices.push_back(corner.value());
    }
    for (const auto& [name, accessor_index] : primitive.attributes) {
        const tinygltf::Value& id = member("attributes").Get(name);
        if (!id.IsNumber())
            continue;
        const draco::PointAttribute* attribute =
            mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(id.GetNumberAsInt()));
        if (attribute == nullptr || attribute->num_components() < 1 ||
            attribute->num_components() > 4)
            refuse(fmt::format("no attribute {} for {}", id.GetNumberAsInt(), name));
        const auto& accessors = document.model.accessors;
        const bool is_normalized =
            accessors[document.file.checked_index(accessor_index, accessors.size(), who,
                                                  "accessor")]
                .normalized;
        std::vector<float> values;
        values.reserve(std::size_t{mesh->num_points()} *
                       static_cast<std::size_t>(attribute->num_components()));
        for (draco::PointIndex point(0); point < mesh->num_points(); ++point) {
            const draco::AttributeValueIndex at = attribute->mapped_index(point);
            if (at.value() >= attribute->size() ||
                !read_value(*attribute, at, is_normalized, values))
                refuse(fmt::format("{} of point {} cannot be read", name, point.value()));
        }
        if (values.empty())
            refuse("no points");
        out.attributes.emplace(
            name,
            Elements(std::move(values), static_cast<std::size_t>(attribute->num_components())));
    }
    return out;
}

}  // namespace relume::scene::gltf
