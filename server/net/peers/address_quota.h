// What clients of one address may hold of a thing that all share, so that one cannot lock the
// others out.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace relume::net {

// Thread-safe. Holds an entry per address that holds anything.
class AddressQuota {
  public:
    explicit AddressQuota(std::size_t most) : book_(std::make_shared<Book>(most)) {}

    // Given back when the last copy dies, which may be after the quota itself.
    using Place = std::shared_ptr<void>;
    // Null when this address (a client_address) holds as many as it may.
    [[nodiscard]] Place take(const std::string& address);

  private:
    struct Book {
        explicit Book(std::size_t limit) : most(limit) {}
        const std::size_t most;
        std::mutex mutex;
        std::map<std::string, std::size_t> taken;
    };
    std::shared_ptr<Book> book_;
};

}  // namespace relume::net
