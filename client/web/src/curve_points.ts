/** Control points of a curve under the hand: [u, r, g, b] in rising u, at most 32. */
import type { ValueAxis } from "./curve_axes";
import type { Samples } from "./curve_stroke";
import { kCurveSamples } from "./wire/message";
import { clampTo } from "./wire/range";
import { kRanges } from "./wire/state";

export const kMostPoints = 32;
/** Nearer to each other no two points come. */
const kLeastGap = 1 / (kCurveSamples - 1);
/** On the logarithmic scale [protocol/curves.md §5]. */
const kLeastLogarithmicValue = 1e-6;
const kPointsOfCurve = 8;
/** Of the axis's height: what is no further off is straight. */
const kStraight = 1e-3;
/** Of the highest value: what lies below does not tell on the logarithmic scale. */
const kFloor = 1e-6;

export type Points = readonly (readonly number[])[];

/** Points that a curve nearly passes: each next one where straight lines are farthest off. */
export function pointsFromSamples(samples: Samples, scale: ValueAxis): number[][] {
    const last = samples.length - 1;
    const highest = Math.max(kLeastLogarithmicValue, ...samples.map((rgb) => Math.max(...rgb)));
    const height = (value: number): number =>
        scale === "linear"
            ? value / highest
            : 1 - Math.log10(Math.max(value / highest, kFloor)) / Math.log10(kFloor);
    const heights = samples.map((rgb) => rgb.map(height));
    const off = (a: number, k: number, b: number): number =>
        Math.max(
            ...heights[k]!.map((value, c) => {
                const [from, to] = [heights[a]![c]!, heights[b]![c]!];
                return Math.abs(value - from - ((k - a) / (b - a)) * (to - from));
            }),
        );
    const chosen = [0, last];
    while (chosen.length < kPointsOfCurve) {
        let [worst, at] = [kStraight, -1];
        for (let i = 0; i + 1 < chosen.length; ++i) {
            const [a, b] = [chosen[i]!, chosen[i + 1]!];
            for (let k = a + 1; k < b; ++k) {
                const distance = off(a, k, b);
                if (distance > worst) [worst, at] = [distance, k];
            }
        }
        if (at < 0) break;
        chosen.push(at);
        chosen.sort((a, b) => a - b);
    }
    return chosen.map((k) => [k / last, ...samples[k]!]);
}

export function withPointMoved(
    points: Points,
    index: number,
    u: number,
    rgb: readonly number[],
): number[][] {
    const before = points[index - 1]?.[0];
    const after = points[index + 1]?.[0];
    const lowest = before === undefined ? 0 : before + kLeastGap;
    const highest = after === undefined ? 1 : after - kLeastGap;
    const place = Math.min(highest, Math.max(lowest, u));
    return points.map((point, i) => (i === index ? [place, ...rgb] : [...point]));
}

/** Null where the points are as many as there may be, or one stands there. */
export function withPointAdded(
    points: Points,
    u: number,
    rgb: readonly number[],
): { points: number[][]; index: number } | null {
    const isTaken = points.some((point) => Math.abs(point[0]! - u) < kLeastGap);
    if (points.length >= kMostPoints || isTaken) return null;
    const index = points.filter((point) => point[0]! < u).length;
    const next = points.map((point) => [...point]);
    next.splice(index, 0, [u, ...rgb]);
    return { points: next, index };
}

export function withoutPoint(points: Points, index: number): number[][] {
    return points.filter((_, i) => i !== index).map((point) => [...point]);
}

/** As the server takes them: in six digits, and on the logarithmic scale above 0. */
export function pointsForScale(points: Points, scale: ValueAxis): number[][] {
    const lowest = scale === "logarithmic" ? kLeastLogarithmicValue : 0;
    const range = { lowest, highest: kRanges.materials.points.highest };
    return points.map(([u, ...rgb]) => [
        u!,
        ...rgb.map((value) => Number(clampTo(range, value).toPrecision(6))),
    ]);
}
