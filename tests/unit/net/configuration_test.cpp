#include "server/net/configuration.h"

#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace relume::net {
namespace {

// A variable of the environment, for the length of a scope.
class ScopedVariable {
  public:
    ScopedVariable(std::string name, const std::string& value) : name_(std::move(name)) {
        setenv(name_.c_str(), value.c_str(), 1);
    }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;
    ~ScopedVariable() { unsetenv(name_.c_str()); }

  private:
    std::string name_;
};

class ConfigurationTest : public testing::Test {
  protected:
    CommandLine parse(std::vector<std::string> flags) {
        flags.insert(flags.begin(), {"relume-server", "--scenes", scratch_.path().string()});
        std::vector<const char*> arguments;
        for (const std::string& flag : flags) {
            arguments.push_back(flag.c_str());
        }
        return parse_command_line(arguments);
    }
    std::string write_file(const std::string& text) {
        const auto path = scratch_.path() / "server.toml";
        std::ofstream(path) << text;
        return path.string();
    }
    // What a mistake is answered with.
    std::string mistake(const std::vector<std::string>& flags) {
        try {
            parse(flags);
        } catch (const CommandLineExit& exit) {
            EXPECT_EQ(exit.code(), 2);
            return exit.what();
        }
        ADD_FAILURE() << "the mistake was taken";
        return {};
    }

    test::ScratchDirectory scratch_;
};

TEST_F(ConfigurationTest, DefaultsAreTheDocumentedLimits) {
    const Configuration c = parse({}).configuration;
    EXPECT_EQ(c.limits, wire::Limits{});
    EXPECT_EQ(c.listen, "127.0.0.1:8080");
    EXPECT_EQ(c.rooms.room.limits, c.limits);
}

TEST_F(ConfigurationTest, FlagsGoBeforeVariablesBeforeTheFile) {
    const std::string file = write_file("max-rooms = 3\nmax-lights = 4\nmax-clients = 5\n");
    const ScopedVariable lights("RELUME_MAX_LIGHTS", "14");
    const ScopedVariable clients("RELUME_MAX_CLIENTS", "15");
    const Configuration c = parse({"--config", file, "--max-clients", "25"}).configuration;
    EXPECT_EQ(c.limits.rooms, 3U);
    EXPECT_EQ(c.limits.lights_per_room, 14U);
    EXPECT_EQ(c.limits.clients_per_room, 25U);
    EXPECT_EQ(c.rooms.room.limits.clients_per_room, 25U);
}

TEST_F(ConfigurationTest, TheFileMayBeNamedByAVariable) {
    const ScopedVariable config("RELUME_CONFIG", write_file("settle-ms = 123\n"));
    EXPECT_EQ(parse({}).configuration.rooms.room.settle_delay, std::chrono::milliseconds(123));
}

TEST_F(ConfigurationTest, ListsComeFromTheFile) {
    const std::string file =
        write_file("allow-origin = [\"http://a.example\", \"http://b.example\"]\n");
    EXPECT_EQ(parse({"--config", file}).configuration.allow_origins,
              (std::vector<std::string>{"http://a.example", "http://b.example"}));
}

TEST_F(ConfigurationTest, TheExampleIsSound) {
    const Configuration c = parse({"--config", RELUME_EXAMPLE_CONFIGURATION}).configuration;
    EXPECT_EQ(c.log_level, "info");
    EXPECT_EQ(c.limits, wire::Limits{});
}

TEST_F(ConfigurationTest, MistakesNameTheOptionAndWhatWasExpected) {
    EXPECT_NE(mistake({"--max-rooms", "many"}).find("max-rooms"), std::string::npos);
    EXPECT_NE(mistake({"--max-rooms", "0"}).find("max-rooms"), std::string::npos);
    EXPECT_NE(mistake({"--no-such-flag"}).find("no-such-flag"), std::string::npos);
    EXPECT_NE(mistake({"--log-level", "loud"}).find("log-level"), std::string::npos);
    EXPECT_NE(mistake({"--web-root", "/no/such/folder"}).find("web-root"), std::string::npos);
    EXPECT_NE(mistake({"--config", "/no/such/file"}).find("/no/such/file"), std::string::npos);
    EXPECT_NE(mistake({"--config", write_file("no-such-key = 1\n")}).find("no-such-key"),
              std::string::npos);
    EXPECT_NE(mistake({"--config", write_file("max-rooms = 0\n")}).find("max-rooms"),
              std::string::npos);
}

// A pipe that nobody writes to would be waited for without end.
TEST_F(ConfigurationTest, TheFileIsARegularOneAndBounded) {
    const std::string pipe = write_file("") + ".pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_NE(mistake({"--config", pipe}).find("found a named pipe"), std::string::npos);
    EXPECT_NE(mistake({"--config", "/tmp"}).find("found a directory"), std::string::npos);
    EXPECT_NE(mistake({"--config", "/dev/zero"}).find("found a device"), std::string::npos);
    const std::string large = write_file("#" + std::string(std::size_t{2} << 20, '#') + "\n");
    EXPECT_NE(mistake({"--config", large}).find("at most"), std::string::npos);
}

TEST_F(ConfigurationTest, HelpAndVersionEndWell) {
    for (const char* const flag : {"--help", "--version"}) {
        try {
            parse({flag});
            FAIL() << flag << " went on";
        } catch (const CommandLineExit& exit) {
            EXPECT_EQ(exit.code(), 0);
            EXPECT_NE(std::string(exit.what()).find("relume-server"), std::string::npos);
        }
    }
}

TEST_F(ConfigurationTest, CheckingIsARequest) {
    EXPECT_EQ(parse({"--check-config"}).request, Request::check_configuration);
    EXPECT_EQ(parse({}).request, Request::serve);
}

}  // namespace
}  // namespace relume::net
