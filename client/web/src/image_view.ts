/**
 * The image on the page. While the light moves it shows JPEGs as they come; the settled image it
 * develops itself, so exposure and tone curve act on linear light at once.
 */
import { CanvasPainter } from "./canvas_painter";
import { GlPainter } from "./gl_painter";
import { sameDisplay } from "./display";
import type { DecodedImage } from "./image_decoder";
import type { Painter } from "./painter";
import type { ImageHeader } from "./wire/image_header";
import type { DisplayState } from "./wire/state";

export type SettledImage = Extract<DecodedImage, { kind: "half" }>;

export class ImageView {
    canvas: HTMLCanvasElement;
    /** Header of the image on the canvas. */
    header: ImageHeader | null = null;
    /** The image on the canvas, where that is a settled one. */
    settled: SettledImage | null = null;
    private painter: Painter | null = null;
    private display: DisplayState = { exposure_stops: 0, tone: "filmic" };

    constructor(
        private readonly frame: HTMLElement,
        private readonly mayUseGl: boolean,
    ) {
        this.canvas = this.makeCanvas();
    }

    get painterName(): Painter["name"] | "none" {
        return this.painter?.name ?? "none";
    }

    show(image: DecodedImage): void {
        const painter = this.painterFor(image.header);
        painter.load(image);
        this.header = image.header;
        this.settled = image.kind === "half" ? image : null;
        painter.paint(this.display);
        if (image.kind === "jpeg") image.bitmap.close();
        const { width, height } = image.header;
        this.frame.style.setProperty("--image-width", String(width));
        this.frame.style.setProperty("--image-height", String(height));
        this.frame.dataset["shows"] = image.kind;
    }

    /** What shows stays on the canvas but stands for nothing: it is of another connection. */
    forget(): void {
        this.header = null;
        this.settled = null;
    }

    setDisplay(display: DisplayState): void {
        if (sameDisplay(display, this.display)) return;
        this.display = { ...display };
        if (this.settled !== null) this.painter?.paint(this.display);
    }

    /** R G B A bytes of the canvas from the top left; null before the first image. */
    read(): Uint8ClampedArray | null {
        return this.painter?.read(this.display) ?? null;
    }

    private makeCanvas(): HTMLCanvasElement {
        const canvas = document.createElement("canvas");
        canvas.className = "image-canvas";
        canvas.setAttribute("role", "img");
        canvas.setAttribute("aria-label", "Relit image");
        this.frame.replaceChildren(canvas);
        return canvas;
    }

    private painterFor({ width, height }: ImageHeader): Painter {
        const side = Math.max(width, height);
        if (this.painter === null) {
            this.painter = this.makeGlPainter() ?? this.makeCanvasPainter();
        }
        if (side > this.painter.largestSide) this.painter = this.makeCanvasPainter();
        return this.painter;
    }

    private makeGlPainter(): Painter | null {
        if (!this.mayUseGl) return null;
        const { canvas } = this;
        const gl = canvas.getContext("webgl2", {
            alpha: false,
            antialias: false,
            depth: false,
        });
        if (gl === null || gl.isContextLost()) return null;
        try {
            const painter = new GlPainter(canvas, gl);
            canvas.addEventListener("webglcontextlost", () => this.fallBack(painter));
            return painter;
        } catch (error) {
            console.warn("WebGL2 cannot show the image, using a 2-D canvas:", error);
            return null;
        }
    }

    private makeCanvasPainter(): Painter {
        // A canvas that has given out a WebGL context gives out no other kind.
        this.canvas = this.makeCanvas();
        const context = this.canvas.getContext("2d", { alpha: false });
        if (context === null)
            throw new Error("this browser offers neither WebGL2 nor 2-D canvas");
        return new CanvasPainter(this.canvas, context);
    }

    /** A driver reset takes the context away: go on with the 2-D canvas. */
    private fallBack(lost: Painter): void {
        if (this.painter !== lost) return;
        this.painter = this.makeCanvasPainter();
        if (this.settled !== null) this.show(this.settled);
    }
}
