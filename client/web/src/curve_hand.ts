/**
 * Hand and keyboard over the picture of a curve. A drag is one edit that grows, one step of the
 * history.
 */
import { shownValue } from "./curve_canvas";
import { pointsForScale, withoutPoint, withPointAdded, withPointMoved } from "./curve_points";
import { DrawnStroke, raised, smoothed, type Stroke } from "./curve_stroke";
import type { CurveEditor } from "./curve_editor";
import { listenForDrag } from "./pointer_drag";
import { clampTo } from "./wire/range";
import { kRanges, type Triple } from "./wire/state";

export type CurveTool = "draw" | "smooth" | "points";

/** In CSS pixels: so near to a point a hand takes it. */
const kReach = { mouse: 10, finger: 22 };
/** Of the brush, in u. */
const kBrushRadius = 0.06;
const kKeyStep = 1 / 64;
const kKeyFactor = 1.1;
const kUnder = 1e-3;

export class CurveHand {
    /** Of the control points; −1 is none. */
    chosen = -1;
    private u = 0.25;
    private drawn: DrawnStroke | null = null;

    constructor(
        private readonly frame: HTMLElement,
        private readonly editor: CurveEditor,
    ) {
        listenForDrag(frame, {
            start: (event) => this.start(event),
            move: ({ event }) => this.move(event),
            end: () => this.end(),
        });
        frame.addEventListener("pointermove", (event) => {
            const at = this.place(event);
            if (at !== null) editor.tell(at.u);
        });
        frame.addEventListener("dblclick", (event) => this.doubleClick(event));
        frame.addEventListener("keydown", (event) => this.key(event));
        for (const type of ["focus", "blur"]) {
            frame.addEventListener(type, () => editor.showSoon());
        }
        frame.addEventListener("blur", () => editor.materials.history.end());
        frame.addEventListener("keyup", () => editor.materials.history.end());
    }

    /** Null while the keyboard is elsewhere, or moves points. */
    get cursor(): number | null {
        const isHere = this.frame.matches(":focus-visible");
        return isHere && this.editor.tool !== "points" ? this.u : null;
    }

    forget(): void {
        this.chosen = -1;
    }

    private place({ clientX, clientY }: MouseEvent): { u: number; value: number } | null {
        const { axes, canvas } = this.editor;
        if (axes === null) return null;
        const { left, top } = canvas.element.getBoundingClientRect();
        return { u: axes.u(clientX - left), value: axes.value(clientY - top) };
    }

    /** What the hand asks for where the curve has `rgb`: its colours together keep their ratios. */
    private colour(value: number, rgb: readonly number[]): Triple {
        const { channels, edit } = this.editor;
        const tint = edit?.tint ?? [1, 1, 1];
        const now = shownValue(rgb, tint, channels);
        const asked = rgb.map((before, c) => {
            if (channels[c] !== true) return before;
            if (now > 0) return (before * value) / now;
            return tint[c]! > 0 ? value / tint[c]! : before;
        });
        return asked.map((part) => clampTo(kRanges.materials.samples, part)) as Triple;
    }

    private start(event: PointerEvent): boolean {
        const { editor } = this;
        const at = this.place(event);
        if (!editor.isOpen || at === null || editor.edit === null) return false;
        this.u = at.u;
        if (editor.tool === "points") {
            this.chosen = this.pointAt(event);
            editor.showSoon();
            if (this.chosen < 0) return false;
        }
        editor.hold(true);
        if (editor.tool === "draw") {
            this.drawn = new DrawnStroke(editor.edit.samples, (value, rgb) =>
                this.colour(value, rgb),
            );
        }
        if (editor.tool !== "points") this.move(event);
        return true;
    }

    private move(event: PointerEvent): void {
        const at = this.place(event);
        const { tool, edit, materials, channels } = this.editor;
        if (at === null || edit === null) return;
        this.u = at.u;
        if (tool === "points") this.movePoint(this.chosen, at.u, at.value);
        else if (tool === "smooth") {
            this.lay(smoothed(edit.samples, at.u, kBrushRadius, channels));
        } else if (this.drawn !== null) {
            this.drawn.draw(at.u, at.value);
            const { stroke } = this.drawn;
            if (stroke !== null) materials.draw(stroke);
        }
        this.editor.tell(at.u);
    }

    private end(): void {
        this.drawn = null;
        this.editor.hold(false);
    }

    /** Over what shows, strokes that wait included: they go as samples. */
    private lay(stroke: Stroke | null): void {
        if (stroke !== null) this.editor.materials.lay(stroke);
    }

