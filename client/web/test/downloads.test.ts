import { describe, expect, it } from "vitest";
import { exrFromSettled } from "../src/exr";
import type { SettledImage } from "../src/image_view";
import { keptInSight, zoomedAbout } from "../src/image_zoom";
import { medianRadiance } from "../src/median_radiance";
import { editDistance, nearNames } from "../src/near_names";

function imageOf(
    width: number,
    height: number,
    hasAlpha: boolean,
    bits: (i: number) => number,
): SettledImage {
    const rgba = Uint16Array.from({ length: width * height * 4 }, (_, i) => bits(i));
    return {
        kind: "half",
        header: { width, height, hasAlpha },
        rgba,
    } as unknown as SettledImage;
}

/** Reads what the OpenEXR file layout says, on its own. */
async function readExr(blob: Blob): Promise<{ comments: string; data: DataView }> {
    const bytes = new Uint8Array(await blob.arrayBuffer());
    const view = new DataView(bytes.buffer);
    expect(view.getInt32(0, true)).toBe(20000630);
    expect(view.getInt32(4, true)).toBe(2);
    let at = 8;
    const text = (): string => {
        const end = bytes.indexOf(0, at);
        const found = new TextDecoder().decode(bytes.subarray(at, end));
        at = end + 1;
        return found;
    };
    const attributes = new Map<string, number>(); // where their values begin
    let comments = "";
    for (let name = text(); name !== ""; name = text()) {
        text();
        const size = view.getInt32(at, true);
        attributes.set(name, at + 4);
        if (name === "comments")
            comments = new TextDecoder().decode(bytes.subarray(at + 4, at + 4 + size));
        at += 4 + size;
    }
    const window = attributes.get("dataWindow")!;
    const width = view.getInt32(window + 8, true) + 1;
    const height = view.getInt32(window + 12, true) + 1;
    const channels = bytes[attributes.get("channels")!] === 65 ? 4 : 3; // begins with A
    const data = new Uint8Array(width * height * channels * 2);
    for (let row = 0; row < height; row += 16, at += 8) {
        const offset = Number(view.getBigUint64(at, true));
        expect(view.getInt32(offset, true)).toBe(row);
        const size = view.getInt32(offset + 4, true);
        const packed = bytes.slice(offset + 8, offset + 8 + size);
        const rawBytes = Math.min(16, height - row) * width * channels * 2;
        const begin = row * width * channels * 2;
        data.set(size === rawBytes ? packed : await unpacked(packed, rawBytes), begin);
    }
    return { comments, data: new DataView(data.buffer) };
}

async function unpacked(packed: Uint8Array<ArrayBuffer>, size: number): Promise<Uint8Array> {
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    const apart = new Uint8Array(await new Response(stream).arrayBuffer());
    expect(apart.length).toBe(size);
    for (let i = 1; i < size; ++i) apart[i] = apart[i - 1]! + apart[i]! - 128;
    const half = (size + 1) >> 1;
    return apart.map((_, i) => apart[i % 2 === 0 ? i / 2 : half + (i - 1) / 2]!);
}

describe("EXR", () => {
    const smooth = (i: number): number => 0x3000 + (i >> 4);
    let seed = 1;
    const noise = (): number => (seed = (seed * 16807) % 2147483647) & 0x7bff;
    it.each([
        [5, 3, false, smooth],
        [40, 37, true, smooth],
        [33, 16, false, noise],
        [1, 1, true, noise],
    ])("%i × %i, alpha %s: every bit comes back", async (width, height, hasAlpha, bits) => {
        const image = imageOf(width, height, hasAlpha, bits);
        const { comments, data } = await readExr(await exrFromSettled(image, "a comment"));
        expect(comments).toBe("a comment");
        const order = hasAlpha ? [3, 2, 1, 0] : [2, 1, 0];
        let at = 0;
        for (let y = 0; y < height; ++y) {
            for (const c of order) {
                for (let x = 0; x < width; ++x, at += 2) {
                    expect(data.getUint16(at, true)).toBe(image.rgba[(y * width + x) * 4 + c]);
                }
            }
        }
        expect(data.byteLength).toBe(at);
    });
});

describe("medianRadiance", () => {
    it("ignores black surrounds and suns", () => {
        const bits = [0, 0x3800, 0x7bff]; // 0, 0.5, 65504
        const pixel = (i: number): number => bits[i >> 2 < 60 ? 0 : i >> 2 < 99 ? 1 : 2]!;
        expect(medianRadiance(imageOf(10, 10, false, pixel))).toBeCloseTo(0.5, 6);
        expect(medianRadiance(imageOf(4, 4, false, () => 0))).toBe(0);
    });
});

describe("zoom", () => {
    const limits = { least: 0.5, most: 20 };

    it("leaves the point under the pointer where it is", () => {
        const before = { scale: 2, x: 30, y: -10 };
        const point = { x: 100, y: 50 };
        const after = zoomedAbout(before, point, 1.5, limits);
        expect(after.scale).toBe(3);
        const onImage = (zoom: typeof before) => [
            (point.x - zoom.x) / zoom.scale,
            (point.y - zoom.y) / zoom.scale,
        ];
        onImage(after).forEach((part, i) => expect(part).toBeCloseTo(onImage(before)[i]!, 9));
    });

    it("stays within its limits and in sight", () => {
        const fit = { scale: 1, x: 0, y: 0 };
        expect(zoomedAbout(fit, { x: 0, y: 0 }, 1000, limits).scale).toBe(20);
        expect(zoomedAbout(fit, { x: 0, y: 0 }, 0, limits).scale).toBe(0.5);
        const lost = { scale: 2, x: 5000, y: -5000 };
        expect(keptInSight(lost, 300, 200)).toEqual({ scale: 2, x: 300, y: -200 });
    });
});

describe("near names", () => {
    it("counts slips", () => {
        for (const [a, b, slips] of [
            ["table", "table", 0],
            ["tabel", "table", 1],
            ["tble", "table", 1],
            ["", "abc", 3],
            ["kitten", "sitting", 3],
        ] as const) {
            expect(editDistance(a, b)).toBe(slips);
            expect(editDistance(b, a)).toBe(slips);
        }
    });

    it("names what may have been meant, nearest first", () => {
        const names = ["table", "varnished-table", "sponza", "Tables"];
        expect(nearNames("tabel", names)).toEqual(["table"]);
        expect(nearNames("TABLE", names)[0]).toBe("table");
        expect(nearNames("varnished", names)).toEqual(["varnished-table"]);
        expect(nearNames("zzz", names)).toEqual([]);
    });
});
