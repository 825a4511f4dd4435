// The words relume-bake understands.
#pragma once

#include "precompute/bake/base/field_request.h"
#include "precompute/bake/base/parameters.h"
#include "precompute/bake/curves/edited_material.h"
#include "precompute/bake/curves/frozen_light.h"
#include "precompute/bake/material_command.h"

#include <CLI/App.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace relume::bake {

struct Arguments {
    // bake
    std::string scene;
    std::string builtin;
    std::string output;
    std::string size;
    std::string eye;
    std::string look_at;
    std::string up;
    std::optional<double> fov_degrees;
    std::string camera;
    bool list_cameras = false;
    std::string preview;
    std::optional<std::uint32_t> order;  // of spherical harmonics
    std::vector<std::string> measured;   // MATERIAL=FILE
    std::string factors;                 // of terms or of curves; empty: as usual
    BakeParameters parameters;
    std::optional<std::uint32_t> light_resolution;
    FieldRequest fields;
    // bake, of curves
    CurveRequest curves;
    LightRequest frozen_light;
    std::string rotate;
    // info, verify, relight
    std::string directory;
    bool json = false;
    std::string light;
    std::string image;
    MaterialArguments material;
};

// Without a subcommand relume-bake bakes a scene; `material`, `info`, `verify`, `relight` and
// `list` are the others.
void add_arguments(CLI::App& app, Arguments& arguments);

}  // namespace relume::bake
