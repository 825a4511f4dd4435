/**
 * From linear radiance to what a screen takes [protocol/README.md §3.2]: exposure, tone curve,
 * sRGB transfer curve. image_shader.ts says the same in GLSL; a test holds the two together.
 */
import { floatFromHalf } from "./wire/half_float";
import type { DisplayState, DisplayTone } from "./wire/state";

export function sameDisplay(a: DisplayState, b: DisplayState): boolean {
    return a.exposure_stops === b.exposure_stops && a.tone === b.tone;
}

function clampToUnit(value: number): number {
    return value > 0 ? Math.min(value, 1) : 0; // also takes NaN to 0
}

/** Filmic tone curve [Narkowicz16]. */
function filmic(x: number): number {
    return (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
}

export function srgbFromLinear(x: number): number {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
}

/** Both directions are needed: colours are picked in sRGB and sent linear. */
export function linearFromSrgb(x: number): number {
    return x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
}

/** Display value in [0, 1] of one linear channel. */
export function displayFromLinear(linear: number, display: DisplayState): number {
    // Beyond this filmic is 1 to double precision, and x² cannot overflow.
    const x = Math.min(Math.max(linear * 2 ** display.exposure_stops, 0), 1e12);
    return srgbFromLinear(clampToUnit(display.tone === "filmic" ? filmic(x) : x));
}

/** Code value 0 … 255 of every half float, by its bits. */
export class DisplayTable {
    readonly codes = new Uint8Array(65536);
    private exposureStops = NaN;
    private tone: DisplayTone | null = null;

    update(display: DisplayState): void {
        if (display.exposure_stops === this.exposureStops && display.tone === this.tone) return;
        this.exposureStops = display.exposure_stops;
        this.tone = display.tone;
        for (let bits = 0; bits < 65536; ++bits) {
            const value = displayFromLinear(floatFromHalf(bits), display);
            this.codes[bits] = Math.floor(255 * value + 0.5);
        }
    }
}

/** Display pixels over black of interleaved R G B A halves; alpha is 255 throughout. */
export function pixelsFromHalves(
    rgba: Uint16Array,
    width: number,
    height: number,
    table: DisplayTable,
): ImageData {
    const image = new ImageData(width, height);
    const { data } = image;
    const { codes } = table;
    for (let i = 0; i < data.length; i += 4) {
        data[i] = codes[rgba[i]!]!;
        data[i + 1] = codes[rgba[i + 1]!]!;
        data[i + 2] = codes[rgba[i + 2]!]!;
        data[i + 3] = 255;
    }
    return image;
}

/** Display pixels with straight alpha, for files: colour is un-premultiplied before the curve. */
export function straightPixelsFromHalves(
    rgba: Uint16Array,
    width: number,
    height: number,
    display: DisplayState,
): ImageData {
    const image = new ImageData(width, height);
    const { data } = image;
    for (let i = 0; i < data.length; i += 4) {
        const alpha = clampToUnit(floatFromHalf(rgba[i + 3]!));
        if (alpha === 0) continue;
        for (let c = 0; c < 3; ++c) {
            const linear = floatFromHalf(rgba[i + c]!) / alpha;
            data[i + c] = Math.floor(255 * displayFromLinear(linear, display) + 0.5);
        }
        data[i + 3] = Math.floor(255 * alpha + 0.5);
    }
    return image;
}
