import { describe, expect, it } from "vitest";
import { degreesFromU, degreeTicks, uFromDegrees } from "../src/curve_angle";
import { axisEnd, CurveAxes } from "../src/curve_axes";
import {
    kMostPoints,
    pointsForScale,
    pointsFromSamples,
    withoutPoint,
    withPointAdded,
    withPointMoved,
} from "../src/curve_points";
import { DrawnStroke, raised, type Samples, smoothed, withStroke } from "../src/curve_stroke";
import type { Triple } from "../src/wire/state";

const kAngles = ["half", "difference", "incidence", "viewing", "reflection", "along_u", "along_v"];
const kAll = [true, true, true] as const;
const kBox = { left: 40, top: 10, width: 300, height: 200 };

function curve(value: (u: number) => number): number[][] {
    return Array.from({ length: 256 }, (_, k) => Array<number>(3).fill(value(k / 255)));
}

function roughness(samples: Samples): number {
    let sum = 0;
    for (let k = 1; k + 1 < samples.length; ++k)
        sum += Math.abs(samples[k - 1]![0]! - 2 * samples[k]![0]! + samples[k + 1]![0]!);
    return sum;
}

describe("the angle axis", () => {
    it.each(kAngles)("takes u to degrees and back: %s", (angle) => {
        for (let u = 0; u <= 1; u += 1 / 64)
            expect(uFromDegrees(angle, degreesFromU(angle, u))).toBeCloseTo(u, 12);
        expect(degreesFromU(angle, 1)).toBe(90);
        expect(degreeTicks(angle)[0]).toBe(0);
        expect(degreeTicks(angle).at(-1)).toBe(90);
    });

    it("gives narrow highlights most of the axis, but not the angles of Fresnel's curve", () => {
        expect(degreesFromU("half", 0.5)).toBe(22.5);
        expect(degreesFromU("difference", 0.5)).toBe(45);
    });
});

describe("the value axis", () => {
    it("ends above the highest value at 1, 2 or 5 times a power of ten", () => {
        expect(axisEnd(0.9)).toBe(2);
        expect(axisEnd(0.4)).toBe(0.5);
        expect(axisEnd(310)).toBe(500);
        expect(axisEnd(900)).toBe(2000);
        expect(axisEnd(0)).toBeGreaterThan(0);
    });

    it.each(["linear", "logarithmic"] as const)("takes values to places and back: %s", (kind) => {
        const axes = new CurveAxes(kBox, kind, 50);
        for (const value of [0.001, 0.5, 7, 50])
            expect(axes.value(axes.y(value))).toBeCloseTo(value, 9);
        for (const u of [0, 0.3, 1]) expect(axes.u(axes.x(u))).toBeCloseTo(u, 12);
        expect(axes.value(kBox.top + kBox.height)).toBe(0);
        expect(axes.value(-1000)).toBeCloseTo(50, 9);
        expect(axes.u(-1000)).toBe(0);
    });
});

