// relume-server as a process.
#include "tests/support/scratch_directory.h"
#include "tests/unit/net/hdr_file.h"
#include "tests/unit/net/raw_socket.h"
#include "tests/unit/net/tiny_scenes.h"
#include "tests/unit/net/waiting.h"
#include "tests/unit/net/websocket_client.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace relume::net {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

// Output of both kinds goes to a file.
class Process {
  public:
    Process(const std::vector<std::string>& flags, const fs::path& log) {
        std::vector<std::string> arguments{RELUME_SERVER};
        arguments.insert(arguments.end(), flags.begin(), flags.end());
        std::vector<char*> pointers;
        for (std::string& argument : arguments) {
            pointers.push_back(argument.data());
        }
        pointers.push_back(nullptr);
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                         0600);
        posix_spawn_file_actions_adddup2(&actions, 1, 2);
        EXPECT_EQ(
            posix_spawn(&pid_, RELUME_SERVER, &actions, nullptr, pointers.data(), environ), 0);
        posix_spawn_file_actions_destroy(&actions);
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
    ~Process() {
        if (pid_ > 0) {
            kill(pid_, SIGKILL);
            waitpid(pid_, nullptr, 0);
        }
    }

    void signal(int number) const { kill(pid_, number); }
    // Its exit code, or -1 if it did not end by itself.
    int wait() {
        int status = 0;
        waitpid(pid_, &status, 0);
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

  private:
    pid_t pid_ = -1;
};

class ProgramTest : public testing::Test {
  protected:
    [[nodiscard]] std::vector<std::string> flags() const {
        return {"--scenes",
                scenes_.path().string(),
                "--environments",
                environments_.path().string(),
                "--default-environment",
                "small",
                "--listen",
                "127.0.0.1:0",
                "--port-file",
                port_file().string()};
    }
    [[nodiscard]] fs::path port_file() const { return scenes_.path() / "port"; }
    [[nodiscard]] fs::path log() const { return scenes_.path() / "log"; }
    std::uint16_t wait_until_ready() {
        EXPECT_TRUE(eventually([&] { return fs::exists(port_file()); }));
        const auto port = static_cast<std::uint16_t>(std::stoul(text_of(port_file())));
        EXPECT_TRUE(eventually([&] { return http(port, "GET", "/readyz").status == 200; }));
        return port;
    }
    int run(std::vector<std::string> more) {
        std::vector<std::string> all = flags();
        all.insert(all.end(), more.begin(), more.end());
        return Process(all, log()).wait();
    }

    void SetUp() override { write_hdr(environments_.path() / "small.hdr", 16, 8, 0.5F); }

