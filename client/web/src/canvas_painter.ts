import { DisplayTable, pixelsFromHalves } from "./display";
import type { DecodedImage } from "./image_decoder";
import type { Painter } from "./painter";
import type { DisplayState } from "./wire/state";

/** The way without WebGL2: the display formula through a table of all 65536 half floats. */
export class CanvasPainter implements Painter {
    readonly name = "canvas2d";
    readonly largestSide = Infinity;
    private readonly table = new DisplayTable();
    private image: DecodedImage | null = null;

    constructor(
        private readonly canvas: HTMLCanvasElement,
        private readonly context: CanvasRenderingContext2D,
    ) {}

    load(image: DecodedImage): void {
        const { width, height } = image.header;
        if (this.canvas.width !== width || this.canvas.height !== height) {
            this.canvas.width = width;
            this.canvas.height = height;
        }
        this.image = image;
        // A bitmap is closed by its owner, so it is drawn here and never again.
        if (image.kind === "jpeg") this.context.drawImage(image.bitmap, 0, 0);
    }

    paint(display: DisplayState): void {
        if (this.image?.kind !== "half") return;
        const { width, height } = this.image.header;
        this.table.update(display);
        this.context.putImageData(
            pixelsFromHalves(this.image.rgba, width, height, this.table),
            0,
            0,
        );
    }

    read(): Uint8ClampedArray {
        return this.context.getImageData(0, 0, this.canvas.width, this.canvas.height).data;
    }
}