describe("a stroke", () => {
    it("changes the samples from one end to the other, and no others", () => {
        const before = curve(() => 1);
        const stroke = { from: 51 / 255, to: 102 / 255, values: [[2, 2, 2], [4, 0, 3]] as Triple[] };
        const after = withStroke(before, stroke);
        expect(after[50]).toEqual([1, 1, 1]);
        expect(after[51]).toEqual([2, 2, 2]);
        expect(after[102]).toEqual([4, 0, 3]);
        expect(after[103]).toEqual([1, 1, 1]);
        const half = withStroke(before, { ...stroke, to: 53 / 255 })[52]!;
        half.forEach((value, c) => expect(value).toBeCloseTo([3, 1, 2.5][c]!, 12));
        expect(before[60]).toEqual([1, 1, 1]);
    });

    it("grows with the drag: the latest one stands for all before it", () => {
        const before = curve((u) => 1 - u);
        const drawn = new DrawnStroke(before, (value) => [value, value, value]);
        expect(drawn.stroke).toBeNull();
        drawn.draw(0.5, 3);
        const first = withStroke(before, drawn.stroke!);
        drawn.draw(0.4, 5);
        drawn.draw(0.6, 1);
        const latest = drawn.stroke!;
        const whole = withStroke(before, latest);
        withStroke(first, latest).forEach((rgb, k) =>
            rgb.forEach((value, c) => expect(value).toBeCloseTo(whole[k]![c]!, 9)),
        );
        expect(whole[102]![0]).toBeCloseTo(5, 5);
        expect(whole[153]![0]).toBeCloseTo(1, 5);
        expect(whole[101]).toEqual(before[101]);
        // The hand went over 0.5 twice: what it did last counts.
        expect(whole[128]![0]).toBeLessThan(5);
    });

    it("reaches both ends, and one sample where the hand does not move", () => {
        const drawn = new DrawnStroke(curve(() => 0), () => [1, 2, 3]);
        drawn.draw(0, 1);
        expect(drawn.stroke).toEqual({ from: 0, to: 0, values: [[1, 2, 3]] });
        expect(withStroke(curve(() => 0), drawn.stroke!)[0]).toEqual([1, 2, 3]);
        drawn.draw(1, 1);
        expect(drawn.stroke!.values).toHaveLength(256);
    });

    it("smooths a jagged curve under the brush and leaves a straight one as it is", () => {
        const jagged = curve((u) => 1 + (Math.round(u * 255) % 4 < 2 ? 0.5 : 0));
        const after = withStroke(jagged, smoothed(jagged, 0.5, 0.2, kAll)!);
        expect(roughness(after)).toBeLessThan(roughness(jagged));
        expect(after[10]).toEqual(jagged[10]);
        const line = curve((u) => 2 * u);
        withStroke(line, smoothed(line, 0.5, 0.1, kAll)!).forEach((rgb, k) =>
            expect(rgb[0]).toBeCloseTo(line[k]![0]!, 5),
        );
    });

    it("changes only the colours that are chosen", () => {
        const before = curve(() => 1);
        const brush = { channels: [false, true, false] as const, least: 0.1 };
        const after = withStroke(before, raised(before, 0.5, 0.1, 2, brush)!);
        expect(after[128]![0]).toBe(1);
        expect(after[128]![1]).toBeGreaterThan(1.9);
        const dark = curve(() => 0);
        const lit = withStroke(dark, raised(dark, 0.5, 0.1, 2, { channels: kAll, least: 0.1 })!);
        expect(lit[128]![2]).toBeGreaterThan(0);
    });
});

describe("control points", () => {
    it("begin where the curve is, at both ends and where it bends", () => {
        const samples = curve((u) => Math.exp(-30 * u * u));
        for (const scale of ["linear", "logarithmic"] as const) {
            const points = pointsFromSamples(samples, scale);
            expect(points.length).toBeGreaterThan(3);
            expect(points[0]![0]).toBe(0);
            expect(points.at(-1)![0]).toBe(1);
            for (const [u, r] of points) {
                expect(r).toBe(samples[Math.round(u! * 255)]![0]);
            }
        }
        expect(pointsFromSamples(curve((u) => 3 * u), "linear")).toHaveLength(2);
    });

    it("pass each other never, and stay between 0 and 1", () => {
        const points = [
            [0, 1, 1, 1],
            [0.5, 2, 2, 2],
            [1, 0, 0, 0],
        ];
        expect(withPointMoved(points, 1, 7, [3, 3, 3])[1]![0]).toBeLessThan(1);
        expect(withPointMoved(points, 1, -7, [3, 3, 3])[1]![0]).toBeGreaterThan(0);
        expect(withPointMoved(points, 0, -7, [3, 3, 3])[0]).toEqual([0, 3, 3, 3]);
        expect(withoutPoint(points, 1)).toHaveLength(2);
        expect(withPointAdded(points, 0.75, [9, 9, 9])!.index).toBe(2);
        expect(withPointAdded(points, 0.5, [9, 9, 9])).toBeNull();
        const many = Array.from({ length: kMostPoints }, (_, i) => [i / 40, 1, 1, 1]);
        expect(withPointAdded(many, 0.99, [1, 1, 1])).toBeNull();
    });

    it("are above 0 on the logarithmic scale, as the server asks", () => {
        expect(pointsForScale([[0, 0, 1 / 3, 2e6]], "logarithmic")).toEqual([
            [0, 1e-6, 0.333333, 1e6],
        ]);
        expect(pointsForScale([[0, 0, -1, 1]], "linear")).toEqual([[0, 0, 0, 1]]);
    });
});
