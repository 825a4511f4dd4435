/**
 * Choosing a material by its place in the image. The server has a map of which material each
 * pixel shows; a scene without one is chosen from by the list alone.
 */
import type { Api } from "./api";
import { editsMaterials } from "./material_panel";
import type { Materials } from "./materials";
import type { RoomConnection } from "./room_connection";

/** A hand that moves further, in CSS pixels, does something else. */
const kMostMovement = 5;

interface MaterialMap {
    width: number;
    height: number;
    /** Row by row from the top left: 0, or one more than the place in the summary. */
    places: Uint8Array;
}

export class MaterialPicker {
    private map: MaterialMap | null = null;
    private pressed: { pointer: number; x: number; y: number } | null = null;

    constructor(
        private readonly frame: HTMLElement,
        private readonly api: Api,
        private readonly connection: RoomConnection,
        private readonly materials: Materials,
    ) {
        connection.opened.listen(({ snapshot }) => void this.load(snapshot.scene.name));
        frame.addEventListener("pointerdown", ({ pointerId, clientX, clientY, button }) => {
            const isFirst = this.pressed === null && button === 0;
            this.pressed = isFirst ? { pointer: pointerId, x: clientX, y: clientY } : null;
        });
        frame.addEventListener("pointermove", (event) => {
            const id = this.map === null ? null : this.idAt(event);
            frame.classList.toggle("picks", id !== null);
        });
        frame.addEventListener("pointerup", (event) => this.release(event));
        frame.addEventListener("pointercancel", () => (this.pressed = null));
    }

    private async load(scene: string): Promise<void> {
        this.map = null;
        this.frame.classList.remove("picks");
        if (!editsMaterials(this.connection)) return;
        try {
            const bitmap = await this.api.materialMap(scene);
            const { width, height } = bitmap;
            const canvas = new OffscreenCanvas(width, height);
            const context = canvas.getContext("2d", { willReadFrequently: true });
            if (context === null) return;
            context.drawImage(bitmap, 0, 0);
            bitmap.close();
            const { data } = context.getImageData(0, 0, width, height);
            const places = new Uint8Array(width * height);
            for (let i = 0; i < places.length; ++i) places[i] = data[i * 4]!;
            this.map = { width, height, places };
        } catch {
            // The list stays to choose from.
        }
    }

    private release({ pointerId, clientX, clientY }: PointerEvent): void {
        const { pressed } = this;
        this.pressed = null;
        if (pressed === null || pressed.pointer !== pointerId) return;
        if (Math.hypot(clientX - pressed.x, clientY - pressed.y) > kMostMovement) return;
        const id = this.idAt({ clientX, clientY });
        if (id !== null) this.materials.select(id);
    }

    private idAt({ clientX, clientY }: { clientX: number; clientY: number }): string | null {
        const { map } = this;
        if (map === null) return null;
        const { left, top, width, height } = this.frame.getBoundingClientRect();
        const x = Math.floor(((clientX - left) / width) * map.width);
        const y = Math.floor(((clientY - top) / height) * map.height);
        if (x < 0 || y < 0 || x >= map.width || y >= map.height) return null;
        return this.materials.idAtPlace(map.places[y * map.width + x]!);
    }
}
