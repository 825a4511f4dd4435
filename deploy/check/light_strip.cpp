// relume-light-strip: the light of a room's state as a picture, for programs that know
// nothing of rooms. What relume-bake relight makes of it is what relume-server must show.
#include "protocol/base/files/regular_file.h"
#include "protocol/base/program/program.h"
#include "protocol/light/environment_import.h"
#include "protocol/light/light_rig.h"
#include "protocol/wire/json_text.h"
#include "protocol/wire/room_state.h"

#include <CLI/CLI.hpp>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
namespace light = relume::light;
namespace wire = relume::wire;

constexpr std::size_t kMaxStateBytes = std::size_t{1} << 20;

struct Arguments {
    fs::path state;
    fs::path environments;
    std::uint32_t face_resolution = 64;
    fs::path output;
};

wire::RoomState read_state(const fs::path& path) {
    return wire::room_state_from_json(wire::parse_json(
        relume::files::read_regular_file(path, kMaxStateBytes), kMaxStateBytes));
}

std::shared_ptr<const light::PrefilteredEnvironment> find_environment(
    const Arguments& arguments, const std::string& name) {
    for (const char* extension : {".exr", ".hdr"}) {
        const fs::path file = arguments.environments / (name + extension);
        if (fs::exists(file)) {
            return std::make_shared<const light::PrefilteredEnvironment>(
                std::make_shared<const light::EnvironmentMap>(
                    light::import_environment(file).map),
                arguments.face_resolution);
        }
    }
    throw std::runtime_error(
        fmt::format("found no environment {0} in {1}, expected {0}.exr or "
                    "{0}.hdr",
                    name, arguments.environments.string()));
}

light::LightRig rig_from(const wire::RoomState& state, const Arguments& arguments) {
    light::LightRig rig;
    const bool solo = wire::any_solo(state.lights);
    rig.environment = find_environment(arguments, state.environment.name);
    if (state.blend.name) {
        rig.blend = find_environment(arguments, *state.blend.name);
        rig.blend_amount = static_cast<float>(state.blend.amount);
    }
    rig.rotation = Imath::Quatf(state.rotation.quaternion);
    rig.environment_scale =
        solo ? Imath::V3f(0) : Imath::V3f(state.environment.tint * state.environment.gain);
    for (const auto& [id, area] : state.lights) {
        if (!wire::lights_now(area, solo)) {
            continue;
        }
        rig.lights.push_back({.direction = Imath::V3f(area.direction),
                              .angular_radius_radians = static_cast<float>(
                                  area.angular_radius_degrees * std::numbers::pi / 180),
                              .radiance = Imath::V3f(area.radiance * area.tint * area.gain)});
    }
    return rig;
}

// The faces side by side in the order of protocol/README.md §1, 6n×n, float.
void write_strip(const light::LightCubemap& cubemap, const fs::path& path) {
    const std::size_t n = cubemap.face_resolution;
    std::vector<float> pixels(6 * n * n * 3);
    const auto planes = cubemap.planes();
    for (std::size_t texel = 0; texel < 6 * n * n; ++texel) {
        const std::size_t face = texel / (n * n);
        const std::size_t row = texel / n % n;
        const std::size_t column = texel % n;
        for (std::size_t c = 0; c < 3; ++c) {
            pixels[((row * 6 + face) * n + column) * 3 + c] = planes[c][texel];
        }
    }
    const auto side = static_cast<int>(n);
    const auto file = OIIO::ImageOutput::create(path.string());
    if (!file ||
        !file->open(path.string(), OIIO::ImageSpec(6 * side, side, 3, OIIO::TypeDesc::FLOAT)) ||
        !file->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) || !file->close()) {
        throw std::runtime_error(
            fmt::format("{}: {}", path.string(), file ? file->geterror() : OIIO::geterror()));
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Writes the light of a room's state as a cubemap strip of radiance.",
                 "relume-light-strip");
    Arguments arguments;
    app.add_option("--state", arguments.state,
                   "The state, as protocol/README.md §3.1 has it: a JSON file")
        ->required();
    app.add_option("--environments", arguments.environments, "Folder of .exr and .hdr files")
        ->required();
    app.add_option("--light-resolution", arguments.face_resolution,
                   "Texels along a face: that of the transport")
        ->capture_default_str();
    app.add_option("-o,--output", arguments.output, "EXR image to write")->required();
    return relume::program::run_program(app, argc, argv, [&] {
        light::LightCubemap cubemap(arguments.face_resolution);
        light::evaluate(rig_from(read_state(arguments.state), arguments),
                        arguments.face_resolution, cubemap);
        write_strip(cubemap, arguments.output);
        return relume::program::kDone;
    });
}
