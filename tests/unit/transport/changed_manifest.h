// A manifest's text after a change to its JSON, with the checksum made right again.
#pragma once

#include "protocol/transport/checksum.h"
#include "protocol/transport/manifest.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <span>
#include <string>

namespace relume::transport {

[[nodiscard]] inline std::string changed_text(
    const Manifest& manifest, const std::function<void(nlohmann::json&)>& change) {
    nlohmann::json object = nlohmann::json::parse(text_from_manifest(manifest));
    object.erase("xxh3");
    change(object);
    const std::string body = object.dump().substr(1);
    return "{\"xxh3\":\"" + text_from_checksum(checksum(std::as_bytes(std::span(body)))) +
           "\",\n" + body;
}

}  // namespace relume::transport
