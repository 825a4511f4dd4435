// Environments that clients send.
#pragma once

#include "protocol/light/environment_import.h"
#include "server/decoder/sandboxed_decoder.h"
#include "server/net/http/access.h"
#include "server/net/http/http_message.h"
#include "server/net/library/environment_library.h"
#include "server/net/peers/address_quota.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <variant>

namespace relume::net {

// One upload that has been let in; holds a place among the concurrent ones as long as it lives.
struct Upload {
    std::string name;
    light::ImportOptions options;
    std::shared_ptr<void> place;
    AddressQuota::Place place_of_address;
};

struct UploadOptions {
    std::uint64_t file_bytes = 0;
    std::uint64_t texels = 0;
    std::size_t concurrent = 0;
    std::size_t per_address = 0;     // of the concurrent ones
    std::uint64_t memory_bytes = 0;  // of all uploads, decoded; a decoder gets as much
    std::filesystem::path decoder;   // relume-decode; empty: beside the running program
};

// Thread-safe.
class Uploads {
  public:
    Uploads(EnvironmentLibrary& library, const Access& access, UploadOptions options)
        : library_(library),
          access_(access),
          options_(std::move(options)),
          by_address_(options_.per_address) {}

    // Everything that can be said before the body is read: a refusal, or a place.
    [[nodiscard]] std::variant<HttpReply, Upload> admit(const HttpRequest& request);
    // Decodes in a child process, and offers the environment under its name. Takes seconds: not
    // for threads that serve sockets. `stop` ends the decoder, when nobody waits for it any
    // more.
    [[nodiscard]] HttpReply finish(const Upload& upload,
                                   std::span<const std::byte> body,
                                   std::stop_token stop = {});
    // Ends all decoders, and at once those that begin later; from any thread.
    void stop() { stop_.request_stop(); }

  private:
    [[nodiscard]] decoder::DecodeLimits decode_limits(std::stop_token stop) const;

    EnvironmentLibrary& library_;
    const Access& access_;
    const UploadOptions options_;
    AddressQuota by_address_;
    std::stop_source stop_;
    // Shared with the places, which may outlive this.
    const std::shared_ptr<std::atomic<std::size_t>> in_progress_ =
        std::make_shared<std::atomic<std::size_t>>(0);
};

}  // namespace relume::net
