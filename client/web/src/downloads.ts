/** What can be taken from the page: the settled image as PNG or EXR, the lighting as JSON. */
import { exrFromSettled } from "./exr";
import type { Exposure } from "./exposure";
import type { ImageView, SettledImage } from "./image_view";
import { lightingOf, textFromLighting } from "./lighting";
import type { Notices } from "./notices";
import { pngFromSettled } from "./png";
import type { RoomConnection } from "./room_connection";

const kAddressLifeMilliseconds = 10_000;

export class Downloads {
    constructor(
        private readonly connection: RoomConnection,
        private readonly view: ImageView,
        private readonly exposure: Exposure,
        private readonly notices: Notices,
    ) {}

    async savePng(): Promise<void> {
        const settled = this.settledImage();
        if (settled === null) return;
        this.save(
            await pngFromSettled(settled, this.exposure.display),
            this.nameOf(settled, "png"),
        );
    }

    async saveExr(): Promise<void> {
        const settled = this.settledImage();
        if (settled === null) return;
        const { exact, statedError, revision } = settled.header;
        const comments =
            `Relume, scene ${this.connection.snapshot?.scene.name ?? "?"}, revision ${revision}, ` +
            (exact ? "exact" : `stated relative L2 error ${statedError}`);
        this.save(await exrFromSettled(settled, comments), this.nameOf(settled, "exr"));
    }

    saveLighting(): void {
        const { state, snapshot, revision } = this.connection;
        if (state === null || snapshot === null) return;
        const text = textFromLighting(lightingOf(state, this.exposure.display));
        this.save(
            new Blob([text], { type: "application/json" }),
            `${snapshot.scene.name}-r${revision}.lighting.json`,
        );
    }

    private settledImage(): SettledImage | null {
        const { settled } = this.view;
        if (settled === null) {
            this.notices.show({
                tone: "info",
                title: "The image can be saved once it has settled",
            });
        }
        return settled;
    }

    private nameOf(image: SettledImage, ending: string): string {
        const scene = this.connection.snapshot?.scene.name ?? "image";
        const environment = this.connection.state?.environment.name ?? "light";
        return `${scene}-${environment}-r${image.header.revision}.${ending}`;
    }

    private save(blob: Blob, fileName: string): void {
        const link = document.createElement("a");
        link.href = URL.createObjectURL(blob);
        link.download = fileName;
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), kAddressLifeMilliseconds);
        this.notices.show({ tone: "info", title: `Saved ${fileName}` });
    }
}
