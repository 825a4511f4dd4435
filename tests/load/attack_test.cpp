// The delivered server under attack, beside somebody who works: each attack may cost the others
// something, but neither their sessions nor the server nor its memory.
#include "tests/load/honest_client.h"
#include "tests/support/program.h"
#include "tests/support/scratch_directory.h"
#include "tests/support/tiny_transport.h"
#include "tests/unit/net/raw_socket.h"
#include "tests/unit/net/waiting.h"
#include "tests/unit/net/websocket_client.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace relume::test {
namespace {

namespace fs = std::filesystem;
using net::RawSocket;
using net::WebSocketClient;
using nlohmann::json;

// All of 127.0.0.0/8 is this machine; who works comes from 127.0.0.1.
constexpr const char* kAttacker = "127.0.0.2";
// What a machine that runs other tests too may add to any latency.
constexpr double kNoiseMs = 250;
// What an attack may add to the server's memory: outboxes, rooms' images, a decoded upload.
constexpr std::uint64_t kAllowedBytes = std::uint64_t{512} << 20;

class AttackTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        scratch_ = std::make_unique<ScratchDirectory>();
        fs::create_directory(scenes());
        // Small for who works; and one whose whole product takes long.
        write_tiny_transport(scenes() / "work.relume", {.width = 64, .height = 48});
        write_tiny_transport(
            scenes() / "large.relume",
            {.width = 256, .height = 256, .signal_basis = basis::CubemapBasis::haar(16)});
    }
    static void TearDownTestSuite() { scratch_.reset(); }

    void SetUp() override {
        fs::remove(folder() / "port");
        server_ = std::make_unique<Program>(
            RELUME_SERVER,
            std::vector<std::string>{"--scenes", scenes().string(), "--listen", "127.0.0.1:0",
                                     "--port-file", (folder() / "port").string(),
                                     "--default-environment", "studio-softboxes"},
            folder(), "server");
        ASSERT_TRUE(net::eventually([] { return fs::exists(folder() / "port"); }));
        std::ifstream(folder() / "port") >> port_;
        ASSERT_TRUE(net::eventually(
            [this] { return net::http(port_, "GET", "/readyz").status == 200; }));
    }
    // Whatever was done to it, the server is there, and ends in good order.
    void TearDown() override {
        EXPECT_TRUE(server_->is_running());
        server_->send(SIGTERM);
        EXPECT_EQ(server_->wait(), 0);
    }

    // The same work without and with the attack, which goes on until it is told to stop.
    void expect_work_goes_on_beside(
        const std::function<void(const std::atomic<bool>&)>& attack) {
        const Work quiet = work_for_a_while(port_, folder());
        const std::uint64_t before = resident_bytes();
        std::atomic<bool> stop{false};
        Work attacked;
        std::uint64_t most = 0;
        {
            const std::jthread attacker = thread_of([&] { attack(stop); });
            const std::jthread watcher([&] {
                while (!stop) {
                    most = std::max(most, resident_bytes());
                    std::this_thread::sleep_for(std::chrono::milliseconds(20));
                }
            });
            try {
                attacked = work_for_a_while(port_, folder());
            } catch (const std::exception& failure) {
                ADD_FAILURE() << failure.what();
            }
            stop = true;
        }
        EXPECT_EQ(attacked.edits_shown, attacked.edits);
        EXPECT_GE(attacked.images, quiet.images / 2);
        EXPECT_LE(attacked.edit_to_image_ms_p99, 2 * quiet.edit_to_image_ms_p99 + kNoiseMs);
        EXPECT_LE(most, before + kAllowedBytes);
        RecordProperty("p99_quiet_ms", std::to_string(quiet.edit_to_image_ms_p99));
        RecordProperty("p99_attacked_ms", std::to_string(attacked.edit_to_image_ms_p99));
    }

    // What it throws fails the test.
    [[nodiscard]] static std::jthread thread_of(std::function<void()> work) {
        return std::jthread([work = std::move(work)] {
            try {
                work();
            } catch (const std::exception& failure) {
                ADD_FAILURE() << failure.what();
            }
        });
    }

    [[nodiscard]] std::uint64_t resident_bytes() const {
        std::ifstream file("/proc/" + std::to_string(server_->id()) + "/statm");
        std::uint64_t total = 0;
        std::uint64_t resident = 0;
        file >> total >> resident;
        return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    }

    static const fs::path& folder() { return scratch_->path(); }
    static fs::path scenes() { return folder() / "scenes"; }

    static std::unique_ptr<ScratchDirectory> scratch_;
    std::unique_ptr<Program> server_;
    std::uint16_t port_ = 0;
};

std::unique_ptr<ScratchDirectory> AttackTest::scratch_;

json edit(std::uint64_t id, const json& patch) {
    return {{"type", "edit"}, {"id", id}, {"patch", patch}};
}

