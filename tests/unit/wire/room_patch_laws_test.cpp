// Laws of patches over random histories.
#include "protocol/wire/messages.h"
#include "protocol/wire/room_patch.h"
#include "protocol/wire/stages.h"
#include "tests/unit/wire/random_patches.h"
#include "tests/unit/wire/vectors.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace relume::wire {
namespace {

using nlohmann::json;

// Equal JSON may differ in the sign of a zero; equal text may not.
bool same_bits(const RoomState& a, const RoomState& b) {
    return a == b && to_json(a).dump() == to_json(b).dump();
}

RC_GTEST_PROP(RoomPatchLaws, AStateSurvivesItsJson, ()) {
    const RoomState state = any_state();
    RC_ASSERT(room_state_from_json(json::parse(to_json(state).dump())) == state);
}

RC_GTEST_PROP(RoomPatchLaws, MergingTheNormalisedPatchIntoTheJsonIsApplyingIt, ()) {
    RoomState state = any_state();
    json object = to_json(state);
    object.merge_patch(apply_patch(state, valid_patch(state), Limits{}).patch);
    RC_ASSERT(object == to_json(state));
}

RC_GTEST_PROP(RoomPatchLaws, ANormalisedPatchIsItsOwnNormalForm, ()) {
    RoomState state = any_state();
    RoomState other = state;
    const json normalised = apply_patch(state, valid_patch(state), Limits{}).patch;
    RC_ASSERT(apply_patch(other, normalised, Limits{}).patch == normalised);
    RC_ASSERT(other == state);
    apply_patch(state, normalised, Limits{});
    RC_ASSERT(other == state);
}

RC_GTEST_PROP(RoomPatchLaws, AMergedPatchHasTheEffectOfAllInTurn, ()) {
    const RoomState start = any_state();
    RoomState in_turn = start;
    json merged = json::object();
    for (int edits = *rc::gen::inRange(1, 6); edits > 0; --edits) {
        merged =
            merge_patches(merged, apply_patch(in_turn, valid_patch(in_turn), Limits{}).patch);
    }
    RoomState at_once = start;
    apply_patch(at_once, merged, Limits{});
    RC_ASSERT(at_once == in_turn);
    json object = to_json(start);
    object.merge_patch(merged);
    RC_ASSERT(object == to_json(in_turn));
}

RC_GTEST_PROP(RoomPatchLaws, MergingIsAssociative, ()) {
    RoomState state = any_state();
    const json a = apply_patch(state, valid_patch(state), Limits{}).patch;
    const json b = apply_patch(state, valid_patch(state), Limits{}).patch;
    const json c = apply_patch(state, valid_patch(state), Limits{}).patch;
    RC_ASSERT(merge_patches(merge_patches(a, b), c) == merge_patches(a, merge_patches(b, c)));
}

RC_GTEST_PROP(RoomPatchLaws, AnInverseTakesItsPatchBackBitForBit, ()) {
    RoomState state = any_state();
    const RoomState before = state;
    const auto [patch, inverse] = apply_patch(state, valid_patch(state), Limits{});
    const RoomState after = state;
    json object = to_json(after);
    const AppliedPatch undone = apply_patch(state, inverse, Limits{});
    RC_ASSERT(same_bits(state, before));
    // It is normalised, so that clients may merge it.
    RC_ASSERT(undone.patch == inverse);
    object.merge_patch(inverse);
    RC_ASSERT(object == to_json(before));
    // It touches what the patch touches, and has an inverse, too.
    RC_ASSERT(stages_of(inverse) == stages_of(patch));
    apply_patch(state, undone.inverse, Limits{});
    RC_ASSERT(same_bits(state, after));
}

RC_GTEST_PROP(RoomPatchLaws, InversesMergedFromTheLastToTheFirstTakeAllBack, ()) {
    RoomState state = any_state();
    const RoomState before = state;
    json undo = json::object();
    for (int edits = *rc::gen::inRange(1, 6); edits > 0; --edits) {
        undo = merge_patches(apply_patch(state, valid_patch(state), Limits{}).inverse, undo);
    }
    json object = to_json(state);
    apply_patch(state, undo, Limits{});
    RC_ASSERT(same_bits(state, before));
    object.merge_patch(undo);
    RC_ASSERT(object == to_json(before));
}

RC_GTEST_PROP(RoomPatchLaws, ASpoiltPatchIsTakenWholeOrRefusedWhole, ()) {
    RoomState state = any_state();
    const RoomState before = state;
    json patch = valid_patch(state);
    spoil(patch);
    try {
        const json normalised = apply_patch(state, patch, Limits{}).patch;
        json object = to_json(before);
        object.merge_patch(normalised);
        RC_ASSERT(object == to_json(state));
    } catch (const WireError& error) {
        RC_ASSERT(state == before);
        RC_ASSERT(!error.found().empty());
        RC_ASSERT(!error.expected().empty());
        RC_ASSERT(error.path().empty() || error.path().front() == '/');
    }
}

}  // namespace
}  // namespace relume::wire
