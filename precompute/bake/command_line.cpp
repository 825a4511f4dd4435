#include "precompute/bake/command_line.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>

#include <map>
#include <string>

namespace relume::bake {
namespace {

void add_curve_options(CLI::App& app, Arguments& arguments) {
    app.add_option(
           "--edit", arguments.curves.edits,
           "Bake curves in place of light: MATERIAL or MATERIAL.CURVE, a curve of its BRDF "
           "that people edit; several with commas")
        ->delimiter(',')
        ->take_all()
        ->allow_extra_args(false);
    app.add_option(
           "--model", arguments.curves.models,
           "BRDF of an edited material: MATERIAL=ggx, cook-torrance, ashikhmin-shirley or "
           "phong, with :PARAMETER=VALUE,…, a colour as r/g/b [the scene's]")
        ->take_all()
        ->allow_extra_args(false);
    app.add_option("--environment", arguments.frozen_light.environment,
                   "Light of a bake of curves: a map, HDR or EXR, or one made by formula, as "
                   "sky-noon");
    app.add_option(
        "--centre", arguments.frozen_light.centre,
        "Where the centre of the map looks: -z, +z, +x, -x, +y or -y; +x as in Blender "
        "and three.js [-z]");
    app.add_option("--rotate", arguments.rotate,
                   "Turn the environment: YAW,PITCH,ROLL in degrees [0,0,0]");
    app.add_option("--gain", arguments.frozen_light.gain, "Scale the environment")
        ->capture_default_str();
}

void add_field_options(CLI::App& app, Arguments& arguments) {
    app.add_option(
           "--editable", arguments.fields.editable,
           "Beside the light, store what the points of these materials see of it, so that "
           "people edit them under any light: MATERIAL; several with commas")
        ->delimiter(',')
        ->take_all()
        ->allow_extra_args(false);
    app.add_flag("--fields", arguments.fields.of_vertices,
                 "With --receivers vertices: beside the light, store what every vertex sees of "
                 "it");
    app.add_option("--visibility-resolution", arguments.fields.resolution,
                   "Texels along a face of the cubemap that points see: 4 to the light's, of "
                   "vertices to 256 [the light's]");
}

void add_bake_options(CLI::App& app, Arguments& arguments) {
    using Kind = basis::CubemapBasis::Kind;
    const std::map<std::string, Kind> kinds{{"haar", Kind::haar},
                                            {"sh", Kind::spherical_harmonics}};
    const std::map<std::string, scene::UpAxis> up_axes{{"y", scene::UpAxis::y},
                                                       {"z", scene::UpAxis::z}};
    const std::map<std::string, ReceiverKind> kinds_of_receivers{
        {"pixels", ReceiverKind::pixels}, {"vertices", ReceiverKind::vertices}};
    BakeParameters& p = arguments.parameters;
    auto* scene =
        app.add_option("scene", arguments.scene, "glTF 2.0, GLB, OBJ or PLY file to bake");
    app.add_option("--builtin", arguments.builtin,
                   "Bake a scene made by code instead; `relume-bake list` names them")
        ->excludes(scene);
    app.add_option("-o,--output", arguments.output, "Transport directory, NAME.relume");
    app.add_option("--camera", arguments.camera,
                   "Camera of the scene file: its name, node path or index [the first; in a "
                   "file without cameras, one that frames the scene]");
    app.add_flag("--list-cameras", arguments.list_cameras, "Name the scene's cameras and end");
    app.add_option("--preview", arguments.preview,
                   "Write a PNG of what the image will show, and end without baking");
    app.add_option("--up-axis", p.up_axis,
                   "What is up in the scene file: y or z; z turns scene and camera [y]")
        ->transform(CLI::CheckedTransformer(up_axes).description(""));
    app.add_option("--eye", arguments.eye, "Where the camera stands: X,Y,Z");
    app.add_option("--look-at", arguments.look_at, "What it looks at: X,Y,Z");
    app.add_option("--up", arguments.up, "What is up for it: X,Y,Z");
    app.add_option("--fov", arguments.fov_degrees, "Vertical field of view in degrees [40]");
    app.add_option("--size", arguments.size, "Image size in pixels: WxH [512x512]");
    app.add_option("--light-resolution", arguments.light_resolution,
                   "Texels along a face of the lighting cubemap, 4 to 256 [64; of curves 128]");
    app.add_option("--basis", p.basis,
                   "What the columns of the transport stand for: haar wavelets or sh, "
                   "spherical harmonics [haar]")
        ->transform(CLI::CheckedTransformer(kinds).description(""));
    app.add_option("--order", arguments.order,
                   "Of spherical harmonics: order² columns, 1 to 20 [10]");
    app.add_option("--bounces", p.bounces,
                   "Reflections after the first surface; 0: direct light only")
        ->capture_default_str();
    app.add_option("--samples", p.samples, "Paths per pixel for indirect light")
        ->capture_default_str();
    app.add_option("--bits", p.bits, "Precision of stored values: 6, 7 or 8")
        ->capture_default_str();
    app.add_option("--pixel-samples", p.pixel_samples,
                   "Camera positions per pixel; edges get eight times as many")
        ->capture_default_str();
    app.add_option("--edge-samples", p.edge_samples,
                   "More visibility rays per light texel at shadow edges")
        ->capture_default_str();
    app.add_option("--pool", p.pool_radius,
                   "Radius in pixels within which paths are shared; 0: not at all")
        ->capture_default_str();
    app.add_option("--shrinkage", p.shrinkage,
                   "Standard errors that a group of indirect coefficients must pass")
        ->capture_default_str();
    app.add_option("--receivers", p.receivers,
                   "What the bake is of: pixels of one image, or vertices of the surface, for "
                   "cameras that move [pixels]")
        ->transform(CLI::CheckedTransformer(kinds_of_receivers).description(""));
    app.add_option("--vertices", p.vertices, "Of the refined surface, at most")
        ->capture_default_str();
    app.add_option("--target-error", p.target_error,
                   "Relative L2 asked of light between vertices and of every material's terms")
        ->capture_default_str();
    app.add_option("--terms", p.terms,
                   "Of every material's BRDF, 1 to 10; 0: as few as meet the target error")
        ->capture_default_str();
    app.add_option("--factors", arguments.factors,
                   "How BRDFs are factored: into terms by svd, or by nmf, in which nothing is "
                   "negative [svd]; measured ones into curves by homomorphic, least squares of "
                   "logarithms, or by nmf [homomorphic]");
    app.add_option("--measured", arguments.measured,
                   "MATERIAL=FILE: the material reflects as was measured, by a .binary file of "
                   "the MERL database; may be given again")
        ->take_all()
        ->allow_extra_args(false);
    add_field_options(app, arguments);
    add_curve_options(app, arguments);
    app.add_option("--threads", p.threads, "Threads; 0: one per core")->capture_default_str();
    app.add_option("--seed", p.seed, "Chooses all random numbers")->capture_default_str();
}

}  // namespace

void add_arguments(CLI::App& app, Arguments& arguments) {
    app.require_subcommand(0, 1);
    add_bake_options(app, arguments);
    add_material_command(app, arguments.material);
    auto* info =
        app.add_subcommand("info", "Say what a transport directory or a material holds");
    info->add_option("directory", arguments.directory,
                     "Transport directory, or file of a material")
        ->required();
    info->add_flag("--json", arguments.json, "As JSON, with everything that was measured");
    auto* verify =
        app.add_subcommand("verify", "Check every byte of a transport directory or a material");
    verify
        ->add_option("directory", arguments.directory,
                     "Transport directory, or file of a material")
        ->required();
    auto* relight =
        app.add_subcommand("relight", "Compute the dense product of transport and light");
    relight->add_option("directory", arguments.directory, "Transport directory")->required();
    relight
        ->add_option("--light", arguments.light,
                     "Cubemap strip of radiance, 6n×n, of the transport's resolution")
        ->required();
    relight->add_option("-o,--output", arguments.image, "EXR image to write")->required();
    app.add_subcommand("list", "Name the built-in scenes");
}

}  // namespace relume::bake
