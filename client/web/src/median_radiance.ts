/** How bright a settled image is, whatever suns and black surrounds it holds. */
import type { SettledImage } from "./image_view";
import { floatFromHalf } from "./wire/half_float";

const kMostSamples = 20_000;

/** Median luminance of the pixels that are not black, linear Rec. 709; 0 where all are. */
export function medianRadiance({ header, rgba }: SettledImage): number {
    const count = header.width * header.height;
    const step = Math.max(1, Math.ceil(count / kMostSamples));
    const values: number[] = [];
    for (let i = 0; i < count; i += step) {
        const [r, g, b] = [0, 1, 2].map((c) => floatFromHalf(rgba[i * 4 + c]!));
        const luminance = 0.2126 * r! + 0.7152 * g! + 0.0722 * b!;
        if (luminance > 0) values.push(luminance);
    }
    values.sort((a, b) => a - b);
    return values[values.length >> 1] ?? 0;
}
