import { describe, expect, it } from "vitest";
import { SharedState } from "../src/shared_state";
import type { Snapshot } from "../src/wire/message";
import type { RoomState } from "../src/wire/state";
import { stateWith } from "./states";

const lit = (gain: number): RoomState =>
    stateWith({ environment: { name: "city", gain, tint: [1, 1, 1] } });

const snapshot = (revision: number, state: RoomState): Snapshot => ({
    type: "snapshot",
    protocol: 1,
    room: "r",
    scene: { name: "s", width: 1, height: 1, face_resolution: 4 },
    revision,
    state,
    viewers: 1,
    limits: {},
});

const open = (): SharedState => new SharedState(snapshot(5, lit(1)));

const gain = (value: number) => ({ environment: { gain: value } });

describe("SharedState", () => {
    it("shows an edit from the moment it is queued until long after it is confirmed", () => {
        const shared = open();
        shared.queue(gain(2));
        expect(shared.state.environment.gain).toBe(2);
        shared.expect(1, gain(2));
        expect(shared.hasPending).toBe(true);
        shared.confirm({ type: "change", revision: 6, patch: gain(2), edit_id: 1 });
        expect(shared.state.environment.gain).toBe(2);
        expect(shared.hasPending).toBe(false);
        expect(shared.revision).toBe(6);
    });

    it("does not jump back when another's change arrives before its own", () => {
        const shared = open();
        shared.queue(gain(2));
        shared.expect(1, gain(2));
        shared.queue(gain(3));
        shared.confirm({ type: "change", revision: 6, patch: gain(9) });
        expect(shared.state.environment.gain).toBe(3);
        shared.confirm({ type: "change", revision: 7, patch: gain(2), edit_id: 1 });
        expect(shared.state.environment.gain).toBe(3);
    });

    it("takes a confirmation for all edits up to it", () => {
        const shared = open();
        for (const id of [1, 2, 3]) {
            shared.queue(gain(id));
            shared.expect(id, gain(id));
        }
        shared.confirm({ type: "change", revision: 8, patch: gain(2), edit_id: 2 });
        expect(shared.hasPending).toBe(true);
        expect(shared.state.environment.gain).toBe(3);
    });

    it("returns to the confirmed state when an edit is refused", () => {
        const shared = open();
        shared.queue(gain(-1));
        shared.expect(1, gain(-1));
        shared.refuse(1);
        expect(shared.state).toEqual(lit(1));
        expect(shared.hasPending).toBe(false);
    });

    it("tells changes of the image from changes of display and policy", () => {
        const shared = open();
        const patch = { display: { exposure_stops: 1 } };
        shared.confirm({ type: "change", revision: 6, patch });
        expect([shared.revision, shared.imageRevision]).toEqual([6, 5]);
        const policy = { budget: { target_error: 0.01 } };
        shared.confirm({ type: "change", revision: 6, patch: policy });
        expect(shared.imageRevision).toBe(5);
        shared.confirm({ type: "change", revision: 7, patch: { ...patch, ...gain(2) } });
        expect([shared.revision, shared.imageRevision]).toEqual([7, 7]);
    });
});

describe("isForgottenBy", () => {
    it("tells a room that began anew from one that went on", () => {
        const shared = open(); // revision 5
        expect(shared.isForgottenBy(snapshot(0, lit(1)))).toBe(true);
        expect(shared.isForgottenBy(snapshot(5, lit(2)))).toBe(true);
        expect(shared.isForgottenBy(snapshot(5, lit(1)))).toBe(false);
        expect(shared.isForgottenBy(snapshot(6, lit(2)))).toBe(false);
        const { display, ...rest } = lit(1);
        const reordered = { display, ...rest };
        expect(shared.isForgottenBy(snapshot(5, reordered))).toBe(false);
    });
});

describe("awaitsImage", () => {
    it("is about edits of the image on their way, not of display", () => {
        const shared = open();
        shared.queue({ display: { exposure_stops: 1 } });
        expect([shared.hasPending, shared.awaitsImage]).toEqual([true, false]);
        shared.queue(gain(2));
        expect(shared.awaitsImage).toBe(true);
        shared.expect(1, gain(2));
        expect(shared.awaitsImage).toBe(true);
        shared.confirm({ type: "change", revision: 6, patch: gain(2), edit_id: 1 });
        expect(shared.awaitsImage).toBe(false);
    });
});
