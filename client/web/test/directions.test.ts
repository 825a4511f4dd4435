import { describe, expect, it } from "vitest";
import {
    brightnessFromLinear,
    hexFromLinear,
    linearFromBrightness,
    linearFromHex,
} from "../src/colour";
import { capOutline, directionFromPosition, positionFromDirection } from "../src/lat_long";
import {
    aboutAxis,
    conjugate,
    eulerFromQuaternion,
    multiply,
    quaternionFromEuler,
    rotate,
    turned,
} from "../src/rotation";
import type { Triple } from "../src/wire/state";

function expectClose(a: readonly number[], b: readonly number[], digits = 9): void {
    expect(a.length).toBe(b.length);
    a.forEach((value, i) => expect(value).toBeCloseTo(b[i]!, digits));
}

describe("lat-long", () => {
    it("has −Z at the centre, +X right of it, +Y on top", () => {
        expectClose(directionFromPosition({ u: 0.5, v: 0.5 }), [0, 0, -1]);
        expectClose(directionFromPosition({ u: 0.75, v: 0.5 }), [1, 0, 0]);
        expectClose(directionFromPosition({ u: 0.5, v: 0 }), [0, 1, 0]);
    });

    it("inverts", () => {
        for (const u of [0.01, 0.3, 0.5, 0.99]) {
            for (const v of [0.02, 0.5, 0.9]) {
                const back = positionFromDirection(directionFromPosition({ u, v }));
                expectClose([back.u, back.v], [u, v]);
            }
        }
    });

    it("draws a cap whose border is its radius away from the centre", () => {
        const axis: Triple = [0.6, 0.48, -0.64];
        for (const { u, v } of capOutline(axis, 12)) {
            const d = directionFromPosition({ u, v });
            const cosine = d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2];
            expect(cosine).toBeCloseTo(Math.cos((12 * Math.PI) / 180), 9);
        }
    });

    it("runs on over the seam, and closes over a pole", () => {
        const seam = capOutline([0.05, 0, 1], 10).map(({ u }) => u);
        expect(Math.max(...seam) - Math.min(...seam)).toBeLessThan(0.1);
        const pole = capOutline([0.1, 1, 0], 20);
        expect(pole.slice(-2).map(({ v }) => v)).toEqual([0, 0]);
        expect(Math.abs(pole.at(-1)!.u - pole.at(-2)!.u)).toBeCloseTo(1, 9);
    });
});

describe("rotation", () => {
    it("is R_y(yaw) · R_x(pitch) · R_z(roll)", () => {
        const q = quaternionFromEuler({ yaw: 90, pitch: 0, roll: 0 });
        expectClose(rotate(q, [0, 0, -1]), [-1, 0, 0]);
        const p = quaternionFromEuler({ yaw: 90, pitch: 90, roll: 0 });
        // Pitch first: −Z goes up, and up it stays.
        expectClose(rotate(p, [0, 0, -1]), [0, 1, 0]);
    });

    it("is undone by its conjugate", () => {
        const q = quaternionFromEuler({ yaw: 30, pitch: -50, roll: 110 });
        expectClose(multiply(q, conjugate(q)), [1, 0, 0, 0]);
    });

    it("comes back from Euler angles, at the poles too", () => {
        const angles = [-170, -60, 0, 35, 120];
        for (const yaw of angles) {
            for (const pitch of [-90, -89, 0, 45, 90]) {
                for (const roll of angles) {
                    const q = quaternionFromEuler({ yaw, pitch, roll });
                    const back = quaternionFromEuler(eulerFromQuaternion(q));
                    for (const v of [
                        [1, 0, 0],
                        [0, 1, 0],
                        [0, 0, 1],
                    ] as Triple[]) {
                        expectClose(rotate(back, v), rotate(q, v), 6);
                    }
                }
            }
        }
    });

    it("follows the hand: what is ahead goes right, down, and round", () => {
        const identity = aboutAxis([0, 1, 0], 0);
        expect(rotate(turned(identity, { across: 10 }), [0, 0, -1])[0]).toBeGreaterThan(0);
        expect(rotate(turned(identity, { down: 10 }), [0, 0, -1])[1]).toBeLessThan(0);
        expect(rotate(turned(identity, { clockwise: 10 }), [0, 1, 0])[0]).toBeGreaterThan(0);
    });

    it("stays a unit quaternion over many small turns", () => {
        let q = aboutAxis([0, 1, 0], 0);
        for (let i = 0; i < 10_000; ++i)
            q = turned(q, { across: 0.7, down: 0.3, clockwise: 0.1 });
        expect(Math.hypot(...q)).toBeCloseTo(1, 12);
    });
});

describe("colour", () => {
    it("splits into intensity and colour and back", () => {
        const linear: Triple = [40, 12, 3];
        const { intensity, colour } = brightnessFromLinear(linear);
        expect(intensity).toBe(40);
        const back = linearFromBrightness({ intensity, colour });
        back.forEach((part, c) => expect(Math.abs(part - linear[c]!)).toBeLessThan(0.2));
    });

    it("keeps the intensity when a darker colour is picked", () => {
        expect(Math.max(...linearFromBrightness({ intensity: 7, colour: "#402010" }))).toBe(7);
        expect(linearFromBrightness({ intensity: 7, colour: "#000000" })).toEqual([7, 7, 7]);
    });

    it("reads what it writes", () => {
        for (const hex of ["#000000", "#ffffff", "#8040c1", "#010203"]) {
            expect(hexFromLinear(linearFromHex(hex))).toBe(hex);
        }
        expect(linearFromHex("#f00")).toEqual([1, 0, 0]);
    });
});
