/**
 * Turning the light by hand on the image: across turns it about the vertical; with Shift, up and
 * down tips it; the wheel sets exposure, with Alt it rolls the light.
 */
import type { Exposure } from "./exposure";
import { type DragMove, listenForDrag } from "./pointer_drag";
import { turned } from "./rotation";
import type { RoomConnection } from "./room_connection";

/** Half a turn across the picture. */
const kDegreesPerWidth = 180;
const kStopsPerNotch = 0.125;
const kRollDegreesPerNotch = 3;
const kPixelsPerNotch = 100;
const kPixelsPerLine = 33;

export type Turn = Parameters<typeof turned>[1];

/** Nothing happens where the scene's light is frozen. */
export function turnLight(connection: RoomConnection, turn: Turn): void {
    const quaternion = connection.state?.rotation.quaternion;
    if (quaternion === undefined || !connection.takes("rotation")) return;
    connection.edit({ rotation: { quaternion: turned(quaternion, turn) } });
}

/** Across turns; with Shift, up and down tips as well. */
export function turnByDrag(
    connection: RoomConnection,
    { dx, dy, event }: DragMove,
    degreesPerPixel: number,
): void {
    const across = dx * degreesPerPixel;
    turnLight(connection, event.shiftKey ? { across, down: dy * degreesPerPixel } : { across });
}

/** Movement of the wheel in notches, down being positive. */
export function notchesFromWheel(event: WheelEvent): number {
    const delta = event.deltaY !== 0 ? event.deltaY : event.deltaX;
    if (event.deltaMode === WheelEvent.DOM_DELTA_LINE)
        return (delta * kPixelsPerLine) / kPixelsPerNotch;
    return event.deltaMode === WheelEvent.DOM_DELTA_PAGE ? delta : delta / kPixelsPerNotch;
}

export function listenOnImage(
    frame: HTMLElement,
    connection: RoomConnection,
    exposure: Exposure,
): void {
    listenForDrag(frame, {
        start: () => connection.status.kind === "open",
        move: (move) =>
            turnByDrag(connection, move, kDegreesPerWidth / Math.max(1, frame.clientWidth)),
    });
    frame.addEventListener(
        "wheel",
        (event) => {
            if (event.ctrlKey) return; // the browser's zoom
            event.preventDefault();
            const notches = notchesFromWheel(event);
            if (event.altKey) turnLight(connection, { clockwise: notches * kRollDegreesPerNotch });
            else exposure.step(-notches * kStopsPerNotch);
        },
        { passive: false },
    );
}
