#include "server/net/rooms/curve_signal.h"

#include "protocol/basis/curve_projection.h"
#include "server/net/library/editable_materials.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace relume::net {
namespace {

constexpr std::size_t kChannels = 3;

struct ShownCurve {
    transport::CurveRecord::Samples curve{};
    Imath::V3f diffuse{1, 1, 1};
};

ShownCurve shown_curve(const transport::CurveRecord& record, const wire::MaterialEdits& edits) {
    const auto found = edits.find(record.id);
    if (found == edits.end()) {
        return {.curve = record.baked, .diffuse = Imath::V3f(1, 1, 1)};
    }
    return {.curve = edited_curve(found->second).rgb,
            .diffuse = Imath::V3f(found->second.diffuse)};
}

}  // namespace

bool CurveSignal::set_state(const wire::RoomState& state,
                            const NamedEnvironments& /*environments*/,
                            std::vector<wire::ErrorMessage>& /*problems*/) {
    if (!coefficients_.empty() && state.materials == shown_) {
        return false;
    }
    shown_ = state.materials;
    const basis::CurveBasis basis(static_cast<std::uint32_t>(curves_.size()));
    const std::size_t count = basis.coefficient_count();
    coefficients_.assign(kChannels * count, 0.0F);
    for (std::size_t channel = 0; channel < kChannels; ++channel) {
        basis::project_rest(std::span(coefficients_).subspan(channel * count, count));
    }
    for (std::uint32_t m = 0; m < curves_.size(); ++m) {
        const ShownCurve shown = shown_curve(curves_[m], shown_);
        for (std::size_t channel = 0; channel < kChannels; ++channel) {
            basis::project_curve(basis, m, shown.diffuse[static_cast<int>(channel)],
                                 shown.curve[channel],
                                 std::span(coefficients_).subspan(channel * count, count));
        }
    }
    return true;
}

}  // namespace relume::net
