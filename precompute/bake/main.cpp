// relume-bake: scene → transport directory; and what people ask about one.
#include "precompute/bake/base/error.h"
#include "precompute/bake/command_line.h"
#include "precompute/bake/commands.h"
#include "protocol/base/program/program.h"

#include <CLI/CLI.hpp>

#include <cstdio>

int main(int argc, char** argv) {
    namespace bake = relume::bake;
    CLI::App app("Bakes a scene's light transport for Relume.", "relume-bake");
    bake::Arguments arguments;
    bake::add_arguments(app, arguments);
    return relume::program::run_program(app, argc, argv, [&] {
        try {
            return bake::run_command(app, arguments);
        } catch (const bake::BakeInterrupted& stopped) {
            std::fprintf(stderr, "relume-bake: %s; the same command goes on from here\n",
                         stopped.what());
            constexpr int kInterrupted = 130;  // as shells say it of a program ended by Ctrl-C
            return kInterrupted;
        }
    });
}