    TinyScenes scenes_;
    test::ScratchDirectory environments_;
};

TEST_F(ProgramTest, TermDrainsAndEndsWell) {
    for (const int signal : {SIGTERM, SIGINT}) {
        fs::remove(port_file());
        Process server(flags(), log());
        const std::uint16_t port = wait_until_ready();
        WebSocketClient client(port, "/session/r?scene=tiny");
        static_cast<void>(client.receive_message("snapshot"));
        server.signal(signal);
        EXPECT_EQ(client.receive_close(), 1001U);
        EXPECT_EQ(server.wait(), 0);
        const std::string lines = text_of(log());
        EXPECT_NE(lines.find("event=listening address=127.0.0.1 port=" + std::to_string(port)),
                  std::string::npos)
            << lines;
        EXPECT_NE(lines.find("event=drained"), std::string::npos) << lines;
    }
}

TEST_F(ProgramTest, AClientThatIsDeafDoesNotHoldUpTheEnd) {
    std::vector<std::string> all = flags();
    all.insert(all.end(), {"--drain-ms", "300"});
    Process server(all, log());
    const std::uint16_t port = wait_until_ready();
    RawSocket deaf(port);
    deaf.send(upgrade_request("/session/r?scene=tiny"));
    EXPECT_TRUE(deaf.receive_until("\r\n\r\n").starts_with("HTTP/1.1 101 "));
    server.signal(SIGTERM);
    EXPECT_EQ(server.wait(), 0);
}

// As browsers keep them.
TEST_F(ProgramTest, ConnectionsBetweenRequestsDoNotHoldUpTheEnd) {
    std::vector<std::string> all = flags();
    all.insert(all.end(), {"--drain-ms", "2000"});
    Process server(all, log());
    const std::uint16_t port = wait_until_ready();
    RawSocket answered(port);
    answered.send("GET /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
    EXPECT_TRUE(answered.receive_until("\r\n\r\n").starts_with("HTTP/1.1 200 "));
    RawSocket silent(port);
    // Both are being served: what comes later is answered.
    EXPECT_EQ(http(port, "GET", "/healthz").status, 200);
    server.signal(SIGTERM);
    EXPECT_EQ(server.wait(), 0);
    const std::string lines = text_of(log());
    EXPECT_NE(lines.find("connections_cut=0"), std::string::npos) << lines;
}

// Standard error is a pipe that its reader has forgotten.
TEST_F(ProgramTest, ALogThatNobodyReadsHoldsNothingUp) {
    ASSERT_EQ(mkfifo(log().c_str(), 0600), 0);
    const int forgotten = open(log().c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_GE(forgotten, 0);
    ASSERT_GT(fcntl(forgotten, F_SETPIPE_SZ, 4096), 0);
    {
        Process server(flags(), log());
        const std::uint16_t port = wait_until_ready();
        // More lines than pipe and queue hold.
        const std::string dropped = "\nrelume_log_lines_dropped 0\n";
        for (int i = 0; i < 40; ++i) {
            WebSocketClient client(port, "/session/r?scene=tiny");
            static_cast<void>(client.receive_message("snapshot"));
        }
        EXPECT_NE(http(port, "GET", "/metrics").body.find(dropped), std::string::npos);
        EXPECT_TRUE(eventually([&] {
            for (int i = 0; i < 100; ++i) {
                static_cast<void>(
                    WebSocketClient(port, "/session/" + std::string(64, 'r') + "?scene=none")
                        .receive_close());
            }
            return http(port, "GET", "/metrics").body.find(dropped) == std::string::npos;
        }));
        WebSocketClient client(port, "/session/after?scene=tiny&images=settled");
        EXPECT_TRUE(client.receive_settled(0).image_header().exact);
        server.signal(SIGTERM);
        EXPECT_EQ(server.wait(), 0);
    }
    close(forgotten);
}

TEST_F(ProgramTest, HangUpLooksForScenes) {
    std::vector<std::string> all = flags();
    all.insert(all.end(), {"--scenes-interval-ms", "0"});
    Process server(all, log());
    const std::uint16_t port = wait_until_ready();
    fs::copy(scenes_.path() / "tiny.relume", scenes_.path() / "more.relume",
             fs::copy_options::recursive);
    server.signal(SIGHUP);
    EXPECT_TRUE(eventually([&] {
        return http(port, "GET", "/api/scenes").body.find("\"more\"") != std::string::npos;
    }));
    server.signal(SIGTERM);
    EXPECT_EQ(server.wait(), 0);
}

TEST_F(ProgramTest, HangUpLooksForEnvironments) {
    std::vector<std::string> all = flags();
    all.insert(all.end(), {"--scenes-interval-ms", "0"});
    Process server(all, log());
    const std::uint16_t port = wait_until_ready();
    const auto listed = [port] { return http(port, "GET", "/api/environments").body; };
    EXPECT_EQ(listed().find("\"late\""), std::string::npos);
    write_hdr(environments_.path() / "late.hdr", 16, 8, 1);
    server.signal(SIGHUP);
    EXPECT_TRUE(eventually([&] { return listed().find("\"late\"") != std::string::npos; }));
    fs::remove(environments_.path() / "late.hdr");
    server.signal(SIGHUP);
    EXPECT_TRUE(eventually([&] { return listed().find("\"late\"") == std::string::npos; }));
    server.signal(SIGTERM);
    EXPECT_EQ(server.wait(), 0);
}

// A decoder that never answers: it would be ended after half a minute, for want of time.
TEST_F(ProgramTest, ADecodeEndsWithItsClient) {
    std::vector<std::string> all = flags();
    all.insert(all.end(), {"--decoder", RELUME_MISBEHAVING_DECODER});
    Process server(all, log());
    const std::uint16_t port = wait_until_ready();
    const std::string next_request = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
    for (const auto& [name, sent_meanwhile] :
         {std::pair("silent", std::string()), std::pair("eager", next_request)}) {
        {
            RawSocket client(port);
            client.send("POST /api/environments?name=" + std::string(name) +
                        " HTTP/1.1\r\nHost: localhost\r\nContent-Length: 4\r\n\r\nhang");
            client.send(sent_meanwhile);
            // So that it has begun.
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
        }
        const std::string refused = "upload_refused name=" + std::string(name);
        EXPECT_TRUE(
            eventually([&] { return text_of(log()).find(refused) != std::string::npos; }));
        const std::string lines = text_of(log());
        EXPECT_NE(lines.find("nobody waits for the answer", lines.find(refused)),
                  std::string::npos)
            << lines;
    }
    server.signal(SIGTERM);
    EXPECT_EQ(server.wait(), 0);
}

// A thousand scenes, to be opened one after another.
TEST_F(ProgramTest, TheEndDoesNotWaitForScenesThatAreBeingOpened) {
    const fs::path many = environments_.path() / "many";
    fs::create_directory(many);
    for (int i = 0; i < 1000; ++i) {
        fs::create_directory_symlink(scenes_.path() / "tiny.relume",
                                     many / (std::to_string(i) + ".relume"));
    }
    std::vector<std::string> all = flags();
    all[1] = many.string();
    Process server(all, log());
    EXPECT_TRUE(eventually([&] { return fs::exists(port_file()); }));
    server.signal(SIGTERM);
    EXPECT_EQ(server.wait(), 0);
    const std::string lines = text_of(log());
    EXPECT_NE(lines.find("event=drained"), std::string::npos) << lines;
    EXPECT_EQ(lines.find("event=ready"), std::string::npos) << "it has opened them all";
}

TEST_F(ProgramTest, AnAddressInUseIsNamed) {
    Process server(flags(), log());
    const std::string port = std::to_string(wait_until_ready());
    const fs::path other_log = scenes_.path() / "other-log";
    Process second({"--scenes", scenes_.path().string(), "--environments",
                    environments_.path().string(), "--listen", "127.0.0.1:" + port},
                   other_log);
    EXPECT_EQ(second.wait(), 1);
    EXPECT_NE(text_of(other_log).find("cannot listen on 127.0.0.1:" + port), std::string::npos)
        << text_of(other_log);
}

TEST_F(ProgramTest, CheckConfigSaysWhetherItIsSound) {
    EXPECT_EQ(run({"--check-config"}), 0);
    Process misnamed({"--check-config", "--scenes", scenes_.path().string(), "--environments",
                      environments_.path().string(), "--default-environment", "none"},
                     log());
    EXPECT_EQ(misnamed.wait(), 1);
    EXPECT_NE(text_of(log()).find("default-environment"), std::string::npos);
    EXPECT_EQ(run({"--check-config", "--decoder", "/no/such/decoder"}), 1);
    EXPECT_NE(text_of(log()).find("/no/such/decoder"), std::string::npos);
    EXPECT_EQ(run({"--check-config", "--decoder", "/bin/true"}), 1);
    EXPECT_EQ(run({"--check-config", "--web-root", scenes_.path().string()}), 1);
    EXPECT_NE(text_of(log()).find("index.html"), std::string::npos);
    fs::remove(scenes_.path() / "tiny.relume/manifest.json");
    EXPECT_EQ(run({"--check-config"}), 1);
    EXPECT_NE(text_of(log()).find("manifest.json"), std::string::npos);
}

TEST_F(ProgramTest, MistakesOnTheCommandLineEndWithTwo) {
    EXPECT_EQ(run({"--no-such-flag"}), 2);
    EXPECT_NE(text_of(log()).find("no-such-flag"), std::string::npos);
    EXPECT_EQ(run({"--version"}), 0);
    Process nowhere({"--scenes", scenes_.path().string(), "--listen", "nowhere"}, log());
    EXPECT_EQ(nowhere.wait(), 1);
    EXPECT_NE(text_of(log()).find("HOST:PORT"), std::string::npos);
}

}  // namespace
}  // namespace relume::net
