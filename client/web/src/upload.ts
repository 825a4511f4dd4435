/**
 * Files brought to the page, by button or by dropping them anywhere: a Radiance HDR or EXR file
 * is uploaded and lights the scene; a lighting saved as JSON is taken over.
 */
import { type Api, ApiError, type UploadResult } from "./api";
import { bytesText } from "./format";
import { type Lighting, LightingError, lightingFromText } from "./lighting";
import type { Notices } from "./notices";
import { nameFromText } from "./place";
import type { RoomConnection } from "./room_connection";
import type { UploadStore } from "./upload_store";

const kDefaultLimitBytes = 64 * 1024 * 1024;
/** A lighting of many lights is some tens of kilobytes. */
const kMostLightingBytes = 1024 * 1024;

export interface UploadElements {
    button: HTMLButtonElement;
    input: HTMLInputElement;
    dropVeil: HTMLElement;
}

export interface UploadListeners {
    uploaded: (result: UploadResult) => Promise<void>;
    lightingRead: (lighting: Lighting) => Promise<void>;
}

export class Upload {
    private depth = 0;

    constructor(
        private readonly elements: UploadElements,
        private readonly api: Api,
        private readonly connection: RoomConnection,
        private readonly store: UploadStore,
        private readonly notices: Notices,
        private readonly listeners: UploadListeners,
    ) {
        const { button, input } = elements;
        button.addEventListener("click", () => input.click());
        input.addEventListener("change", () => {
            const file = input.files?.[0];
            input.value = ""; // so that the same file can be chosen again
            if (file !== undefined) void this.take(file);
        });
        this.listenForDrop();
    }

    private async take(file: File): Promise<void> {
        if (/\.json$/i.test(file.name)) await this.readLighting(file);
        else await this.send(file, null);
    }

    private async readLighting(file: File): Promise<void> {
        if (file.size > kMostLightingBytes) {
            this.refuse(
                `${file.name} is too large for a lighting`,
                bytesText(file.size),
                `at most ${bytesText(kMostLightingBytes)}`,
            );
            return;
        }
        try {
            await this.listeners.lightingRead(lightingFromText(await file.text()));
        } catch (error) {
            if (!(error instanceof LightingError)) throw error;
            this.refuse(`${file.name}: ${error.message}`, error.found, error.expected);
        }
    }

    private async send(file: File, projection: string | null): Promise<void> {
        const name = nameFromText(file.name.replace(/\.(hdr|exr|pic|rgbe)$/i, ""));
        if (name === "") {
            this.refuse(
                "This file's name has no letter that can be kept",
                file.name,
                "a name with letters A-Z or digits",
            );
            return;
        }
        const limit = this.connection.snapshot?.limits["upload_bytes"] ?? kDefaultLimitBytes;
        if (file.size > limit) {
            this.refuse(
                `${file.name} is too large`,
                bytesText(file.size),
                `at most ${bytesText(limit)}`,
            );
            return;
        }
        const { button } = this.elements;
        button.disabled = true;
        button.setAttribute("aria-busy", "true");
        try {
            const result = await this.api.upload(name, file, projection);
            await this.store.keep({ name: result.name, file, projection });
            const asks = projection === null && result.projection === "angular_map";
            // What the page asks about is not remarked on as well.
            const remarks = result.warnings.filter(
                (warning) => !asks || !warning.includes("taken for an angular map"),
            );
            if (remarks.length > 0) {
                this.notices.show({
                    tone: "warning",
                    title: `${result.name} is ready, with remarks`,
                    details: remarks,
                });
            }
            await this.listeners.uploaded(result);
            if (asks) this.askForProjection(file, result);
        } catch (error) {
            if (!(error instanceof ApiError)) throw error;
            this.refuse(`${file.name}: ${error.message}`, error.found, error.expected);
        } finally {
            button.disabled = false;
            button.removeAttribute("aria-busy");
        }
    }

    /** A square picture may be a mirror ball, or a lat-long map that was made square. */
    private askForProjection(file: File, result: UploadResult): void {
        this.notices.show({
            tone: "warning",
            title: `${result.name} is square and was read as an angular map (a light probe)`,
            details: ["If its top and bottom edges are the poles, it is lat-long."],
            actions: [
                { words: "Read it as lat-long", run: () => void this.send(file, "lat_long") },
                { words: "It is an angular map", run: () => undefined },
            ],
        });
    }

    private refuse(title: string, found?: string, expected?: string): void {
        this.notices.show({ tone: "error", title, found, expected });
    }

    private listenForDrop(): void {
        const { dropVeil } = this.elements;
        const carriesFile = (event: DragEvent): boolean =>
            event.dataTransfer?.types.includes("Files") === true;
        // Enter and leave come for every element passed over: count them.
        window.addEventListener("dragenter", (event) => {
            if (!carriesFile(event)) return;
            ++this.depth;
            dropVeil.hidden = false;
        });
        window.addEventListener("dragleave", (event) => {
            if (!carriesFile(event)) return;
            this.depth = Math.max(0, this.depth - 1);
            dropVeil.hidden = this.depth === 0;
        });
        window.addEventListener("dragover", (event) => {
            if (carriesFile(event)) event.preventDefault();
        });
        window.addEventListener("drop", (event) => {
            if (!carriesFile(event)) return;
            event.preventDefault();
            this.depth = 0;
            dropVeil.hidden = true;
            const file = event.dataTransfer?.files[0];
            if (file !== undefined) void this.take(file);
        });
    }
}