    private pointAt(event: PointerEvent | MouseEvent): number {
        const { axes, canvas, points, edit, channels } = this.editor;
        if (axes === null || edit === null) return -1;
        const { left, top } = canvas.element.getBoundingClientRect();
        const isFinger = event instanceof PointerEvent && event.pointerType === "touch";
        let [nearest, least] = [-1, isFinger ? kReach.finger : kReach.mouse];
        points.forEach((point, i) => {
            const x = axes.x(point[0]!) - (event.clientX - left);
            const value = shownValue(point.slice(1), edit.tint, channels);
            const distance = Math.hypot(x, axes.y(value) - (event.clientY - top));
            if (distance <= least) [nearest, least] = [i, distance];
        });
        return nearest;
    }

    private movePoint(index: number, u: number, value: number): void {
        const { points } = this.editor;
        const point = points[index];
        if (point === undefined) return;
        this.setPoints(withPointMoved(points, index, u, this.colour(value, point.slice(1))));
    }

    private setPoints(points: number[][]): void {
        const { materials, scale } = this.editor;
        materials.setPoints(pointsForScale(points, scale), { scale });
    }

    private doubleClick(event: MouseEvent): void {
        const { tool, isOpen, materials } = this.editor;
        const at = this.place(event);
        if (tool !== "points" || !isOpen || at === null) return;
        const index = this.pointAt(event);
        if (index >= 0) this.removePoint(index);
        else this.addPoint(at.u, at.value);
        materials.history.end();
    }

    private addPoint(u: number, value?: number): void {
        const { edit, points } = this.editor;
        if (edit === null) return;
        const rgb = edit.samples[Math.round(u * (edit.samples.length - 1))]!;
        const colour = value === undefined ? [...rgb] : this.colour(value, rgb);
        const added = withPointAdded(points, u, colour);
        if (added === null) return;
        this.setPoints(added.points);
        this.chosen = added.index;
    }

    private removePoint(index: number): void {
        const { points } = this.editor;
        if (points.length < 2 || points[index] === undefined) return;
        this.setPoints(withoutPoint(points, index));
        this.chosen = Math.min(index, points.length - 2);
    }

    private key(event: KeyboardEvent): void {
        if (event.ctrlKey || event.metaKey || event.altKey || !this.editor.isOpen) return;
        const isHandled =
            this.editor.tool === "points" ? this.pointKey(event) : this.cursorKey(event);
        if (!isHandled) return;
        event.preventDefault();
        event.stopPropagation();
        this.editor.showSoon();
    }

    private pointKey({ key, shiftKey }: KeyboardEvent): boolean {
        const { points, edit, axes, channels } = this.editor;
        if (edit === null || axes === null) return false;
        const sideways = key === "ArrowRight" ? 1 : key === "ArrowLeft" ? -1 : 0;
        const upwards = key === "ArrowUp" ? 1 : key === "ArrowDown" ? -1 : 0;
        const point = points[this.chosen];
        if (sideways !== 0 && (!shiftKey || point === undefined)) {
            this.chosen = Math.min(points.length - 1, Math.max(0, this.chosen + sideways));
            this.editor.tell(points[this.chosen]![0]!);
        } else if (point !== undefined && (sideways !== 0 || upwards !== 0)) {
            const value = shownValue(point.slice(1), edit.tint, channels);
            const base = upwards > 0 ? Math.max(value, axes.highest * kUnder) : value;
            const u = point[0]! + sideways * kKeyStep;
            this.movePoint(this.chosen, u, base * kKeyFactor ** upwards);
            this.editor.tell(point[0]!);
        } else if (point !== undefined && (key === "Delete" || key === "Backspace")) {
            this.removePoint(this.chosen);
        } else if (key === "Insert" || key === "Enter") {
            const next = points[this.chosen + 1];
            const from = point?.[0] ?? 0;
            this.addPoint((from + (next?.[0] ?? 1)) / 2);
        } else return false;
        return true;
    }

    private cursorKey({ key }: KeyboardEvent): boolean {
        const { edit, axes, channels, tool } = this.editor;
        if (edit === null || axes === null) return false;
        if (key === "ArrowLeft" || key === "ArrowRight") {
            this.u += key === "ArrowLeft" ? -kKeyStep : kKeyStep;
            this.u = Math.min(1, Math.max(0, this.u));
        } else if (key === "ArrowUp" || key === "ArrowDown") {
            const factor = key === "ArrowUp" ? kKeyFactor : 1 / kKeyFactor;
            const least = axes.highest * kUnder;
            const brush = { channels, least };
            this.lay(
                tool === "smooth"
                    ? smoothed(edit.samples, this.u, kBrushRadius, channels)
                    : raised(edit.samples, this.u, kBrushRadius, factor, brush),
            );
        } else return false;
        this.editor.tell(this.u);
        return true;
    }
}
