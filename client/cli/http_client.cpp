#include "client/cli/http_client.h"

#include "client/cli/client_error.h"
#include "protocol/base/text/strict_json.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/use_future.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <future>

namespace relume::cli {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

constexpr int kHttp11 = 11;

// Runs the context until the operation behind the future is done. Only asynchronous
// operations of a Beast stream honour its timeout, so all of them are.
template <typename T>
T finish(asio::io_context& io, std::future<T> result) {
    io.restart();
    io.run();
    return result.get();
}

HttpAnswer exchange(const Url& server,
                    http::request<http::string_body> request,
                    std::chrono::seconds timeout) {
    // Without the query, which may be long.
    const std::string target(request.target());
    const std::string what =
        fmt::format("{} http://{}{}", std::string(request.method_string()), server.authority(),
                    target.substr(0, target.find('?')));
    request.set(http::field::host, server.authority());
    request.set(http::field::user_agent, "relume");
    request.set(http::field::connection, "close");
    try {
        asio::io_context io;
        asio::ip::tcp::resolver resolver(io);
        const auto endpoints =
            finish(io, resolver.async_resolve(server.host, server.port, asio::use_future));
        beast::tcp_stream stream(io);
        stream.expires_after(timeout);
        finish(io, stream.async_connect(endpoints, asio::use_future));
        finish(io, http::async_write(stream, request, asio::use_future));
        beast::flat_buffer buffer;
        http::response_parser<http::string_body> parser;
        parser.body_limit(kMaxAnswerBytes);
        finish(io, http::async_read(stream, buffer, parser, asio::use_future));
        return {.status = parser.get().result_int(), .body = std::move(parser.get().body())};
    } catch (const boost::system::system_error& error) {
        throw ClientError(fmt::format("{}: {}", what, error.code().message()));
    }
}

// What a refusal says of itself; nothing where it is not in the protocol's form.
std::string detail_of(const std::string& body) {
    try {
        const nlohmann::json answer = text::parse_strict_json(body, kMaxAnswerBytes);
        const nlohmann::json& error = answer.at("error");
        const auto found = error.value("found", std::string());
        std::string detail = ": " + error.value("message", std::string());
        if (detail.find(found) == std::string::npos) {
            detail += fmt::format(" (found {}, expected {})", found,
                                  error.value("expected", std::string()));
        }
        return detail;
    } catch (const text::JsonError&) {
        return {};
    } catch (const nlohmann::json::exception&) {
        return {};
    }
}

}  // namespace

HttpAnswer http_get(const Url& server,
                    const std::string& target,
                    std::chrono::seconds timeout) {
    return exchange(server, {http::verb::get, server.prefix + target, kHttp11}, timeout);
}

HttpAnswer http_post(const Url& server,
                     const std::string& target,
                     const std::string& token,
                     std::string body,
                     std::chrono::seconds timeout) {
    http::request<http::string_body> request{http::verb::post, server.prefix + target, kHttp11,
                                             std::move(body)};
    request.set(http::field::content_type, "application/octet-stream");
    if (!token.empty()) {
        request.set(http::field::authorization, "Bearer " + token);
    }
    request.prepare_payload();
    return exchange(server, std::move(request), timeout);
}

nlohmann::json json_from_answer(const HttpAnswer& answer, const std::string& request) {
    if (answer.status >= 200 && answer.status < 300) {
        try {
            return text::parse_strict_json(answer.body, kMaxAnswerBytes);
        } catch (const text::JsonError& error) {
            throw ClientError(
                fmt::format("{}: the answer's body is not JSON: {}", request, error.what()));
        }
    }
    const std::string detail = detail_of(answer.body);
    throw ClientError(fmt::format("{}: found HTTP status {}, expected 2xx{}", request,
                                  answer.status, detail));
}

}  // namespace relume::cli
