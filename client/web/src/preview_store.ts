/** The pixels of environments' preview pictures, fetched once for every version of a map. */
import type { Api, EnvironmentEntry } from "./api";
import { Signal } from "./signal";

interface Preview {
    /** Of the map, as the server's list had it when this was fetched. */
    version: number;
    pixels: ImageData | "loading" | "missing";
}

export class PreviewStore {
    readonly loaded = new Signal<string>();
    private readonly previews = new Map<string, Preview>();
    private versions = new Map<string, number>();

    constructor(private readonly api: Api) {}

    /** What the server has: pictures of other versions are fetched anew when asked for. */
    setEntries(entries: EnvironmentEntry[]): void {
        this.versions = new Map(entries.map(({ name, version }) => [name, version ?? 0]));
        for (const [name, { version }] of [...this.previews]) {
            if (this.versionOf(name) !== version) this.forget(name);
        }
    }

    /** Null until `loaded` has named it, and for ever where there is no preview. */
    get(name: string): ImageData | null {
        const known = this.previews.get(name);
        if (known === undefined) {
            const preview: Preview = { version: this.versionOf(name), pixels: "loading" };
            this.previews.set(name, preview);
            void this.load(name, preview);
            return null;
        }
        return known.pixels instanceof ImageData ? known.pixels : null;
    }

    /** The map of this name has been replaced. */
    forget(name: string): void {
        this.previews.delete(name);
    }

    private versionOf(name: string): number {
        return this.versions.get(name) ?? 0;
    }

    private async load(name: string, preview: Preview): Promise<void> {
        try {
            const bitmap = await this.api.preview(name);
            const canvas = document.createElement("canvas");
            canvas.width = bitmap.width;
            canvas.height = bitmap.height;
            const context = canvas.getContext("2d", { willReadFrequently: true });
            if (context === null) throw new Error("this browser offers no 2-D canvas");
            context.drawImage(bitmap, 0, 0);
            preview.pixels = context.getImageData(0, 0, canvas.width, canvas.height);
            bitmap.close();
        } catch {
            preview.pixels = "missing";
            return;
        }
        // Another version may have been asked for meanwhile.
        if (this.previews.get(name) === preview) this.loaded.send(name);
    }
}
