import { describe, expect, it } from "vitest";
import {
    lightingFromText,
    lightingOf,
    LightingError,
    mapsOf,
    patchToLighting,
    textFromLighting,
    wholeLightingOf,
    withoutMaps,
} from "../src/lighting";
import { keysToForget, kMostKeptBytes, kMostKeptFiles } from "../src/upload_store";
import { applyPatch } from "../src/wire/merge_patch";
import type { AreaLight, Json } from "../src/wire/state";
import { stateWith } from "./states";

function light(order: number, name?: string): AreaLight {
    return {
        direction: [0, 1, 0],
        angular_radius_degrees: 5,
        radiance: [1, 2, 3],
        gain: 1,
        tint: [1, 1, 1],
        muted: order === 1,
        solo: false,
        order,
        ...(name === undefined ? {} : { name }),
    };
}

const kStates = [
    stateWith(),
    stateWith({ lights: { key: light(0, "Window"), fill: light(1) } }),
    stateWith({
        blend: { name: "night", amount: 0.5 },
        lights: { fill: light(0), key: light(2) },
    }),
    stateWith({ budget: { coefficients: 30, target_error: 0.1 } }),
];

describe("lightings", () => {
    it("lead from any state to any other", () => {
        for (const from of kStates) {
            for (const to of kStates) {
                const patch = patchToLighting(from, to);
                expect(applyPatch(from as unknown as Json, patch)).toEqual(to);
            }
        }
    });

    it("come back from their file", () => {
        for (const state of kStates) {
            const saved = lightingOf(state, { exposure_stops: 2, tone: "linear" });
            expect(lightingFromText(textFromLighting(saved))).toEqual(saved);
            expect(Object.keys(saved)).not.toContain("budget");
        }
    });

    it("leave the size of the image to the room", () => {
        const state = stateWith({ image: { width: 96, height: 64 } });
        expect(wholeLightingOf(state)).not.toHaveProperty("image");
        const text = JSON.stringify(state);
        expect(lightingFromText(text)).toEqual(wholeLightingOf(state));
        expect(() => lightingFromText('{"image": {"width": 96}}')).toThrow(LightingError);
    });

    it.each([
        ["[]", "This file holds no lighting"],
        ["{}", "This file holds no lighting"],
        ["3", "This file holds no lighting"],
        ['{"lights": {}, "shadows": 1}', "This file holds no lighting"],
        ['{"lights": []}', '"lights" is no part of a lighting'],
        ['{"lights": {', "This file is not JSON"],
        ["", "This file is not JSON"],
    ])("refuses %s in words", (text, words) => {
        expect(() => lightingFromText(text)).toThrow(LightingError);
        expect(() => lightingFromText(text)).toThrow(words);
    });

    it("leave only the missing map out", () => {
        const wanted = stateWith({
            environment: { name: "mine", gain: 3, tint: [1, 0, 0] },
            blend: { name: "night", amount: 0.5 },
            lights: { key: light(0) },
        });
        expect(mapsOf(wanted)).toEqual(["mine", "night"]);
        const rest = patchToLighting(stateWith(), withoutMaps(wanted, ["mine"]));
        const result = applyPatch(stateWith() as unknown as Json, rest);
        expect(result).toEqual({
            ...wanted,
            environment: { ...wanted.environment, name: "city" },
        });
        expect(withoutMaps(wanted, ["night"]).blend).toEqual({ name: null, amount: 0 });
        expect(withoutMaps(wanted, [])).toEqual(wanted);
    });
});

describe("kept uploads", () => {
    const kept = (count: number, bytes: number) =>
        Array.from({ length: count }, (_, i) => ({ key: `k${i}`, keptAt: 100 - i, bytes }));

    it("are bounded in number, the oldest going first", () => {
        expect(keysToForget(kept(kMostKeptFiles - 1, 1), 1)).toEqual([]);
        expect(keysToForget(kept(kMostKeptFiles, 1), 1)).toEqual([`k${kMostKeptFiles - 1}`]);
    });

    it("are bounded in bytes", () => {
        const half = kMostKeptBytes / 2;
        expect(keysToForget(kept(2, half), half)).toEqual(["k1"]);
        expect(keysToForget(kept(2, half), kMostKeptBytes)).toEqual(["k1", "k0"]);
    });
});