// Nulls for lights that do not exist, and lights of ever new names, past one who does not read.
TEST_F(AttackTest, NamesWithoutEnd) {
    expect_work_goes_on_beside([this](const std::atomic<bool>& stop) {
        RawSocket sleeper(port_, 4096);
        sleeper.send(net::upgrade_request("/session/names?scene=work"));
        static_cast<void>(sleeper.receive_until("snapshot"));
        WebSocketClient author(port_, "/session/names?scene=work&images=settled");
        const json light{
            {"direction", {0, 1, 0}}, {"angular_radius_degrees", 5}, {"radiance", {1, 1, 1}}};
        for (std::uint64_t id = 1; !stop; ++id) {
            const std::string tag = std::to_string(id) + "-";
            json nothing = json::object();
            for (int i = 0; i < 2000; ++i) {
                nothing["never-there-" + tag + std::to_string(i)] = nullptr;
            }
            author.send(edit(id, {{"lights", nothing}}));
            for (const bool there : {true, false}) {
                json some = json::object();
                for (int i = 0; i < 30; ++i) {
                    some[tag + std::to_string(i)] = there ? light : json();
                }
                author.send(edit(id, {{"lights", some}}));
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
    });
}

// Whole products at thirty edits a second in four rooms.
TEST_F(AttackTest, BudgetsWithoutEnd) {
    expect_work_goes_on_beside([this](const std::atomic<bool>& stop) {
        std::vector<std::jthread> rooms;
        for (int room = 0; room < 4; ++room) {
            rooms.push_back(thread_of([this, room, &stop] {
                WebSocketClient client(
                    port_, "/session/greedy-" + std::to_string(room) + "?scene=large");
                client.send(
                    edit(1, {{"budget", {{"coefficients", 393216}}},
                             {"strategy", {{"method", room % 2 == 0 ? "nwa" : "bi"}}}}));
                for (std::uint64_t id = 2; !stop; ++id) {
                    client.send(edit(id, {{"rotation", {{"yaw_degrees", 7 * id % 360}}}}));
                    client.acknowledge(1'000'000);
                    std::this_thread::sleep_for(std::chrono::milliseconds(33));
                }
            }));
        }
    });
}

// A scene that is served is overwritten and cut short, as no careful program would.
TEST_F(AttackTest, FilesThatChangeUnderTheServer) {
    const fs::path victim = scenes() / "victim.relume";
    fs::copy(scenes() / "work.relume", victim, fs::copy_options::recursive);
    ASSERT_TRUE(net::eventually([this] {
        return net::http(port_, "GET", "/api/scenes").body.find("victim") != std::string::npos;
    }));
    WebSocketClient inside(port_, "/session/victim?scene=victim&images=settled");
    static_cast<void>(inside.receive_settled(0));
    expect_work_goes_on_beside([&](const std::atomic<bool>& stop) {
        for (std::uint64_t id = 1; !stop || id < 3; ++id) {
            for (const auto& entry : fs::recursive_directory_iterator(victim)) {
                if (entry.is_regular_file() && id % 2 == 1) {
                    std::fstream(entry.path(), std::ios::in | std::ios::out | std::ios::binary)
                        << std::string(entry.file_size(), '\xFF');
                } else if (entry.is_regular_file()) {
                    fs::resize_file(entry.path(), entry.file_size() / 2);
                }
            }
            inside.send(edit(id, {{"environment", {{"gain", 1 + id % 7}}}}));
            static_cast<void>(inside.receive_settled(id));
        }
    });
    fs::remove_all(victim);
}

// Sockets that ask for nothing, rooms that are held, uploads that trickle.
TEST_F(AttackTest, PlacesThatAreHeld) {
    expect_work_goes_on_beside([this](const std::atomic<bool>& stop) {
        std::vector<std::unique_ptr<RawSocket>> held;
        const auto hold = [&](const std::string& bytes) {
            held.push_back(std::make_unique<RawSocket>(port_, 4096, kAttacker));
            held.back()->send(bytes);
        };
        for (int i = 0; i < 64; ++i) {
            hold(net::upgrade_request("/session/held-" + std::to_string(i) + "?scene=work"));
        }
        std::vector<std::size_t> uploads;
        for (int i = 0; i < 8; ++i) {
            uploads.push_back(held.size());
            hold(
                "POST /api/environments?name=held HTTP/1.1\r\nHost: localhost\r\n"
                "Content-Length: 1000000\r\n\r\n");
        }
        for (int i = 0; i < 300; ++i) {
            hold(i % 2 == 0 ? "" : "GET / HTTP/1.1\r\nHost:");
        }
        while (!stop) {
            for (const std::size_t i : uploads) {
                held[i]->send("x");
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    });
}

// Images that say they are larger than they are, one after another.
TEST_F(AttackTest, UploadsThatAskForMemory) {
    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator(RELUME_HOSTILE_UPLOADS)) {
        std::ifstream file(entry.path(), std::ios::binary);
        files.emplace_back(std::istreambuf_iterator<char>(file),
                           std::istreambuf_iterator<char>());
    }
    ASSERT_FALSE(files.empty());
    expect_work_goes_on_beside([&](const std::atomic<bool>& stop) {
        for (std::size_t i = 0; !stop || i < files.size(); ++i) {
            const net::HttpAnswer answer = net::http(
                port_, "POST", "/api/environments?name=hostile", {}, files[i % files.size()]);
            EXPECT_EQ(answer.status, 422U) << i % files.size() << answer.body;
        }
    });
}

class ForgottenLogTest : public AttackTest {
  protected:
    // Its standard error is a pipe that nobody reads.
    void SetUp() override {
        const fs::path log = folder() / "server.err";
        fs::remove(log);
        ASSERT_EQ(mkfifo(log.c_str(), 0600), 0);
        forgotten_ = open(log.c_str(), O_RDWR | O_CLOEXEC);
        ASSERT_GE(forgotten_, 0);
        AttackTest::SetUp();
    }
    void TearDown() override {
        AttackTest::TearDown();
        close(forgotten_);
        fs::remove(folder() / "server.err");
    }

  private:
    int forgotten_ = -1;
};

TEST_F(ForgottenLogTest, LinesThatNobodyTakes) {
    expect_work_goes_on_beside([this](const std::atomic<bool>& stop) {
        // Far more than a pipe holds.
        for (int i = 0; !stop || i < 2000; ++i) {
            static_cast<void>(WebSocketClient(port_, "/session/r?scene=none").receive_close());
        }
    });
}

}  // namespace
}  // namespace relume::test
