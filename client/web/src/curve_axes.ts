/** From a curve's u and values to places in the picture of it, and back. */
import { degreeTicks, uFromDegrees } from "./curve_angle";
import type { Triple } from "./wire/state";

export type ValueAxis = "linear" | "logarithmic";

/** In CSS pixels: where the curve is drawn, the labels outside it. */
export interface PlotBox {
    left: number;
    top: number;
    width: number;
    height: number;
}

/** Decades that a logarithmic axis shows below its highest value. */
const kDecades = 6;
const kHeadroom = 1.15;
const kLeastHighest = 1e-3;

/** A whole axis above the highest value: 1, 2 or 5 times a power of ten. */
export function axisEnd(highest: number): number {
    const wanted = Math.max(kLeastHighest, highest) * kHeadroom;
    const decade = 10 ** Math.floor(Math.log10(wanted));
    return [1, 2, 5, 10].map((times) => times * decade).find((end) => end >= wanted)!;
}

export class CurveAxes {
    constructor(
        readonly box: PlotBox,
        readonly kind: ValueAxis,
        readonly highest: number,
    ) {}

    /** Below it a logarithmic axis shows nothing; hands draw 0 there. */
    get lowest(): number {
        return this.kind === "linear" ? 0 : this.highest / 10 ** kDecades;
    }

    x(u: number): number {
        return this.box.left + u * this.box.width;
    }

    y(value: number): number {
        const { top, height } = this.box;
        return top + height * (1 - Math.min(1, Math.max(0, this.part(value))));
    }

    u(x: number): number {
        return Math.min(1, Math.max(0, (x - this.box.left) / this.box.width));
    }

    value(y: number): number {
        const part = Math.min(1, Math.max(0, 1 - (y - this.box.top) / this.box.height));
        if (this.kind === "linear") return this.highest * part;
        return part === 0 ? 0 : this.lowest * 10 ** (kDecades * part);
    }

    valueTicks(): number[] {
        const { highest } = this;
        if (this.kind === "linear") return [0, 0.25, 0.5, 0.75, 1].map((part) => part * highest);
        return Array.from({ length: kDecades + 1 }, (_, i) => highest / 10 ** i).reverse();
    }

    angleTicks(angle: string): { degrees: number; x: number }[] {
        return degreeTicks(angle).map((degrees) => ({
            degrees,
            x: this.x(uFromDegrees(angle, degrees)),
        }));
    }

    private part(value: number): number {
        if (this.kind === "linear") return value / this.highest;
        return value <= this.lowest ? 0 : Math.log10(value / this.lowest) / kDecades;
    }
}

export function highestOf(samples: readonly (readonly number[])[], tint: Triple): number {
    let highest = 0;
    for (const rgb of samples) rgb.forEach((v, c) => (highest = Math.max(highest, v * tint[c]!)));
    return highest;
}
