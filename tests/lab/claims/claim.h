// What the papers that Relume starts from say, tried on our data.
#pragma once

#include "tests/lab/claims/evidence.h"

#include <string>
#include <vector>

namespace relume::lab {

struct Claim {
    std::string claim;    // with the threshold it is held to
    std::string source;   // a key of protocol/references.bib with its place
    std::string measure;  // the one the source uses
    std::string found;    // figures in it
    std::string beside;   // the same in other measures, named; L2 of the image among them
    bool holds = false;   // computed from `found`
    std::string why;      // why ours differ; empty where it holds
};

// Claims that rest on the same evidence. Throws what the evidence throws.
using ClaimGroup = std::vector<Claim> (*)(Evidence& evidence);

// All groups, in the order of the table. One line in claim_registry.cpp adds one.
[[nodiscard]] const std::vector<ClaimGroup>& claim_groups();

// A file each.
[[nodiscard]] std::vector<Claim> rotation_claims(Evidence& evidence);
[[nodiscard]] std::vector<Claim> rest_claims(Evidence& evidence);
[[nodiscard]] std::vector<Claim> blend_claims(Evidence& evidence);
[[nodiscard]] std::vector<Claim> selector_claims(Evidence& evidence);
[[nodiscard]] std::vector<Claim> cost_claims(Evidence& evidence);
[[nodiscard]] std::vector<Claim> incremental_sh_claims(Evidence& evidence);
[[nodiscard]] std::vector<Claim> still_light_claims(Evidence& evidence);
[[nodiscard]] std::vector<Claim> priority_claims(Evidence& evidence);
[[nodiscard]] std::vector<Claim> sh_claims(Evidence& evidence);
[[nodiscard]] std::vector<Claim> surface_claims(Evidence& evidence);

}  // namespace relume::lab
