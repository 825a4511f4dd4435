// Single HTTP requests, each on a connection of its own; blocking.
#pragma once

#include "client/cli/url.h"

#include <nlohmann/json_fwd.hpp>

#include <chrono>
#include <cstddef>
#include <string>

namespace relume::cli {

struct HttpAnswer {
    unsigned status = 0;
    std::string body;
};

inline constexpr std::chrono::seconds kHttpTimeout{30};
inline constexpr std::size_t kMaxAnswerBytes = std::size_t{16} << 20;

// `target` begins with a slash and is percent-encoded. Any status is an answer; ClientError is
// thrown when there is none: the server cannot be reached, is silent for `timeout`, or answers
// with more than kMaxAnswerBytes.
[[nodiscard]] HttpAnswer http_get(const Url& server,
                                  const std::string& target,
                                  std::chrono::seconds timeout = kHttpTimeout);
[[nodiscard]] HttpAnswer http_post(const Url& server,
                                   const std::string& target,
                                   const std::string& token,  // may be empty
                                   std::string body,
                                   std::chrono::seconds timeout = kHttpTimeout);

// The JSON body of an answer with a status of 200 to 299. Throws ClientError for any other,
// with what the server says was found and expected.
[[nodiscard]] nlohmann::json json_from_answer(const HttpAnswer& answer,
                                              const std::string& request);

}  // namespace relume::cli
