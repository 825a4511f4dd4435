/**
 * What a hand draws over a curve. A drag becomes one stroke that grows, so that the latest one of
 * a drag stands for all before it: edits that wait may then be merged.
 */
import { kCurveSamples } from "./wire/message";
import { clampTo } from "./wire/range";
import { kRanges, type Triple } from "./wire/state";

export type Samples = readonly (readonly number[])[];
/** Colours that a hand changes. */
export type Channels = readonly [boolean, boolean, boolean];

/** As the wire has it: values at even distances from u = from to u = to. */
export interface Stroke {
    from: number;
    to: number;
    values: Triple[];
}

const kLast = kCurveSamples - 1;

/** Samples with a stroke laid over them [protocol/curves.md §6, without softness]. */
export function withStroke(samples: Samples, { from, to, values }: Stroke): number[][] {
    return samples.map((rgb, k) => {
        const u = k / kLast;
        if (u < from || u > to || values.length === 0) return [...rgb];
        const place = to > from ? ((u - from) / (to - from)) * (values.length - 1) : 0;
        const i = Math.min(Math.floor(place), values.length - 1);
        const [a, b] = [values[i]!, values[Math.min(i + 1, values.length - 1)]!];
        return a.map((value, c) => value + (place - i) * (b[c]! - value));
    });
}

function rounded(value: number): number {
    return Number(value.toPrecision(6));
}

/** A drag over a curve, sample by sample. */
export class DrawnStroke {
    private readonly drawn: number[][];
    private first = kCurveSamples;
    private last = -1;
    private at: { k: number; value: number } | null = null;

    constructor(
        private readonly before: Samples,
        /** The colour that a hand asks for with a value, where the curve had `rgb`. */
        private readonly colour: (value: number, rgb: readonly number[]) => Triple,
    ) {
        this.drawn = before.map((rgb) => [...rgb]);
    }

    /** On to (u, value), by a straight line from where the hand was. */
    draw(u: number, value: number): void {
        const k = Math.round(u * kLast);
        const from = this.at ?? { k, value };
        const step = k >= from.k ? 1 : -1;
        for (let i = from.k; ; i += step) {
            const way = k === from.k ? 1 : (i - from.k) / (k - from.k);
            this.put(i, from.value + way * (value - from.value));
            if (i === k) break;
        }
        this.at = { k, value };
    }

    /** Null before anything is drawn. */
    get stroke(): Stroke | null {
        if (this.last < 0) return null;
        return {
            from: this.first / kLast,
            to: this.last / kLast,
            values: this.drawn
                .slice(this.first, this.last + 1)
                .map((rgb) => rgb.map(rounded) as Triple),
        };
    }

    private put(k: number, value: number): void {
        this.drawn[k] = this.colour(value, this.before[k]!);
        this.first = Math.min(this.first, k);
        this.last = Math.max(this.last, k);
    }
}

/**
 * The curve moved around u by a factor, most in the middle of a brush of `radius` in u. Where it
 * is 0, `least` is what it begins with.
 */
export function raised(
    samples: Samples,
    u: number,
    radius: number,
    factor: number,
    { channels, least }: { channels: Channels; least: number },
): Stroke | null {
    return brushed(samples, u, radius, (rgb, weight) =>
        rgb.map((value, c) => {
            if (channels[c] !== true) return value;
            return Math.max(value, factor > 1 ? least : 0) * factor ** weight;
        }),
    );
}

/** Samples around u made smoother by a brush of `radius` in u. */
export function smoothed(
    samples: Samples,
    u: number,
    radius: number,
    channels: Channels,
): Stroke | null {
    return brushed(samples, u, radius, (rgb, weight, k) =>
        rgb.map((value, c) =>
            channels[c] === true ? value + weight * (meanAround(samples, k, c) - value) : value,
        ),
    );
}

/** Null where the brush covers less than two samples. */
function brushed(
    samples: Samples,
    u: number,
    radius: number,
    change: (rgb: readonly number[], weight: number, k: number) => number[],
): Stroke | null {
    const first = Math.max(0, Math.ceil((u - radius) * kLast));
    const last = Math.min(kLast, Math.floor((u + radius) * kLast));
    if (last <= first) return null;
    const values: Triple[] = [];
    for (let k = first; k <= last; ++k) {
        const distance = Math.abs(k / kLast - u) / radius;
        const weight = Math.max(0, 1 - distance * distance);
        const rgb = change(samples[k]!, weight, k);
        values.push(rgb.map((v) => rounded(clampTo(kRanges.materials.samples, v))) as Triple);
    }
    return { from: first / kLast, to: last / kLast, values };
}

function meanAround(samples: Samples, k: number, c: number): number {
    const weights = [1, 4, 6, 4, 1];
    let [sum, total] = [0, 0];
    weights.forEach((weight, i) => {
        const other = Math.min(kLast, Math.max(0, k + 2 * (i - 2)));
        sum += weight * samples[other]![c]!;
        total += weight;
    });
    return sum / total;
}
