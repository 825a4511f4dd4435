/** Bringing one's own light: a Radiance HDR or EXR file by button or by dropping it anywhere. */
import { type Api, ApiError, type UploadResult } from "./api";
import { bytesText } from "./format";
import type { Notices } from "./notices";
import { nameFromText } from "./place";
import type { Session } from "./session";

const kDefaultLimitBytes = 64 * 1024 * 1024;

export interface UploadElements {
    button: HTMLButtonElement;
    input: HTMLInputElement;
    dropVeil: HTMLElement;
}

export class Upload {
    private depth = 0;

    constructor(
        private readonly elements: UploadElements,
        private readonly api: Api,
        private readonly session: Session,
        private readonly notices: Notices,
        private readonly uploaded: (result: UploadResult) => Promise<void>,
    ) {
        const { button, input } = elements;
        button.addEventListener("click", () => input.click());
        input.addEventListener("change", () => {
            const file = input.files?.[0];
            input.value = ""; // so that the same file can be chosen again
            if (file !== undefined) void this.send(file);
        });
        this.listenForDrop();
    }

    async send(file: File): Promise<void> {
        const name = nameFromText(file.name.replace(/\.(hdr|exr|pic|rgbe)$/i, ""));
        if (name === "") {
            this.refuse(
                "This file's name has no letter that can be kept",
                file.name,
                "a name with letters A-Z or digits",
            );
            return;
        }
        const limit = this.session.snapshot?.limits["upload_bytes"] ?? kDefaultLimitBytes;
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
            const result = await this.api.upload(name, file);
            if (result.warnings.length > 0) {
                this.notices.show({
                    tone: "warning",
                    title: `${result.name} is ready, with remarks`,
                    details: result.warnings,
                });
            }
            await this.uploaded(result);
        } catch (error) {
            if (!(error instanceof ApiError)) throw error;
            this.refuse(`${file.name}: ${error.message}`, error.found, error.expected);
        } finally {
            button.disabled = false;
            button.removeAttribute("aria-busy");
        }
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
            if (file !== undefined) void this.send(file);
        });
    }
}
