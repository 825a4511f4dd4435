#include "tests/load/honest_client.h"

#include "tests/support/program.h"

#include <nlohmann/json.hpp>

#include <string>

namespace relume::test {

Work work_for_a_while(std::uint16_t port, const std::filesystem::path& folder) {
    const std::string output =
        run_to_end(RELUME_CLIENT,
                   {"load", "--server", "http://127.0.0.1:" + std::to_string(port), "--scene",
                    "work", "--sessions", "2", "--idle", "0", "--rate", "20", "--seconds", "2"},
                   folder, "honest");
    const nlohmann::json result = nlohmann::json::parse(output);
    return {.edits = result.at("edits"),
            .edits_shown = result.at("edits_shown"),
            .images = result.at("images"),
            .edit_to_image_ms_p99 = result.at("edit_to_image_ms_p99")};
}

}  // namespace relume::test
