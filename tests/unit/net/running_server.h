// A server in this process on a free port, serving the scene "tiny" under the environment
// "small".
#pragma once

#include "server/net/base/metrics.h"
#include "server/net/server.h"
#include "tests/unit/net/hdr_file.h"
#include "tests/unit/net/tiny_scenes.h"
#include "tests/unit/net/waiting.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace relume::net {

class RunningServer : public testing::Test {
  protected:
    RunningServer() {
        configuration_.scenes = scenes_.path();
        configuration_.listen = "127.0.0.1:0";
        configuration_.decoder = RELUME_DECODE;
        configuration_.environments = environments_.path();
        configuration_.rooms.environment = "small";
        write_hdr(environments_.path() / "small.hdr", 16, 8, 0.5F);
        configuration_.rooms.room.settle_delay = std::chrono::milliseconds(5);
    }
    // Limits count for rooms as for connections.
    void start() {
        configuration_.rooms.room.limits = configuration_.limits;
        server_ = std::make_unique<Server>(configuration_);
        server_->wait_until_started();
    }
    [[nodiscard]] std::uint16_t port() const { return server_->port(); }
    [[nodiscard]] bool metrics_say(const std::string& line) const {
        return server_->metrics().text().find(line + "\n") != std::string::npos;
    }
    // Whatever has happened: a newcomer is let in and gets his image.
    void expect_serves_on();

    TinyScenes scenes_;
    test::ScratchDirectory environments_;
    Configuration configuration_;
    std::unique_ptr<Server> server_;
};

}  // namespace relume::net
