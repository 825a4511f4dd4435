import { describe, expect, it } from "vitest";
import { applyPatch, composePatches } from "../src/wire/merge_patch";
import type { Json, JsonObject } from "../src/wire/state";

/** RFC 7396, appendix A: target, patch, result. */
const kCases: [Json, Json, Json][] = [
    [{ a: "b" }, { a: "c" }, { a: "c" }],
    [{ a: "b" }, { b: "c" }, { a: "b", b: "c" }],
    [{ a: "b" }, { a: null }, {}],
    [{ a: "b", b: "c" }, { a: null }, { b: "c" }],
    [{ a: ["b"] }, { a: "c" }, { a: "c" }],
    [{ a: "c" }, { a: ["b"] }, { a: ["b"] }],
    [{ a: { b: "c" } }, { a: { b: "d", c: null } }, { a: { b: "d" } }],
    [{ a: [{ b: "c" }] }, { a: [1] }, { a: [1] }],
    [
        ["a", "b"],
        ["c", "d"],
        ["c", "d"],
    ],
    [{ a: "b" }, ["c"], ["c"]],
    [{ a: "foo" }, null, null],
    [{ a: "foo" }, "bar", "bar"],
    [{ e: null }, { a: 1 }, { e: null, a: 1 }],
    [[1, 2], { a: "b", c: null }, { a: "b" }],
    [{}, { a: { bb: { ccc: null } } }, { a: { bb: {} } }],
];

describe("applyPatch", () => {
    it.each(kCases)("%j with %j is %j", (target, patch, result) => {
        const before = JSON.stringify(target);
        expect(applyPatch(target, patch)).toEqual(result);
        expect(JSON.stringify(target)).toBe(before);
    });

    it("keeps a key __proto__ a key", () => {
        const patch = JSON.parse('{"lights":{"__proto__":{"gain":2}}}') as JsonObject;
        const result = applyPatch({ lights: {} }, patch) as { lights: JsonObject };
        expect(Object.keys(result.lights)).toEqual(["__proto__"]);
        expect(({} as JsonObject)["gain"]).toBeUndefined();
    });
});

describe("composePatches", () => {
    it("keeps removals, and lets the later word stand", () => {
        const first = { lights: { key: null, fill: { gain: 1 } }, budget: { milliseconds: 8 } };
        const second = {
            lights: { fill: { gain: 2 } },
            budget: { coefficients: 9, milliseconds: null },
        };
        expect(composePatches(first, second)).toEqual({
            lights: { key: null, fill: { gain: 2 } },
            budget: { milliseconds: null, coefficients: 9 },
        });
    });
});
