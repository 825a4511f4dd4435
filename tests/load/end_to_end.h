// Two small scenes baked once and served anew for every test, and the client to look at them.
#pragma once

#include "tests/load/pixels.h"
#include "tests/support/program.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace relume::test {

inline constexpr std::chrono::milliseconds kPoll{20};

struct Answer {
    int exit_code;
    std::string output;
    std::string errors;
};

class EndToEnd : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        scratch_ = std::make_unique<ScratchDirectory>();
        std::filesystem::create_directory(folder() / "scenes");
        std::filesystem::create_directory(folder() / "environments");
        bake("box", {});
        bake("box-sh", {"--basis", "sh", "--order", "10"});
        write_environment(folder() / "sun.hdr");
    }
    static void TearDownTestSuite() { scratch_.reset(); }

    void SetUp() override {
        const std::filesystem::path port_file = folder() / "port";
        std::filesystem::remove(port_file);
        server_ = std::make_unique<Program>(
            RELUME_SERVER,
            std::vector<std::string>{"--scenes", (folder() / "scenes").string(),
                                     "--environments", (folder() / "environments").string(),
                                     "--listen", "127.0.0.1:0", "--port-file",
                                     port_file.string()},
            folder(), "server");
        while (!std::filesystem::exists(port_file)) {
            ASSERT_TRUE(server_->is_running()) << server_->errors() << server_->output();
            std::this_thread::sleep_for(kPoll);
        }
        std::ifstream(port_file) >> port_;
        while (run({"info"}).output.find("ready                   true") == std::string::npos) {
            ASSERT_TRUE(server_->is_running()) << server_->errors() << server_->output();
            std::this_thread::sleep_for(kPoll);
        }
    }

    // Whatever a test did to it, the server ends in good order.
    void TearDown() override {
        server_->send(SIGTERM);
        EXPECT_EQ(server_->wait(), 0) << server_->errors() << server_->output();
    }

    // The built-in box into the folder that is served.
    static void bake(const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"--builtin",
                                           "box",
                                           "--size",
                                           "72x40",
                                           "--light-resolution",
                                           "8",
                                           "--bounces",
                                           "1",
                                           "--samples",
                                           "8",
                                           "-o",
                                           (folder() / "scenes" / (name + ".relume")).string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        static_cast<void>(run_to_end(RELUME_BAKE, arguments, folder(), "bake"));
    }

    static const std::filesystem::path& folder() { return scratch_->path(); }
    static std::string in_folder(const char* name) { return (folder() / name).string(); }

    [[nodiscard]] std::vector<std::string> with_server(
        std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"--server", "127.0.0.1:" + port_});
        return arguments;
    }
    [[nodiscard]] Answer run(const std::vector<std::string>& arguments) const {
        Program client(RELUME_CLIENT, with_server(arguments), folder(), "client");
        const int exit_code = client.wait();
        return {exit_code, client.output(), client.errors()};
    }
    // Renders to a linear image and returns what `--json` says; the run must succeed.
    [[nodiscard]] nlohmann::json render(std::vector<std::string> arguments,
                                        const char* file) const {
        arguments.insert(arguments.begin(), {"render", "--json", "-o", in_folder(file)});
        const Answer answer = run(arguments);
        if (answer.exit_code != 0) {
            throw std::runtime_error(answer.errors);
        }
        return nlohmann::json::parse(answer.output);
    }

    Program& server() { return *server_; }

  private:
    static inline std::unique_ptr<ScratchDirectory> scratch_;
    std::unique_ptr<Program> server_;
    std::string port_;
};

}  // namespace relume::test
