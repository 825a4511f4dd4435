#include "precompute/bake/base/field_request.h"

#include "protocol/base/program/usage.h"
#include "protocol/basis/cubemap.h"
#include "protocol/transport/materials_section.h"

#include <fmt/format.h>

#include <set>

namespace relume::bake {
namespace {

void check_editable(const std::vector<std::string>& editable) {
    constexpr std::size_t kMost = transport::MaterialsSection::kMostMaterials;
    if (editable.size() > kMost) {
        throw program::UsageError(fmt::format(
            "--editable has {} materials, expected at most {}", editable.size(), kMost));
    }
    std::set<std::string> names;
    for (const std::string& name : editable) {
        if (!names.insert(name).second) {
            throw program::UsageError(fmt::format(
                "--editable {}: the material is listed twice, expected each once", name));
        }
    }
}

}  // namespace

void check_fields(const FieldRequest& request, const BakeParameters& parameters) {
    if (request.empty()) {
        if (request.resolution) {
            throw program::UsageError(
                fmt::format("--visibility-resolution is {}: nothing's visibility is stored, "
                            "expected --editable MATERIAL or --fields beside it",
                            *request.resolution));
        }
        return;
    }
    const bool is_image = parameters.receivers == ReceiverKind::pixels;
    if (request.of_vertices && is_image) {
        throw program::UsageError(
            "--fields is for the vertices of a surface, expected --receivers vertices beside "
            "it");
    }
    if (!request.editable.empty() && !is_image) {
        throw program::UsageError(
            "--editable is for the pixels of an image, expected no --receivers vertices "
            "beside it");
    }
    check_editable(request.editable);
    const std::uint32_t n = request.resolution_of(parameters);
    const std::uint32_t most =
        is_image ? parameters.face_resolution : basis::kMaxFaceResolution;
    if (!basis::is_face_resolution(n) || n > most) {
        throw program::UsageError(
            fmt::format("visibility resolution is {}, expected a power of two from {} to {}{}",
                        n, basis::kMinFaceResolution, is_image ? "the light's " : "", most));
    }
}

}  // namespace relume::bake
