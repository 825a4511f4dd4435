/**
 * Moving the camera by hand on the image, where the scene lets it move: a drag orbits, with the
 * right button or Shift it pans, the wheel dollies. One finger orbits, two pan and, pinching,
 * dolly. The camera stops where the hand does.
 */
import { dollied, orbited, panned } from "./camera";
import { notchesFromWheel } from "./image_drag";
import type { RoomConnection } from "./room_connection";
import type { SceneBounds } from "./wire/message";
import type { CameraState } from "./wire/state";

/** Half a turn across the picture. */
const kDegreesPerWidth = 180;
const kDollyPerNotch = 1.15;

interface Point {
    x: number;
    y: number;
}

/** Of the connection's scene; null where its camera stays. */
export function movingBounds(connection: RoomConnection): SceneBounds | null {
    const scene = connection.snapshot?.scene;
    return scene?.edits?.includes("camera") === true ? (scene.bounds ?? null) : null;
}

export class CameraHand {
    /** One mouse, or up to two fingers, by pointer. */
    private readonly pointers = new Map<number, Point>();

    constructor(
        private readonly frame: HTMLElement,
        private readonly connection: RoomConnection,
        /** Whether this event is for something else: the light, or the page's zoom. */
        private readonly isElsewhere: (event: PointerEvent | WheelEvent) => boolean,
    ) {
        // Before those who turn the light, who have the pointer where the camera stays.
        const options = { capture: true };
        frame.addEventListener("pointerdown", (event) => this.press(event), options);
        frame.addEventListener("pointermove", (event) => this.move(event), options);
        for (const type of ["pointerup", "pointercancel"] as const) {
            frame.addEventListener(type, (event) => this.release(event), options);
        }
        frame.addEventListener("wheel", (event) => this.turnWheel(event), {
            capture: true,
            passive: false,
        });
        frame.addEventListener("contextmenu", (event) => {
            if (movingBounds(connection) !== null) event.preventDefault();
        });
    }

    private edit(change: (camera: CameraState, bounds: SceneBounds) => CameraState): void {
        const { state } = this.connection;
        const bounds = movingBounds(this.connection);
        if (state === null || bounds === null) return;
        const { eye, look_at, up, fov_degrees } = change(state.camera, bounds);
        this.connection.edit({ camera: { eye, look_at, up, fov_degrees } });
    }

    private press(event: PointerEvent): void {
        const takes =
            movingBounds(this.connection) !== null &&
            this.connection.status.kind === "open" &&
            (event.button === 0 || event.button === 2) &&
            !this.isElsewhere(event);
        if (!takes) return;
        event.stopPropagation();
        if (event.pointerType !== "touch") this.pointers.clear();
        this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        this.frame.setPointerCapture(event.pointerId);
        this.frame.classList.add("dragging");
    }

    private move(event: PointerEvent): void {
        const before = this.pointers.get(event.pointerId);
        if (before === undefined) return;
        event.stopPropagation();
        const now = { x: event.clientX, y: event.clientY };
        this.pointers.set(event.pointerId, now);
        const [dx, dy] = [now.x - before.x, now.y - before.y];
        const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
        const width = Math.max(1, this.frame.clientWidth);
        const height = Math.max(1, this.frame.clientHeight);
        if (other !== undefined) {
            const stretch =
                Math.hypot(now.x - other.x, now.y - other.y) /
                Math.max(1, Math.hypot(before.x - other.x, before.y - other.y));
            this.edit((camera, bounds) =>
                dollied(
                    panned(camera, dx / 2 / height, dy / 2 / height),
                    1 / Math.max(0.1, stretch),
                    bounds,
                ),
            );
        } else if ((event.buttons & 2) !== 0 || event.shiftKey) {
            this.edit((camera) => panned(camera, dx / height, dy / height));
        } else {
            const degrees = kDegreesPerWidth / width;
            this.edit((camera) => orbited(camera, dx * degrees, dy * degrees));
        }
    }

    private release(event: PointerEvent): void {
        if (!this.pointers.delete(event.pointerId)) return;
        if (this.pointers.size === 0) this.frame.classList.remove("dragging");
    }

    private turnWheel(event: WheelEvent): void {
        if (movingBounds(this.connection) === null || this.isElsewhere(event)) return;
        event.preventDefault();
        event.stopPropagation();
        const factor = kDollyPerNotch ** notchesFromWheel(event);
        this.edit((camera, bounds) => dollied(camera, factor, bounds));
    }
}
