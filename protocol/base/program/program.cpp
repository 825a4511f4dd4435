#include "protocol/base/program/program.h"

#include "protocol/base/files/disk_room.h"
#include "protocol/base/files/standard_output.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <exception>
#include <string>

namespace relume::program {
namespace {

void complain(const CLI::App& app, const std::string& message) {
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), message.c_str());
}

int parse_and_work(CLI::App& app,
                   int argc,
                   const char* const* argv,
                   const std::function<int()>& work) {
    try {
        app.parse(argc, argv);
        return work();
    } catch (const CLI::ParseError& mistake) {
        if (mistake.get_exit_code() == 0) {
            return app.exit(mistake);  // --help, --version
        }
        complain(app, text_from_mistake(app, mistake) + "; --help names what there is");
        return kWrongUsage;
    } catch (const UsageError& mistake) {
        complain(app, mistake.what());
        return kWrongUsage;
    } catch (const std::exception& failure) {
        complain(app, failure.what());
        return kFailed;
    }
}

}  // namespace

int run_program(CLI::App& app,
                int argc,
                const char* const* argv,
                const std::function<int()>& work) {
    files::make_file_size_limit_an_error();
    const int code = parse_and_work(app, argc, argv, work);
    try {
        files::flush_standard_output();
    } catch (const std::exception& failure) {
        complain(app, failure.what());
        return code == kDone ? kFailed : code;
    }
    return code;
}

}  // namespace relume::program
