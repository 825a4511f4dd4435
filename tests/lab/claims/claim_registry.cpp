#include "tests/lab/claims/claim.h"

namespace relume::lab {

const std::vector<ClaimGroup>& claim_groups() {
    static const std::vector<ClaimGroup> groups{
        rotation_claims, rest_claims,           blend_claims,       selector_claims,
        cost_claims,     incremental_sh_claims, still_light_claims, priority_claims,
        sh_claims,       surface_claims};
    return groups;
}

}  // namespace relume::lab
