import { DisplayTable, pixelsFromHalves, redevelopedCodes, sameDisplay } from "./display";
import type { DecodedImage } from "./image_decoder";
import type { Painter } from "./painter";
import type { DisplayState } from "./wire/state";

/** The way without WebGL2: the display formula through a table of all 65536 half floats. */
export class CanvasPainter implements Painter {
    readonly name = "canvas2d";
    readonly largestSide = Infinity;
    private readonly table = new DisplayTable();
    private image: DecodedImage | null = null;
    /** Pixels of a JPEG as they came. */
    private jpeg: ImageData | null = null;

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
        this.jpeg = null;
        // A bitmap is closed by its owner, so it is drawn here and never again.
        if (image.kind === "jpeg") this.context.drawImage(image.bitmap, 0, 0);
    }

    paint(display: DisplayState, jpegDisplay: DisplayState): void {
        if (this.image === null) return;
        if (this.image.kind === "jpeg") {
            this.paintJpeg(display, jpegDisplay);
            return;
        }
        const { width, height } = this.image.header;
        this.table.update(display);
        this.context.putImageData(
            pixelsFromHalves(this.image.rgba, width, height, this.table),
            0,
            0,
        );
    }

    private paintJpeg(display: DisplayState, jpegDisplay: DisplayState): void {
        if (this.jpeg === null && sameDisplay(display, jpegDisplay)) return; // drawn as it came
        const { width, height } = this.canvas;
        this.jpeg ??= this.context.getImageData(0, 0, width, height);
        const codes = redevelopedCodes(jpegDisplay, display);
        const image = new ImageData(width, height);
        image.data.set(this.jpeg.data.map((code, i) => (i % 4 === 3 ? code : codes[code]!)));
        this.context.putImageData(image, 0, 0);
    }

    read(): Uint8ClampedArray {
        return this.context.getImageData(0, 0, this.canvas.width, this.canvas.height).data;
    }
}
