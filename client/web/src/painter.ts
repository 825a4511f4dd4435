/** What puts an image on the canvas, one canvas pixel per image pixel. */
import type { DecodedImage } from "./image_decoder";
import type { DisplayState } from "./wire/state";

export interface Painter {
    readonly name: "webgl2" | "canvas2d";
    /** Of an image it can show, in pixels. */
    readonly largestSide: number;
    /** Makes `image` the one to paint; its pixels may be dropped by the caller afterwards. */
    load(image: DecodedImage): void;
    /** Paints the image loaded last. `display` concerns half images only. */
    paint(display: DisplayState): void;
    /** R G B A bytes as painted, from the top left. */
    read(display: DisplayState): Uint8ClampedArray;
}
