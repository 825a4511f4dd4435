/** The picture of a curve: axes, the curve, what it was before, points and the keyboard's place. */
import { CurveAxes } from "./curve_axes";
import type { Points } from "./curve_points";
import type { Channels, Samples } from "./curve_stroke";
import { make } from "./dom";
import { amountText } from "./format";
import type { Triple } from "./wire/state";

export interface CurvePicture {
    axes: CurveAxes;
    angle: string;
    samples: Samples;
    /** What multiplies the samples to give what shows. */
    tint: Triple;
    /** Samples times tint, before the latest step. */
    ghost: { samples: Samples; tint: Triple } | null;
    channels: Channels;
    points: Points | null;
    /** The chosen point; none is −1. */
    chosen: number;
    /** Where the keyboard works; null without the focus. */
    cursor: number | null;
}

const kColours = ["#ff7a70", "#6fd086", "#7aa8ff"];
const kWhite = "#f0f0f0";
const kMargin = { left: 44, right: 10, top: 10, bottom: 22 };

export class CurveCanvas {
    readonly element = make("canvas", "curve-canvas");
    private readonly style = getComputedStyle(document.documentElement);

    get box(): { left: number; top: number; width: number; height: number } {
        const { clientWidth, clientHeight } = this.element;
        return {
            left: kMargin.left,
            top: kMargin.top,
            width: Math.max(1, clientWidth - kMargin.left - kMargin.right),
            height: Math.max(1, clientHeight - kMargin.top - kMargin.bottom),
        };
    }

    draw(picture: CurvePicture): void {
        const { element } = this;
        const scale = devicePixelRatio;
        const [width, height] = [element.clientWidth, element.clientHeight];
        element.width = Math.round(width * scale);
        element.height = Math.round(height * scale);
        const context = element.getContext("2d");
        if (context === null) return;
        context.scale(scale, scale);
        this.drawAxes(context, picture);
        const { axes, samples, tint, ghost, channels } = picture;
        context.save();
        context.beginPath();
        context.rect(axes.box.left, axes.box.top - 2, axes.box.width, axes.box.height + 4);
        context.clip();
        if (ghost !== null) this.drawCurve(context, axes, ghost.samples, ghost.tint, null);
        this.drawCurve(context, axes, samples, tint, channels);
        context.restore();
        if (picture.cursor !== null) this.drawCursor(context, axes, picture.cursor);
        if (picture.points !== null) this.drawPoints(context, picture, picture.points);
    }

    private colour(name: string): string {
        return this.style.getPropertyValue(name).trim();
    }

    private drawAxes(context: CanvasRenderingContext2D, { axes, angle }: CurvePicture): void {
        const { left, top, width, height } = axes.box;
        context.font = `10px ${this.colour("--font")}`;
        context.fillStyle = this.colour("--text-faint");
        context.strokeStyle = this.colour("--line");
        context.lineWidth = 1;
        const line = (x0: number, y0: number, x1: number, y1: number): void => {
            context.beginPath();
            context.moveTo(Math.round(x0) + 0.5, Math.round(y0) + 0.5);
            context.lineTo(Math.round(x1) + 0.5, Math.round(y1) + 0.5);
            context.stroke();
        };
        context.textAlign = "right";
        context.textBaseline = "middle";
        for (const value of axes.valueTicks()) {
            const y = axes.y(value);
            line(left, y, left + width, y);
            context.fillText(tickText(value), left - 6, y);
        }
        context.textAlign = "center";
        context.textBaseline = "top";
        let free = -Infinity;
        for (const { degrees, x } of axes.angleTicks(angle)) {
            line(x, top, x, top + height);
            const text = `${degrees}°`;
            const half = context.measureText(text).width / 2;
            if (x - half < free) continue;
            context.fillText(text, Math.min(x, left + width - half + 8), top + height + 6);
            free = x + half + 4;
        }
    }

    /** Without `channels` it is the ghost. One white line stands for colours that agree. */
    private drawCurve(
        context: CanvasRenderingContext2D,
        axes: CurveAxes,
        samples: Samples,
        tint: Triple,
        channels: Channels | null,
    ): void {
        const isGrey = samples.every(
            (rgb) =>
                Math.abs(rgb[0]! * tint[0] - rgb[1]! * tint[1]) <= 1e-6 * rgb[0]! * tint[0] &&
                Math.abs(rgb[0]! * tint[0] - rgb[2]! * tint[2]) <= 1e-6 * rgb[0]! * tint[0],
        );
        const last = samples.length - 1;
        for (const c of isGrey ? [0] : [0, 1, 2]) {
            context.strokeStyle = isGrey ? kWhite : kColours[c]!;
            const isMine = channels === null || isGrey || channels[c] === true;
            context.globalAlpha = channels === null ? 0.45 : isMine ? 1 : 0.4;
            context.lineWidth = channels === null ? 1 : 1.75;
            context.setLineDash(channels === null ? [4, 3] : []);
            context.beginPath();
            samples.forEach((rgb, k) => {
                context.lineTo(axes.x(k / last), axes.y(rgb[c]! * tint[c]!));
            });
            context.stroke();
        }
        context.globalAlpha = 1;
        context.setLineDash([]);
    }

    private drawCursor(context: CanvasRenderingContext2D, axes: CurveAxes, u: number): void {
        const { top, height } = axes.box;
        context.strokeStyle = this.colour("--focus");
        context.lineWidth = 1;
        context.beginPath();
        context.moveTo(axes.x(u), top);
        context.lineTo(axes.x(u), top + height);
        context.stroke();
    }

    private drawPoints(
        context: CanvasRenderingContext2D,
        { axes, tint, chosen, channels }: CurvePicture,
        points: Points,
    ): void {
        points.forEach((point, i) => {
            const y = axes.y(shownValue(point.slice(1), tint, channels));
            context.beginPath();
            context.arc(axes.x(point[0]!), y, i === chosen ? 6 : 4.5, 0, 2 * Math.PI);
            context.fillStyle = i === chosen ? this.colour("--focus") : kWhite;
            context.fill();
            context.strokeStyle = "#000000";
            context.stroke();
        });
    }
}

/** Of the colours that the hand changes, the largest. */
export function shownValue(rgb: readonly number[], tint: Triple, channels: Channels): number {
    return Math.max(...rgb.map((value, c) => (channels[c] === true ? value * tint[c]! : 0)));
}

function tickText(value: number): string {
    if (value === 0) return "0";
    const exponent = Math.floor(Math.log10(value) + 1e-9);
    if (exponent >= -2 && exponent < 4) return amountText(value);
    return `${Number((value / 10 ** exponent).toPrecision(2))}e${exponent}`;
}
