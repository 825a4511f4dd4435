/**
 * The light as the scene sees it: a lat-long picture in world directions, made from the previews
 * of the environment and of the one blended with it. Display-referred: a picture to find one's
 * way in, not to measure.
 */
import { linearFromSrgb, srgbFromLinear } from "./display";
import { directionFromPosition } from "./lat_long";
import { conjugate, matrixFromQuaternion } from "./rotation";
import type { Quaternion, RoomState, Triple } from "./wire/state";

export const kPictureWidth = 320;
export const kPictureHeight = 160;

export interface PictureSource {
    pixels: ImageData;
    weight: number;
}

/** What environment and blend are multiplied by: zero while a light is solo. */
export function environmentScale({ environment, lights }: RoomState): Triple {
    if (Object.values(lights).some((light) => light.solo)) return [0, 0, 0];
    return environment.tint.map((part) => part * environment.gain) as Triple;
}

export class LightPicture {
    private readonly directions = new Float32Array(kPictureWidth * kPictureHeight * 3);
    private readonly image = new ImageData(kPictureWidth, kPictureHeight);

    constructor() {
        for (let y = 0, i = 0; y < kPictureHeight; ++y) {
            for (let x = 0; x < kPictureWidth; ++x, i += 3) {
                const u = (x + 0.5) / kPictureWidth;
                const v = (y + 0.5) / kPictureHeight;
                this.directions.set(directionFromPosition({ u, v }), i);
            }
        }
    }

    /** The weights of `sources` sum to 1; all have the same size. `scale` is linear. */
    draw(sources: PictureSource[], rotation: Quaternion, scale: Triple): ImageData {
        const { data } = this.image;
        data.fill(0);
        for (let i = 3; i < data.length; i += 4) data[i] = 255;
        const first = sources[0];
        if (first === undefined) return this.image;
        const { width, height } = first.pixels;
        const [rx, ry, rz] = matrixFromQuaternion(conjugate(rotation));
        const { directions } = this;
        for (let i = 0, out = 0; i < directions.length; i += 3, out += 4) {
            const [x, y, z] = [directions[i]!, directions[i + 1]!, directions[i + 2]!];
            const sx = rx[0] * x + rx[1] * y + rx[2] * z;
            const sy = ry[0] * x + ry[1] * y + ry[2] * z;
            const sz = rz[0] * x + rz[1] * y + rz[2] * z;
            const column = (0.5 + Math.atan2(sx, -sz) / (2 * Math.PI)) * width;
            const row = (0.5 - Math.asin(Math.min(1, Math.max(-1, sy))) / Math.PI) * height;
            this.addSample(out, sources, column, row, width, height);
        }
        this.multiply(scale);
        return this.image;
    }

    private multiply(scale: Triple): void {
        if (scale.every((part) => part === 1)) return;
        const codes = scale.map((part) =>
            Uint8Array.from({ length: 256 }, (_, code) =>
                Math.round(
                    255 * srgbFromLinear(Math.min(1, part * linearFromSrgb(code / 255))),
                ),
            ),
        );
        const { data } = this.image;
        for (let i = 0; i < data.length; ++i) {
            if (i % 4 < 3) data[i] = codes[i % 4]![data[i]!]!;
        }
    }

    /** Bilinear; wraps across, stops at the poles. */
    private addSample(
        out: number,
        sources: PictureSource[],
        column: number,
        row: number,
        width: number,
        height: number,
    ): void {
        const left = Math.floor(column - 0.5);
        const top = Math.floor(row - 0.5);
        const right = column - 0.5 - left;
        const down = row - 0.5 - top;
        const x0 = ((left % width) + width) % width;
        const x1 = (x0 + 1) % width;
        const y0 = Math.max(0, top) * width;
        const y1 = Math.min(height - 1, top + 1) * width;
        const { data } = this.image;
        for (let c = 0; c < 3; ++c) {
            let value = 0;
            for (const { pixels, weight } of sources) {
                const p = pixels.data;
                const above =
                    p[(y0 + x0) * 4 + c]! * (1 - right) + p[(y0 + x1) * 4 + c]! * right;
                const below =
                    p[(y1 + x0) * 4 + c]! * (1 - right) + p[(y1 + x1) * 4 + c]! * right;
                value += weight * (above * (1 - down) + below * down);
            }
            data[out + c] = value;
        }
    }
}
