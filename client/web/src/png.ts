/** The settled image as a PNG file, as it shows; transparent where the scene is. */
import { DisplayTable, pixelsFromHalves, straightPixelsFromHalves } from "./display";
import type { SettledImage } from "./image_view";
import type { DisplayState } from "./wire/state";

export async function pngFromSettled(
    image: SettledImage,
    display: DisplayState,
): Promise<Blob> {
    const { width, height, hasAlpha } = image.header;
    let pixels: ImageData;
    if (hasAlpha) {
        pixels = straightPixelsFromHalves(image.rgba, width, height, display);
    } else {
        const table = new DisplayTable();
        table.update(display);
        pixels = pixelsFromHalves(image.rgba, width, height, table);
    }
    const canvas = document.createElement("canvas");
    canvas.width = width;
    canvas.height = height;
    const context = canvas.getContext("2d");
    if (context === null) throw new Error("this browser offers no 2-D canvas");
    context.putImageData(pixels, 0, 0);
    return new Promise((resolve, reject) => {
        canvas.toBlob(
            (blob) => (blob === null ? reject(new Error("no PNG was made")) : resolve(blob)),
            "image/png",
        );
    });
}
