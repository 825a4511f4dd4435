#include "tests/lab/claims/claim.h"

namespace relume::lab {

const std::vector<ClaimGroup>& claim_groups() {
    static const std::vector<ClaimGroup> groups{rotation_claims, selector_claims, cost_claims,
                                                priority_claims, sh_claims};
    return groups;
}

}  // namespace relume::lab
