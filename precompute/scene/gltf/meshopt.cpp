#include "precompute/scene/gltf/meshopt.h"

#include "precompute/scene/shown_text.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace relume::scene::gltf {
namespace {

// A run of equal vertices takes two bits for each 16 bytes, a run of triangles one byte for
// each 12: no stream unpacks to more than this, and none that says so is given memory.
constexpr std::size_t kMostPerByte = 256;
constexpr std::size_t kSmallest = 4096;

class Members {
  public:
    Members(const tinygltf::Value& extension, const FileName& file, const std::string& who)
        : extension_(extension), file_(file), who_(who) {}

    [[noreturn]] void refuse(const std::string& why) const {
        file_.refuse(SceneFault::corrupt_file,
                     fmt::format("{}: {}: {}", who_, kMeshoptExtension, why));
    }
    [[nodiscard]] std::size_t whole(const char* member, int otherwise) const {
        const tinygltf::Value& value = extension_.Get(std::string(member));
        const int number = value.IsNumber() ? value.GetNumberAsInt() : otherwise;
        if (number < 0)
            refuse(fmt::format("no {}; expected a whole number", member));
        return static_cast<std::size_t>(number);
    }
    [[nodiscard]] std::string text(const char* member, const char* otherwise) const {
        const tinygltf::Value& value = extension_.Get(std::string(member));
        return value.IsString() ? value.Get<std::string>() : otherwise;
    }

  private:
    const tinygltf::Value& extension_;
    const FileName& file_;
    const std::string& who_;
};

MeshoptView::Mode mode_of(const Members& members) {
    const std::string mode = members.text("mode", "");
    if (mode == "ATTRIBUTES")
        return MeshoptView::Mode::attributes;
    if (mode == "TRIANGLES")
        return MeshoptView::Mode::triangles;
    if (mode == "INDICES")
        return MeshoptView::Mode::indices;
    members.refuse(
        fmt::format("mode '{}'; expected ATTRIBUTES, TRIANGLES or INDICES", shown_text(mode)));
}

MeshoptView::Filter filter_of(const Members& members) {
    const std::string filter = members.text("filter", "NONE");
    if (filter == "NONE")
        return MeshoptView::Filter::none;
    if (filter == "OCTAHEDRAL")
        return MeshoptView::Filter::octahedral;
    if (filter == "QUATERNION")
        return MeshoptView::Filter::quaternion;
    if (filter == "EXPONENTIAL")
        return MeshoptView::Filter::exponential;
    members.refuse(
        fmt::format("filter '{}'; expected NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL",
                    shown_text(filter)));
}

bool is_allowed(const MeshoptView& view) {
    using Mode = MeshoptView::Mode;
    using Filter = MeshoptView::Filter;
    if (view.mode != Mode::attributes) {
        const bool has_width = view.stride == 2 || view.stride == 4;
        const bool are_whole = view.mode == Mode::indices || view.count % 3 == 0;
        return has_width && are_whole && view.filter == Filter::none;
    }
    if (view.stride == 0 || view.stride > 256 || view.stride % 4 != 0)
        return false;
    if (view.filter == Filter::octahedral)
        return view.stride == 4 || view.stride == 8;
    return view.filter != Filter::quaternion || view.stride == 8;
}

}  // namespace

MeshoptView meshopt_view(const tinygltf::Value& extension,
                         const FileName& file,
                         const std::string& who) {
    const Members members(extension, file, who);
    if (!extension.IsObject())
        members.refuse("no object");
    MeshoptView view{.buffer = static_cast<int>(members.whole("buffer", -1)),
                     .offset = members.whole("byteOffset", 0),
                     .length = members.whole("byteLength", -1),
                     .stride = members.whole("byteStride", -1),
                     .count = members.whole("count", -1),
                     .mode = mode_of(members),
                     .filter = filter_of(members)};
    if (!is_allowed(view))
        members.refuse(fmt::format("{} elements of {} bytes do not fit mode and filter",
                                   view.count, view.stride));
    return view;
}

std::vector<std::uint8_t> decompressed(const MeshoptView& view,
                                       std::span<const std::uint8_t> packed,
                                       const FileName& file,
                                       const std::string& who) {
    const std::size_t bytes = view.count * view.stride;
    const auto refuse = [&](const char* why) {
        file.refuse(SceneFault::corrupt_file,
                    fmt::format("{}: {} elements of {} bytes cannot come from {} bytes of "
                                "meshoptimizer's: {}",
                                who, view.count, view.stride, packed.size(), why));
    };
    if (bytes > kSmallest + kMostPerByte * packed.size())
        refuse("too few");
    std::vector<std::uint8_t> out(bytes);
    int fault = 0;
    switch (view.mode) {
        case MeshoptView::Mode::attributes:
            fault = meshopt_decodeVertexBuffer(out.data(), view.count, view.stride,
                                               packed.data(), packed.size());
            break;
        case MeshoptView::Mode::triangles:
            fault = meshopt_decodeIndexBuffer(out.data(), view.count, view.stride,
                                              packed.data(), packed.size());
            break;
        case MeshoptView::Mode::indices:
            fault = meshopt_decodeIndexSequence(out.data(), view.count, view.stride,
                                                packed.data(), packed.size());
            break;
    }
    if (fault != 0)
        refuse("no such stream");
    switch (view.filter) {
        case MeshoptView::Filter::none:
            break;
        case MeshoptView::Filter::octahedral:
            meshopt_decodeFilterOct(out.data(), view.count, view.stride);
            break;
        case MeshoptView::Filter::quaternion:
            meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
            break;
        case MeshoptView::Filter::exponential:
            meshopt_decodeFilterExp(out.data(), view.count, view.stride);
            break;
    }
    return out;
}

}  // namespace relume::scene::gltf
