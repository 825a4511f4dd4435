/**
 * How large the image shows. It fits the stage until someone zooms: Ctrl + wheel or two fingers
 * zoom about the pointer, Space or the middle button with a drag, or two fingers, pan. The plain
 * wheel stays with exposure and the plain drag with the light. Beyond three screen pixels an
 * image pixel they show as squares, below that smoothly.
 */
import { notchesFromWheel } from "./image_drag";

const kFactorPerNotch = 1.25;
const kMostScreenPixels = 64;
const kCrispFrom = 3;

interface Point {
    x: number;
    y: number;
}

/** The zoom after scaling by `factor` about `point`, all relative to the middle of the stage. */
export function zoomedAbout(
    { scale, x, y }: Zoom,
    point: Point,
    factor: number,
    limits: { least: number; most: number },
): Zoom {
    const next = Math.min(limits.most, Math.max(limits.least, scale * factor));
    const ratio = next / scale;
    return {
        scale: next,
        x: point.x - (point.x - x) * ratio,
        y: point.y - (point.y - y) * ratio,
    };
}

/** Keeps the image over the middle of the stage: it cannot be lost out of sight. */
export function keptInSight(zoom: Zoom, width: number, height: number): Zoom {
    const [reachX, reachY] = [(width * zoom.scale) / 2, (height * zoom.scale) / 2];
    return {
        scale: zoom.scale,
        x: Math.min(reachX, Math.max(-reachX, zoom.x)),
        y: Math.min(reachY, Math.max(-reachY, zoom.y)),
    };
}

export interface Zoom {
    /** Of the fitting size; 1 fits. */
    scale: number;
    /** From the middle of the stage to the middle of the image, in CSS pixels. */
    x: number;
    y: number;
}

export class ImageZoom {
    private zoom: Zoom = { scale: 1, x: 0, y: 0 };
    private readonly fingers = new Map<number, Point>();
    private pan: { pointer: number; at: Point } | null = null;
    private spaceIsDown = false;

    constructor(
        private readonly stage: HTMLElement,
        private readonly frame: HTMLElement,
        /** Pixels across the image; 0 before the first. */
        private readonly imageWidth: () => number,
        private readonly changed: (words: string) => void,
        /** Whether two fingers zoom and pan: elsewhere they move the camera. */
        private readonly takesFingers: () => boolean,
    ) {
        stage.addEventListener("wheel", (event) => this.turnWheel(event), { passive: false });
        // In the capture phase, so that a pan is not taken for turning the light.
        const options = { capture: true };
        stage.addEventListener("pointerdown", (event) => this.press(event), options);
        stage.addEventListener("pointermove", (event) => this.move(event), options);
        for (const type of ["pointerup", "pointercancel"] as const) {
            stage.addEventListener(type, (event) => this.release(event), options);
        }
        window.addEventListener("keydown", (event) => this.setSpace(event, true));
        window.addEventListener("keyup", (event) => this.setSpace(event, false));
        new ResizeObserver(() => this.apply()).observe(stage);
    }

    /** Screen pixels an image pixel takes. */
    get screenPixels(): number {
        const width = this.imageWidth();
        return width === 0
            ? 1
            : (this.frame.clientWidth * this.zoom.scale * devicePixelRatio) / width;
    }

    fit(): void {
        this.zoom = { scale: 1, x: 0, y: 0 };
        this.apply();
    }

    toggleActual(): void {
        if (this.zoom.scale !== 1) this.fit();
        else this.scaleBy(1 / this.screenPixels, { x: 0, y: 0 });
    }

    scaleBy(factor: number, about: Point): void {
        const fitting = this.screenPixels / this.zoom.scale;
        const least = Math.min(1, 1 / fitting);
        const most = Math.max(1, kMostScreenPixels / fitting);
        this.zoom = zoomedAbout(this.zoom, about, factor, { least, most });
        this.apply();
    }

    step(direction: 1 | -1): void {
        this.scaleBy(kFactorPerNotch ** direction, { x: 0, y: 0 });
    }

    apply(): void {
        const { frame } = this;
        this.zoom = keptInSight(this.zoom, frame.clientWidth, frame.clientHeight);
        const { scale, x, y } = this.zoom;
        const isFitting = scale === 1 && x === 0 && y === 0;
        frame.style.transform = isFitting ? "" : `translate(${x}px, ${y}px) scale(${scale})`;
        frame.dataset["pixels"] = this.screenPixels > kCrispFrom ? "crisp" : "smooth";
        this.stage.dataset["zoomed"] = String(!isFitting);
        this.changed(`${Math.round(this.screenPixels * 100)} %`);
    }

    private pansBy(event: PointerEvent): boolean {
        return event.button === 1 || (event.button === 0 && this.spaceIsDown);
    }

    private turnWheel(event: WheelEvent): void {
        if (!event.ctrlKey) return;
        event.preventDefault();
        const factor = kFactorPerNotch ** -notchesFromWheel(event);
        this.scaleBy(factor, this.fromMiddle(event));
    }

    private press(event: PointerEvent): void {
        if (event.pointerType === "touch") {
            if (!this.takesFingers()) return;
            this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
            if (this.fingers.size > 1) event.stopPropagation();
            return;
        }
        if (!this.pansBy(event) || this.pan !== null) return;
        event.preventDefault();
        event.stopPropagation();
        this.pan = { pointer: event.pointerId, at: { x: event.clientX, y: event.clientY } };
        this.stage.setPointerCapture(event.pointerId);
    }

    private move(event: PointerEvent): void {
        const now = { x: event.clientX, y: event.clientY };
        if (this.pan?.pointer === event.pointerId) {
            event.stopPropagation();
            this.shift(now.x - this.pan.at.x, now.y - this.pan.at.y);
            this.pan.at = now;
            return;
        }
        const before = this.fingers.get(event.pointerId);
        if (before === undefined) return;
        this.fingers.set(event.pointerId, now);
        const other = [...this.fingers].find(([id]) => id !== event.pointerId)?.[1];
        if (other === undefined || this.fingers.size !== 2) return;
        event.stopPropagation();
        const stretch =
            Math.hypot(now.x - other.x, now.y - other.y) /
            Math.max(1, Math.hypot(before.x - other.x, before.y - other.y));
        this.shift((now.x - before.x) / 2, (now.y - before.y) / 2);
        this.scaleBy(
            stretch,
            this.fromMiddle({ clientX: (now.x + other.x) / 2, clientY: (now.y + other.y) / 2 }),
        );
    }

    private release(event: PointerEvent): void {
        this.fingers.delete(event.pointerId);
        if (this.pan?.pointer === event.pointerId) this.pan = null;
    }

    private shift(dx: number, dy: number): void {
        this.zoom = { ...this.zoom, x: this.zoom.x + dx, y: this.zoom.y + dy };
        this.apply();
    }

    private setSpace(event: KeyboardEvent, isDown: boolean): void {
        const isButton =
            event.target instanceof Element &&
            event.target.closest("button, input, select, textarea, a, [contenteditable]") !==
                null;
        if (event.key !== " " || (isDown && isButton)) return;
        this.spaceIsDown = isDown;
        this.stage.dataset["pans"] = String(isDown);
        if (isDown) event.preventDefault(); // the page would scroll
    }

    private fromMiddle({ clientX, clientY }: { clientX: number; clientY: number }): Point {
        const { left, top, width, height } = this.stage.getBoundingClientRect();
        return { x: clientX - left - width / 2, y: clientY - top - height / 2 };
    }
}
