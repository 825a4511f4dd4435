/** The pixels of environments' preview pictures, fetched once each. */
import type { Api } from "./api";
import { Signal } from "./signal";

export class PreviewStore {
    readonly loaded = new Signal<string>();
    private readonly pixels = new Map<string, ImageData | "loading" | "missing">();

    constructor(private readonly api: Api) {}

    /** Null until `loaded` has named it, and for ever where there is no preview. */
    get(name: string): ImageData | null {
        const known = this.pixels.get(name);
        if (known === undefined) {
            this.pixels.set(name, "loading");
            void this.load(name);
        }
        return known instanceof ImageData ? known : null;
    }

    /** For an upload that replaces an environment of the same name. */
    forget(name: string): void {
        this.pixels.delete(name);
    }

    private async load(name: string): Promise<void> {
        const image = new Image();
        image.crossOrigin = "anonymous";
        image.src = this.api.previewAddress(name);
        try {
            await image.decode();
        } catch {
            this.pixels.set(name, "missing");
            return;
        }
        const canvas = document.createElement("canvas");
        canvas.width = image.naturalWidth;
        canvas.height = image.naturalHeight;
        const context = canvas.getContext("2d", { willReadFrequently: true });
        if (context === null) return;
        context.drawImage(image, 0, 0);
        this.pixels.set(name, context.getImageData(0, 0, canvas.width, canvas.height));
        this.loaded.send(name);
    }
}
