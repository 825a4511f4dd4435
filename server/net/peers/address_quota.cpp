#include "server/net/peers/address_quota.h"

namespace relume::net {

AddressQuota::Place AddressQuota::take(const std::string& address) {
    const std::lock_guard lock(book_->mutex);
    std::size_t& taken = book_->taken[address];
    if (taken >= book_->most) {
        return nullptr;
    }
    ++taken;
    // Points at something, so that a place that was given is never null.
    return {book_.get(), [book = book_, address](void*) {
                const std::lock_guard guard(book->mutex);
                const auto entry = book->taken.find(address);
                if (--entry->second == 0) {
                    book->taken.erase(entry);
                }
            }};
}

}  // namespace relume::net
