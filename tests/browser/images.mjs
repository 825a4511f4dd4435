/** Reading and comparing images. What the page computes is computed here again, on its own. */
import { readFile } from "node:fs/promises";
import { FloatType } from "three";
import { EXRLoader } from "three/addons/loaders/EXRLoader.js";

/** `{width, height, rgb}`: linear floats, row by row from the top left. */
export async function readExr(path) {
    const bytes = await readFile(path);
    const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
    const { width, height, data } = new EXRLoader().setDataType(FloatType).parse(buffer);
    const channels = data.length / (width * height);
    const rgb = new Float32Array(width * height * 3);
    for (let y = 0; y < height; ++y) {
        // The loader gives textures: bottom row first.
        const row = (height - 1 - y) * width;
        for (let x = 0; x < width; ++x) {
            for (let c = 0; c < 3; ++c) {
                rgb[(y * width + x) * 3 + c] = data[(row + x) * channels + c];
            }
        }
    }
    return { width, height, rgb };
}

export function floatFromHalf(bits) {
    const exponent = (bits >> 10) & 31;
    const fraction = bits & 1023;
    const magnitude =
        exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15);
    return bits & 0x8000 ? -magnitude : magnitude;
}

export function relativeL2(image, reference) {
    let difference = 0;
    let norm = 0;
    for (let i = 0; i < reference.length; ++i) {
        difference += (image[i] - reference[i]) ** 2;
        norm += reference[i] ** 2;
    }
    return Math.sqrt(difference / norm);
}

/** Code value of a linear channel, by the formula of protocol/README.md §3.2. */
export function codeFromLinear(linear, { exposure_stops, tone }) {
    const x = Math.max(0, linear) * 2 ** exposure_stops;
    const curve =
        tone === "filmic" ? (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14) : x;
    const unit = Math.min(1, Math.max(0, curve));
    const srgb = unit <= 0.0031308 ? 12.92 * unit : 1.055 * unit ** (1 / 2.4) - 0.055;
    return Math.floor(255 * srgb + 0.5);
}

/** Largest distance in code values between R G B A pixels and the developed linear image. */
export function largestCodeDistance(pixels, rgb, display) {
    let largest = 0;
    for (let i = 0, p = 0; i < rgb.length; i += 3, p += 4) {
        for (let c = 0; c < 3; ++c) {
            const distance = Math.abs(pixels[p + c] - codeFromLinear(rgb[i + c], display));
            largest = Math.max(largest, distance);
        }
    }
    return largest;
}
