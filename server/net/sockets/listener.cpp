#include "server/net/sockets/listener.h"

#include "server/net/sockets/http_connection.h"

#include <boost/asio/as_tuple.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <charconv>
#include <chrono>
#include <utility>

namespace relume::net {

namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

constexpr auto kNoThrow = asio::as_tuple(asio::use_awaitable);
// Out of file descriptors or memory: others must end first.
constexpr std::chrono::milliseconds kAcceptPause{100};

}  // namespace

tcp::endpoint endpoint_from_address(const std::string& address) {
    const std::size_t colon = address.rfind(':');
    std::string host = address.substr(0, colon);
    if (host.size() >= 2 && host.front() == '[' && host.back() == ']') {
        host = host.substr(1, host.size() - 2);
    } else if (host.find(':') != std::string::npos) {
        colon == std::string::npos ? void() : host.clear();
    }
    std::uint16_t port = 0;
    const char* const end = address.data() + address.size();
    const char* const digits = colon == std::string::npos ? end : address.data() + colon + 1;
    const auto [last, error] = std::from_chars(digits, end, port);
    if (host.empty() || error != std::errc() || last != end) {
        throw ListenError(fmt::format(
            "cannot listen on \"{}\": expected HOST:PORT or [IPV6]:PORT, port 0 to 65535",
            address));
    }
    boost::system::error_code failure;
    asio::io_context io;
    const auto found = tcp::resolver(io).resolve(host, "", tcp::resolver::passive, failure);
    if (failure || found.empty()) {
        throw ListenError(
            fmt::format("cannot listen on \"{}\": {}", address, failure.message()));
    }
    return {found.begin()->endpoint().address(), port};
}

Listener::Listener(asio::io_context& io, const tcp::endpoint& endpoint)
    : io_(io), acceptor_(asio::make_strand(io)) {
    try {
        acceptor_.open(endpoint.protocol());
        acceptor_.set_option(tcp::acceptor::reuse_address(true));
        acceptor_.bind(endpoint);
        acceptor_.listen();
        endpoint_ = acceptor_.local_endpoint();
    } catch (const boost::system::system_error& failure) {
        throw ListenError(fmt::format("cannot listen on {}:{}: {}",
                                      endpoint.address().to_string(), endpoint.port(),
                                      failure.code().message()));
    }
}

void Listener::start(const ConnectionServices& services) {
    by_address_.emplace(services.options.connections_per_address);
    asio::co_spawn(acceptor_.get_executor(), accept_all(services), asio::detached);
}

void Listener::stop() {
    asio::post(acceptor_.get_executor(), [this] {
        boost::system::error_code ignored;
        acceptor_.close(ignored);
    });
}

asio::awaitable<void> Listener::accept_all(const ConnectionServices& services) {
    asio::steady_timer pause(acceptor_.get_executor());
    while (acceptor_.is_open()) {
        tcp::socket socket(asio::make_strand(io_));
        auto [error] = co_await acceptor_.async_accept(socket, kNoThrow);
        if (error == asio::error::operation_aborted) {
            break;
        }
        if (error) {
            spdlog::warn("accept_failed reason={:?}", error.message());
            pause.expires_after(kAcceptPause);
            co_await pause.async_wait(kNoThrow);
            continue;
        }
        boost::system::error_code gone;
        const asio::ip::address peer = socket.remote_endpoint(gone).address();
        AddressQuota::Place place;
        if (!services.proxies.trusts(peer)) {
            place = by_address_->take(quota_key(peer));
        }
        if (gone || (!place && !services.proxies.trusts(peer)) ||
            connections_.load() >= services.options.connections) {
            services.metrics.count_refused_connection();
            continue;  // the socket's destructor closes it
        }
        boost::system::error_code ignored;
        socket.set_option(asio::socket_base::send_buffer_size(
                              static_cast<int>(services.options.send_buffer_bytes)),
                          ignored);
        ++connections_;
        auto executor = socket.get_executor();
        asio::co_spawn(executor, serve(std::move(socket), std::move(place), services),
                       asio::detached);
    }
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a coroutine keeps what it is given
asio::awaitable<void> Listener::serve(tcp::socket socket,
                                      AddressQuota::Place place,
                                      const ConnectionServices& services) {
    static_cast<void>(place);
    co_await serve_http(std::move(socket), services);
    --connections_;
}

}  // namespace relume::net
