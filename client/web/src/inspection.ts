/**
 * `window.relume`: what this page shows, for tests and for the curious at the console. Reading it
 * changes nothing. README.md documents it.
 */
import type { ImageView } from "./image_view";
import type { RoomConnection } from "./room_connection";
import type { ImageHeader } from "./wire/image_header";
import type { DisplayState, RoomState } from "./wire/state";

export interface SettledPlanes {
    header: ImageHeader;
    /** Half floats as bits, row by row from the top left; A only with alpha. */
    planes: { R: Uint16Array; G: Uint16Array; B: Uint16Array; A?: Uint16Array };
}

export interface Inspection {
    readonly status: string;
    readonly room: string | null;
    readonly scene: string | null;
    readonly revision: number;
    readonly state: RoomState | null;
    readonly display: DisplayState;
    /** Header of the image on the canvas. */
    readonly image: ImageHeader | null;
    /** The canvas shows the exact image of the room's state, and no edit is on its way. */
    readonly exact: boolean;
    readonly painter: string;
    settled(): SettledPlanes | null;
    /** R G B A bytes of the canvas, row by row from the top left. */
    pixels(): Uint8ClampedArray | null;
}

export function inspect(
    connection: RoomConnection,
    view: ImageView,
    isExact: () => boolean,
    display: () => DisplayState,
): Inspection {
    return {
        get status() {
            return connection.status.kind;
        },
        get room() {
            return connection.snapshot?.room ?? null;
        },
        get scene() {
            return connection.snapshot?.scene.name ?? null;
        },
        get revision() {
            return connection.revision;
        },
        get state() {
            return connection.state;
        },
        get display() {
            return display();
        },
        get image() {
            return view.header;
        },
        get exact() {
            return isExact();
        },
        get painter() {
            return view.painterName;
        },
        settled: () => settledPlanes(view),
        pixels: () => view.read(),
    };
}

function settledPlanes({ settled }: ImageView): SettledPlanes | null {
    if (settled === null) return null;
    const { header, rgba } = settled;
    const count = header.width * header.height;
    const plane = (c: number): Uint16Array => {
        const values = new Uint16Array(count);
        for (let i = 0; i < count; ++i) values[i] = rgba[i * 4 + c]!;
        return values;
    };
    const planes: SettledPlanes["planes"] = { R: plane(0), G: plane(1), B: plane(2) };
    if (header.hasAlpha) planes.A = plane(3);
    return { header, planes };
}

declare global {
    interface Window {
        relume?: Inspection;
    }
}
