#include "protocol/transport/manifest.h"

#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/base/text/strict_json.h"
#include "protocol/transport/checksum.h"
#include "protocol/transport/error.h"
#include "protocol/transport/manifest_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace relume::transport {
namespace {

using nlohmann::json;
using BasisKind = basis::CubemapBasis::Kind;

constexpr std::string_view kHaar = "haar";
constexpr std::string_view kSphericalHarmonics = "sh";
constexpr std::string_view kDaubechies4 = "daubechies4";

// Of kind `curves` there is one curve for each of its materials.
basis::SignalBasis signal_basis(const ManifestReader& object, const Manifest& manifest) {
    const std::string name = object.string("name");
    if (manifest.curves) {
        object.expect_text("name", kDaubechies4);
        const auto count = static_cast<std::uint32_t>(manifest.curves->curves.size());
        object.expect_integer("curves", count);
        return basis::CurveBasis(count);
    }
    const std::uint32_t n = object.integer32("face_resolution", basis::kMinFaceResolution,
                                             basis::kMaxFaceResolution);
    if (!basis::is_face_resolution(n)) {
        object.fail("face_resolution", std::to_string(n), "a power of two from 4 to 256");
    }
    if (name == kHaar) {
        return basis::CubemapBasis::haar(n);
    }
    if (name == kSphericalHarmonics) {
        return basis::CubemapBasis::spherical_harmonics(
            object.integer32("order", 1, basis::kMaxShOrder), n);
    }
    object.fail("name", text::quote(name), "haar or sh");
}

json json_from(const ShardRecord& shard) {
    return {{"file", shard.file},
            {"bytes", shard.bytes},
            {"header_xxh3", text_from_checksum(shard.header_checksum)},
            {"first_block", shard.first_block},
            {"block_count", shard.block_count}};
}

// Shards must cover the blocks in order and without a gap.
std::vector<ShardRecord> shard_records(const ManifestReader& top,
                                       std::uint32_t block_count,
                                       std::string_view file) {
    const json& list = top.member("shards");
    if (!list.is_array()) {
        top.fail("shards", list.type_name(), "an array");
    }
    std::vector<ShardRecord> shards;
    std::uint32_t next_block = 0;
    for (const json& entry : list) {
        const ManifestReader record(entry, fmt::format("{}: shards[{}]", file, shards.size()));
        ShardRecord shard{
            .file = file_name(record),
            .bytes = record.integer("bytes", 0, std::uint64_t{1} << 40),
            .header_checksum = record.digits("header_xxh3"),
            .first_block = record.integer32("first_block", next_block, next_block),
            .block_count = record.integer32("block_count", 1, kMaxBlocksPerShard)};
        next_block += shard.block_count;
        shards.push_back(std::move(shard));
    }
    if (next_block != block_count) {
        top.fail("shards", fmt::format("{} blocks", next_block),
                 fmt::format("{} blocks", block_count));
    }
    return shards;
}

// What the receivers are and how they are stored, as the kind says.
void read_receivers(const ManifestReader& top, Manifest& manifest) {
    if (manifest.kind != Kind::mesh) {
        const ManifestReader image = top.object("image");
        manifest.layout = ReceiverLayout::pixel_tiles(
            {.width = image.integer32("width", 1, kMaxImageSide),
             .height = image.integer32("height", 1, kMaxImageSide)});
        return;
    }
    const auto basis = kBlockBasisNames.value(top.string("block_basis"));
    if (!basis || *basis == BlockBasis::haar_tile) {
        top.fail("block_basis", text::quote(top.string("block_basis")),
                 fmt::format("{} or {}", kBlockBasisNames.name(BlockBasis::haar_line),
                             kBlockBasisNames.name(BlockBasis::identity)));
    }
    manifest.block_basis = *basis;
    const ManifestReader mesh = top.object("mesh");
    manifest.mesh = mesh_section(mesh);
    manifest.layout =
        ReceiverLayout::vertex_clusters(vertex_clusters(mesh, manifest.mesh->materials.size()));
}

// Splits off and verifies the first line, {"xxh3":"…",
void check_first_line(std::string_view text, std::string_view file) {
    constexpr std::string_view kBegin = "{\"xxh3\":\"";
    constexpr std::string_view kEnd = "\",";
    const std::size_t newline = text.find('\n');
    const std::string_view line = text.substr(0, newline);
    constexpr std::size_t kDigits = 16;
    if (newline == std::string_view::npos ||
        line.size() != kBegin.size() + kDigits + kEnd.size() || !line.starts_with(kBegin) ||
        !line.ends_with(kEnd)) {
        throw TransportError(
            fmt::format("{}: first line: expected {{\"xxh3\":\"<16 digits>\",", file));
    }
    const auto expected = line.substr(kBegin.size(), kDigits);
    const auto found =
        text_from_checksum(checksum(std::as_bytes(std::span(text.substr(newline + 1)))));
    if (found != expected) {
        throw TransportError(
            fmt::format("{}: checksum is {}, expected {}", file, found, expected));
    }
}

}  // namespace

std::string_view name_of(const basis::SignalBasis& basis) {
    if (!basis.is_of_light()) {
        return kDaubechies4;
    }
    return basis.cubemap().kind() == BasisKind::haar ? kHaar : kSphericalHarmonics;
}

json json_from(const basis::SignalBasis& basis) {
    json object{{"name", name_of(basis)}};
    if (!basis.is_of_light()) {
        object["curves"] = basis.curves().curve_count();
        return object;
    }
    object["face_resolution"] = basis.cubemap().face_resolution();
    if (basis.cubemap().kind() == BasisKind::spherical_harmonics) {
        object["order"] = basis.cubemap().order();
    }
    return object;
}

