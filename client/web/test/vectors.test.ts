/** The page's mirror of the wire, held to the vectors that the C++ side is held to. */
import { describe, expect, it } from "vitest";
import displayVectors from "../../../protocol/wire/vectors/display.json";
import headerVectors from "../../../protocol/wire/vectors/image_headers.json";
import malformedVectors from "../../../protocol/wire/vectors/image_headers_malformed.json";
import nameVectors from "../../../protocol/wire/vectors/names.json";
import patchVectors from "../../../protocol/wire/vectors/patches.json";
import { displayFromLinear } from "../src/display";
import { isName } from "../src/place";
import { imageHeaderFromFrame } from "../src/wire/image_header";
import { applyPatch, composePatches, isObject } from "../src/wire/merge_patch";
import { WireError } from "../src/wire/message";
import type { DisplayTone, JsonObject } from "../src/wire/state";

function frameFromHex(hex: string, payloadBytes: number): ArrayBuffer {
    const header = hex.match(/../g)?.map((pair) => parseInt(pair, 16)) ?? [];
    const frame = new Uint8Array(header.length + payloadBytes);
    frame.set(header);
    return frame.buffer;
}

describe("image headers", () => {
    it.each(headerVectors)("reads $name", ({ hex, fields }) => {
        const header = imageHeaderFromFrame(frameFromHex(hex, fields.payload_bytes));
        expect({
            encoding: header.encoding === 1 ? "jpeg" : "half_planes",
            width: header.width,
            height: header.height,
            revision: header.revision,
            sequence: header.sequence,
            relative_error: header.statedError,
            exact: header.exact,
            has_alpha: header.hasAlpha,
            edit_to_image_ms: header.editToImageMilliseconds,
            relight_ms: header.relightMilliseconds,
            encode_ms: header.encodeMilliseconds,
            coefficients_applied: header.coefficientsApplied,
            payload_bytes: header.payloadBytes,
            coefficients_remaining: header.coefficientsPending,
        }).toEqual(fields);
    });

    it.each(malformedVectors)("refuses $name", ({ field, hex, payload_bytes }) => {
        const parse = (): unknown => imageHeaderFromFrame(frameFromHex(hex, payload_bytes));
        expect(parse).toThrow(WireError);
        expect(parse).toThrow(expect.objectContaining({ field }));
    });
});

interface PatchVector {
    name: string;
    state: JsonObject;
    normalised: JsonObject;
    result: JsonObject;
}

const accepted = (patchVectors as unknown as Partial<PatchVector>[]).filter(
    (vector): vector is PatchVector => vector.result !== undefined,
);

/** One merge patch cannot remove an object and begin it anew (the server never says so). */
function removesWhatComesBack(first: JsonObject, second: JsonObject): boolean {
    return Object.entries(second).some(([key, value]) => {
        const before = first[key];
        if (!isObject(value) || before === undefined) return false;
        return before === null || (isObject(before) && removesWhatComesBack(before, value));
    });
}

describe("patches", () => {
    it.each(accepted)("$name: the normalised patch alone gives the result", (vector) => {
        expect(applyPatch(vector.state, vector.normalised)).toEqual(vector.result);
    });

    it("composes any two into one that does what both do", () => {
        let compared = 0;
        for (const { state, normalised: first } of accepted) {
            for (const { normalised: second } of accepted) {
                if (removesWhatComesBack(first, second)) continue;
                expect(applyPatch(state, composePatches(first, second))).toEqual(
                    applyPatch(applyPatch(state, first), second),
                );
                ++compared;
            }
        }
        expect(compared).toBeGreaterThan(accepted.length ** 2 * 0.9);
    });
});

describe("names", () => {
    it("takes and refuses what the server does", () => {
        expect(nameVectors.valid.filter((name) => !isName(name))).toEqual([]);
        expect(nameVectors.invalid.filter((name) => isName(name))).toEqual([]);
    });
});

describe("display", () => {
    it("gives the code values of the reference", () => {
        for (const { linear, exposure_stops, tone, code } of displayVectors) {
            const value = displayFromLinear(linear, { exposure_stops, tone: tone as DisplayTone });
            // The reference computes in single precision: a value on the border may round over.
            expect(Math.abs(255 * value - code)).toBeLessThanOrEqual(0.5 + 1e-3);
        }
    });
});
