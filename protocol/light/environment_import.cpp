#include "protocol/light/environment_import.h"

#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/light/environment_error.h"
#include "protocol/light/file_signature.h"
#include "protocol/light/image_file.h"
#include "protocol/light/texel_repair.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <string>
#include <utility>

namespace relume::light {

void refuse_image(std::string_view what, std::string found, std::string expected) {
    const std::string message = fmt::format("{} is {}, expected {}", what, found, expected);
    throw EnvironmentError(message, std::move(found), std::move(expected));
}

void refuse_incomplete(std::string where) {
    const std::string message =
        fmt::format("image ends {}: the file is incomplete, copy it again", where);
    throw EnvironmentError(message, "an incomplete file, which ends " + where,
                           "a whole one: copy it again");
}

void check_size(std::size_t width, std::size_t height, const ImageBounds& bounds) {
    const std::size_t most = std::min(bounds.max_texels, kMaxMapTexels);
    if (width == 0 || height == 0 || width > kMaxMapSide || height > kMaxMapSide ||
        width * height > most) {
        refuse_image("image", fmt::format("{}x{}", width, height),
                     fmt::format("at most {} texels a side and {} in all", kMaxMapSide, most));
    }
}

namespace {

constexpr std::size_t kMaxLocalFileBytes = std::size_t{2} << 30;
constexpr std::size_t kMaxHeaderBytes = std::size_t{4} << 20;

Projection choose_projection(std::uint32_t width,
                             std::uint32_t height,
                             std::optional<Projection> given) {
    const std::string found = fmt::format("{}x{}", width, height);
    if (given) {
        if (!accepts_shape(*given, width, height)) {
            refuse_image("image", found, describe_shape(*given));
        }
        return *given;
    }
    const std::optional<Projection> detected = detect_projection(width, height);
    if (!detected) {
        refuse_image(
            "image", found,
            fmt::format(
                "{}, {}, {}, {} or {}; or projection lat_long given, which may have any "
                "shape",
                describe_shape(Projection::lat_long),
                describe_shape(Projection::vertical_cross),
                describe_shape(Projection::horizontal_cross),
                describe_shape(Projection::angular_map),
                describe_shape(Projection::cubemap_strip)));
    }
    return *detected;
}

void convert_colours(ImageFile& file) {
    if (!file.is_xyz && is_rec709(file.primaries)) {
        return;
    }
    const Imath::M33d matrix =
        file.is_xyz ? rec709_from_xyz() : rec709_from(file.primaries).value();
    std::vector<float>& rgb = file.image.rgb;
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
        const Imath::V3d colour =
            product(matrix, {double{rgb[i]}, double{rgb[i + 1]}, double{rgb[i + 2]}});
        rgb[i] = static_cast<float>(colour.x);
        rgb[i + 1] = static_cast<float>(colour.y);
        rgb[i + 2] = static_cast<float>(colour.z);
    }
    const Primaries& p = file.primaries;
    file.warnings.push_back(
        file.is_xyz
            ? std::string("CIE XYZ converted to Rec. 709")
            : fmt::format("colours of primaries ({:.4g}, {:.4g}), ({:.4g}, {:.4g}), ({:.4g}, "
                          "{:.4g}) and white ({:.4g}, {:.4g}) converted to Rec. 709",
                          p.red.x, p.red.y, p.green.x, p.green.y, p.blue.x, p.blue.y, p.white.x,
                          p.white.y));
}

void append(std::vector<std::string>& to, std::vector<std::string> more) {
    std::move(more.begin(), more.end(), std::back_inserter(to));
}

// What `read` makes of the file; errors name it.
template <typename Read>
auto with_file(const std::filesystem::path& file, Read read) {
    try {
        return read();
    } catch (const files::FileError& e) {
        throw EnvironmentError(e.what());
    } catch (const EnvironmentError& e) {
        throw EnvironmentError(fmt::format("{}: {}", file.string(), e.what()), e.found(),
                               e.expected());
    }
}

}  // namespace

ImportedImage import_image(std::span<const std::byte> file_bytes,
                           const ImportOptions& options) {
    const ImageBounds bounds{.max_texels = options.max_texels};
    const ImageFormat format = require_image_format(file_bytes);
    if (format == ImageFormat::radiance_hdr && !options.layer.empty()) {
        refuse_image("layer", options.layer, "none, as a Radiance HDR file has no layers");
    }
    ImageFile file = format == ImageFormat::radiance_hdr
                         ? read_radiance_hdr(file_bytes, bounds)
                         : read_exr(file_bytes, options.layer, bounds);
    ImportedImage result;
    result.projection =
        choose_projection(file.image.width, file.image.height, options.projection);
    // Infinities first: a matrix would spread them over all colours.
    append(file.warnings, replace_non_finite(file.image));
    convert_colours(file);
    append(file.warnings, limit_texels(file.image));
    if (result.projection == Projection::angular_map && !options.projection) {
        file.warnings.push_back(
            fmt::format("{}x{} is square and was taken for an angular map; projection lat_long "
                        "takes it for a lat-long map",
                        file.image.width, file.image.height));
    }
    result.image = std::move(file.image);
    result.notes = {std::move(file.layer), std::move(file.layers), std::move(file.warnings)};
    return result;
}

ImportedEnvironment import_environment(std::span<const std::byte> file_bytes,
                                       const ImportOptions& options) {
    ImportedImage imported = import_image(file_bytes, options);
    return {EnvironmentMap(std::move(imported.image), imported.projection, options.centre),
            std::move(imported.notes)};
}

ImportedEnvironment import_environment(const std::filesystem::path& file,
                                       const ImportOptions& options) {
    return with_file(file, [&] {
        const std::string bytes = files::read_regular_file(file, kMaxLocalFileBytes);
        return import_environment(std::as_bytes(std::span(bytes)), options);
    });
}

EnvironmentHeader read_environment_header(const std::filesystem::path& file,
                                          const ImportOptions& options) {
    return with_file(file, [&] {
        const std::string beginning = files::read_beginning(file, kMaxHeaderBytes);
        const auto bytes = std::as_bytes(std::span(beginning));
        const ImageSize size = require_image_format(bytes) == ImageFormat::radiance_hdr
                                   ? radiance_hdr_size(bytes)
                                   : exr_size(bytes, options.layer);
        check_size(size.width, size.height, {});
        return EnvironmentHeader{
            size.width, size.height,
            choose_projection(size.width, size.height, options.projection)};
    });
}

}  // namespace relume::light