json json_from(const std::optional<SamplingError>& error) {
    return error ? json{{"natural", error->natural}, {"sun", error->sun}} : json();
}

std::string text_from_manifest(const Manifest& manifest) {
    json shards = json::array();
    for (const ShardRecord& shard : manifest.shards) {
        shards.push_back(json_from(shard));
    }
    json object{
        {"format", "relume-transport"},
        {"version", kFormatVersion},
        {"kind", kKindNames.name(manifest.kind)},
        {"generator", manifest.generator},
        {"fingerprint", text_from_checksum(manifest.fingerprint)},
        {"basis", json_from(manifest.signal_basis)},
        {"colour", json_from(manifest.colour)},
        {"blocks", manifest.block_count()},
        {"sketch",
         {{"stating_rows", manifest.stating_rows}, {"choosing_rows", manifest.choosing_rows}}},
        {"files",
         {{"columns", json_from(manifest.columns)},
          {"receivers", json_from(manifest.receivers)},
          {"sketch", json_from(manifest.sketch)}}},
        {"shards", shards},
        {"camera", json_from(manifest.camera)},
        {"bake", manifest.bake},
        {"measured", manifest.measured}};
    if (manifest.kind != Kind::mesh) {
        object["image"] = {{"width", manifest.image().width},
                           {"height", manifest.image().height}};
    } else {
        object["block_basis"] = kBlockBasisNames.name(manifest.block_basis);
        object["mesh"] = json_from(manifest.mesh.value(), manifest.layout.clusters());
        object["files"]["mesh"] = json_from(manifest.mesh->mesh);
        object["files"]["brdfs"] = json_from(manifest.mesh->brdfs);
        object["files"]["textures"] = json_from(manifest.mesh->textures);
    }
    if (manifest.curves) {
        object["curves"] = json_from(manifest.curves->curves);
        object["light"] = manifest.curves->light;
    }
    if (manifest.materials) {
        object["materials"] = json_from(*manifest.materials);
    }
    if (manifest.visibility) {
        object["visibility"] = json_from(*manifest.visibility);
    }
    if (manifest.sampling_error) {
        object["sampling_error"] = json_from(manifest.sampling_error);
    }
    // The object's text without its opening brace follows the checksum line.
    const std::string body =
        object.dump(1, ' ', false, json::error_handler_t::replace).substr(1) + "\n";
    return fmt::format("{{\"xxh3\":\"{}\",\n{}",
                       text_from_checksum(checksum(std::as_bytes(std::span(body)))), body);
}

Manifest manifest_from_text(std::string_view json_text, std::string_view file) {
    check_first_line(json_text, file);
    const json parsed = [&] {
        try {
            return text::parse_strict_json(json_text, kMaxManifestBytes);
        } catch (const text::JsonError& error) {
            throw TransportError(fmt::format("{}: {}", file, error.what()));
        }
    }();
    const ManifestReader top(parsed, std::string(file) + ": manifest");
    top.expect_text("format", "relume-transport");
    top.expect_integer("version", kFormatVersion);
    const auto kind = kKindNames.value(top.string("kind"));
    if (!kind) {
        top.fail("kind", text::quote(top.string("kind")), kKindNames.alternatives());
    }

    Manifest manifest;
    manifest.kind = *kind;
    manifest.generator = top.string("generator");
    manifest.fingerprint = top.digits("fingerprint");
    read_receivers(top, manifest);
    if (manifest.kind == Kind::curves) {
        manifest.curves = curves_section(top);
    }
    manifest.signal_basis = signal_basis(top.object("basis"), manifest);
    manifest.colour = colour_model(top.object("colour"));
    top.expect_integer("blocks", manifest.block_count());
    const ManifestReader sketch = top.object("sketch");
    manifest.stating_rows = sketch.integer32("stating_rows", kMinSketchRows, kMaxSketchRows);
    manifest.choosing_rows = sketch.integer32("choosing_rows", kMinSketchRows, kMaxSketchRows);
    const ManifestReader files = top.object("files");
    manifest.columns = file_record(files.object("columns"));
    manifest.receivers = file_record(files.object("receivers"));
    manifest.sketch = file_record(files.object("sketch"));
    if (manifest.mesh) {
        manifest.mesh->mesh = file_record(files.object("mesh"));
        manifest.mesh->brdfs = file_record(files.object("brdfs"));
        manifest.mesh->textures = file_record(files.object("textures"));
    }
    if (manifest.kind == Kind::image && parsed.contains("materials")) {
        manifest.materials = materials_section(top.object("materials"));
    }
    if (manifest.kind == Kind::mesh && parsed.contains("visibility")) {
        manifest.visibility = visibility_record(top.object("visibility"));
    }
    manifest.shards = shard_records(top, manifest.block_count(), file);
    manifest.camera = camera_record(top.object("camera"));
    if (parsed.contains("sampling_error")) {
        const ManifestReader error = top.object("sampling_error");
        manifest.sampling_error = {.natural = error.not_negative("natural"),
                                   .sun = error.not_negative("sun")};
    }
    manifest.bake = top.notes("bake");
    manifest.measured = top.notes("measured");
    return manifest;
}

Manifest read_manifest(const std::filesystem::path& path) {
    try {
        return manifest_from_text(files::read_regular_file(path, kMaxManifestBytes),
                                  path.string());
    } catch (const files::FileError& error) {
        throw TransportError(error.what());
    }
}

}  // namespace relume::transport
