import { describe, expect, it } from "vitest";
import { displayFromLinear, linearFromSrgb, srgbFromLinear } from "../src/display";
import { floatFromHalf } from "../src/wire/half_float";
import { interleavePlanes, kHalfOne, rgbaHalvesFromPayload } from "../src/wire/half_planes";
import { WireError } from "../src/wire/message";

/** A zstd frame of one uncompressed block, stating its content size [RFC 8878 §3.1.1]. */
function zstdFrame(content: number[]): Uint8Array {
    const blockHeader = 1 | (content.length << 3);
    return Uint8Array.from([
        0x28,
        0xb5,
        0x2f,
        0xfd,
        0x20,
        content.length,
        blockHeader & 255,
        (blockHeader >> 8) & 255,
        blockHeader >> 16,
        ...content,
    ]);
}

describe("half floats", () => {
    it.each([
        [0x0000, 0],
        [0x3c00, 1],
        [0xc000, -2],
        [0x7bff, 65504],
        [0x0001, 2 ** -24],
        [0x0400, 2 ** -14],
        [0x3555, 0.333251953125],
    ])("%i is %f", (bits, value) => expect(floatFromHalf(bits)).toBe(value));

    it("knows infinity and NaN", () => {
        expect(floatFromHalf(0x7c00)).toBe(Infinity);
        expect(floatFromHalf(0x7e00)).toBeNaN();
    });
});

describe("half planes", () => {
    // 2×1 pixels; of each plane the low bytes, then the high bytes.
    const planes = [0x01, 0x02, 0x11, 0x12, 0x03, 0x04, 0x13, 0x14, 0x05, 0x06, 0x15, 0x16];

    it("interleaves three planes with alpha 1", () => {
        expect([...interleavePlanes(Uint8Array.from(planes), 2, 3)]).toEqual([
            0x1101,
            0x1303,
            0x1505,
            kHalfOne,
            0x1202,
            0x1404,
            0x1606,
            kHalfOne,
        ]);
    });

    it("interleaves four planes, out of their zstd frame", () => {
        const payload = zstdFrame([...planes, 0x00, 0x00, 0x3c, 0x38]);
        expect([...rgbaHalvesFromPayload(payload, 2, 1, true)]).toEqual([
            0x1101, 0x1303, 0x1505, 0x3c00, 0x1202, 0x1404, 0x1606, 0x3800,
        ]);
    });

    it("refuses planes that are too short or too long", () => {
        const short = zstdFrame(planes.slice(1));
        expect(() => rgbaHalvesFromPayload(short, 2, 1, false)).toThrow(WireError);
        const long = zstdFrame([...planes, 0]);
        expect(() => rgbaHalvesFromPayload(long, 2, 1, false)).toThrow(WireError);
    });

    it("refuses what is no whole zstd frame", () => {
        const noise = Uint8Array.from({ length: 40 }, (_, i) => i);
        expect(() => rgbaHalvesFromPayload(noise, 2, 1, false)).toThrow(WireError);
        const whole = zstdFrame(planes);
        for (let bytes = 0; bytes < whole.length; ++bytes) {
            expect(() =>
                rgbaHalvesFromPayload(whole.subarray(0, bytes), 2, 1, false),
            ).toThrow();
        }
    });
});

describe("display", () => {
    it("is monotonic and stays in [0, 1] at any exposure", () => {
        for (const tone of ["filmic", "linear"] as const) {
            for (const exposure_stops of [-20, 0, 20]) {
                let previous = 0;
                for (let bits = 0; bits < 0x7c00; bits += 7) {
                    const value = displayFromLinear(floatFromHalf(bits), {
                        exposure_stops,
                        tone,
                    });
                    expect(value).toBeGreaterThanOrEqual(previous);
                    expect(value).toBeLessThanOrEqual(1);
                    previous = value;
                }
            }
        }
    });

    it("shows black for what is no light", () => {
        for (const linear of [-1, NaN, -Infinity]) {
            expect(displayFromLinear(linear, { exposure_stops: 0, tone: "filmic" })).toBe(0);
        }
    });

    it("inverts the sRGB curve", () => {
        for (let code = 0; code <= 255; ++code) {
            expect(srgbFromLinear(linearFromSrgb(code / 255))).toBeCloseTo(code / 255, 9);
        }
    });
});
