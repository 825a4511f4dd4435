import { describe, expect, it } from "vitest";
import {
    axesOf,
    dollied,
    framed,
    kSides,
    orbited,
    panned,
    seenFrom,
    type Side,
} from "../src/camera";
import type { CameraState, Triple } from "../src/wire/state";

const kCamera: CameraState = {
    eye: [1, 2, 9],
    look_at: [1, 2, 5],
    up: [0, 1, 0],
    fov_degrees: 40,
};
const kBounds = { centre: [3, -1, 2] as Triple, radius: 5 };

function expectClose(a: readonly number[], b: readonly number[], digits = 9): void {
    expect(a.length).toBe(b.length);
    a.forEach((value, i) => expect(value).toBeCloseTo(b[i]!, digits));
}

function distance({ eye, look_at }: CameraState): number {
    return Math.hypot(eye[0] - look_at[0], eye[1] - look_at[1], eye[2] - look_at[2]);
}

/** Where a point shows: in image heights right of and above the middle. */
function placeOf(camera: CameraState, point: Triple): [number, number] {
    const { right, upwards, forward } = axesOf(camera);
    const from = point.map((part, i) => part - camera.eye[i]!);
    const along = (axis: Triple): number =>
        from.reduce((sum, part, i) => sum + part * axis[i]!, 0);
    const height = 2 * along(forward) * Math.tan((camera.fov_degrees * Math.PI) / 360);
    return [along(right) / height, along(upwards) / height];
}

describe("orbit", () => {
    it("keeps the distance, and brings what was at the side to the front", () => {
        const turned = orbited(kCamera, 90, 0);
        // A hand to the right turns the scene's front to the right: its left side comes.
        expectClose(turned.eye, [-3, 2, 5]);
        expectClose(turned.look_at, kCamera.look_at);
        const over = orbited(kCamera, 0, 30);
        expect(over.eye[1]).toBeGreaterThan(kCamera.eye[1]);
        expect(distance(over)).toBeCloseTo(4);
        // What is in front of the middle follows the hand.
        const [before, after] = [kCamera, orbited(kCamera, 5, 5)].map((camera) =>
            placeOf(camera, [1, 2, 6]),
        );
        expect(after![0]).toBeGreaterThan(before![0]);
        expect(after![1]).toBeLessThan(before![1]);
    });

    it("comes back by the same ways and stops before it is overhead", () => {
        const away = orbited(orbited(orbited(kCamera, 33, 0), 50, 0), -83, 0);
        expectClose(away.eye, kCamera.eye);
        for (const down of [500, -500]) {
            const steep = orbited(kCamera, 0, down);
            expect(distance(steep)).toBeCloseTo(4);
            expect(Math.abs(steep.eye[1] - 2)).toBeLessThan(4);
            expect(Math.hypot(steep.eye[0] - 1, steep.eye[2] - 5)).toBeGreaterThan(0.01);
            // And leaves again on the side that it came from.
            const back = orbited(steep, 0, down > 0 ? -89.5 : 89.5);
            expectClose(back.eye, kCamera.eye, 6);
        }
    });

    it("is about the room's up", () => {
        const camera: CameraState = { ...kCamera, up: [0, 0, 2], eye: [5, 2, 5] };
        const turned = orbited(camera, 90, 0);
        expect(turned.eye[2]).toBeCloseTo(5);
        expect(distance(turned)).toBeCloseTo(4);
    });
});

describe("pan", () => {
    it("takes what is looked at along with the hand", () => {
        const moved = panned(kCamera, 0.25, 0.5);
        expectClose(placeOf(moved, kCamera.look_at), [0.25, -0.5]);
        expect(distance(moved)).toBeCloseTo(4);
    });
});

describe("dolly", () => {
    it("changes the distance by a factor, and never reaches what is looked at", () => {
        expectClose(dollied(kCamera, 0.5, kBounds).eye, [1, 2, 7]);
        const near = dollied(kCamera, 1e-12, kBounds);
        expect(distance(near)).toBeGreaterThan(1e-5 * kBounds.radius);
        expect(distance(dollied(near, 2, kBounds))).toBeGreaterThan(distance(near));
        // From a camera that looks at its own eye there is a way out.
        const stuck = dollied({ ...kCamera, eye: kCamera.look_at }, 2, kBounds);
        expect(distance(stuck)).toBeGreaterThan(0);
    });
});

describe("framing", () => {
    const corners: Triple[] = [];
    for (let i = 0; i < 200; ++i) {
        const [z, turn] = [1 - (2 * i + 1) / 200, i * 2.4];
        const r = Math.sqrt(1 - z * z) * kBounds.radius;
        corners.push([
            3 + r * Math.cos(turn),
            -1 + r * Math.sin(turn),
            2 + z * kBounds.radius,
        ]);
    }

    it("has all of the scene in the image, from this and from every side", () => {
        for (const fov_degrees of [0.01, 40, 120, 179]) {
            for (const aspect of [0.3, 1, 2.5]) {
                const views = [framed({ ...kCamera, fov_degrees }, kBounds, aspect)];
                for (const side of Object.keys(kSides) as Side[]) {
                    views.push(seenFrom(side, { ...kCamera, fov_degrees }, kBounds, aspect));
                }
                for (const view of views) {
                    for (const corner of corners) {
                        const [x, y] = placeOf(view, corner);
                        expect(Math.abs(x)).toBeLessThanOrEqual(aspect / 2);
                        expect(Math.abs(y)).toBeLessThanOrEqual(0.5);
                    }
                }
            }
        }
    });

    it("looks from the side that it is named after", () => {
        const up = (side: Side): Triple => axesOf(seenFrom(side, kCamera, kBounds, 1)).upwards;
        expectClose(up("front"), [0, 1, 0]);
        expectClose(up("top"), [0, 0, -1]);
        expect(seenFrom("top", kCamera, kBounds, 1).eye[1]).toBeGreaterThan(5);
        expect(seenFrom("left", kCamera, kBounds, 1).eye[0]).toBeLessThan(-3);
        expect(seenFrom("front", kCamera, kBounds, 1).eye[2]).toBeGreaterThan(5);
    });
});
