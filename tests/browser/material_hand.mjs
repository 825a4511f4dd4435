/** Editing materials on the page by hand, and what the image shows of them. */
import assert from "node:assert/strict";

export const luminance = (rgb, i) =>
    0.2126 * rgb[i * 3] + 0.7152 * rgb[i * 3 + 1] + 0.0722 * rgb[i * 3 + 2];
export const mean = (rgb, pixels, of = luminance) =>
    pixels.reduce((sum, i) => sum + of(rgb, i), 0) / pixels.length;
export const highest = (rgb, pixels) => Math.max(...pixels.map((i) => luminance(rgb, i)));
/** Of two channels, over pixels. */
export const ratio = (a, b) => (rgb, pixels) =>
    mean(rgb, pixels, (values, i) => values[i * 3 + a]) /
    mean(rgb, pixels, (values, i) => values[i * 3 + b]);

/** Pixels by what they show, as the server maps them: by the ID of the first of its curves. */
export async function pixelsByMaterial(suite, page, name) {
    const scene = (await suite.server.json("/api/scenes")).scenes.find(
        (one) => one.name === name,
    );
    const places = await page.page.evaluate(async (address) => {
        const response = await fetch(address);
        const bitmap = await createImageBitmap(await response.blob());
        const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
        const context = canvas.getContext("2d");
        context.drawImage(bitmap, 0, 0);
        const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
        return Array.from({ length: data.length / 4 }, (_, i) => data[i * 4]);
    }, `/api/scenes/${name}/materials.png`);
    // Several curves of one material are told apart by what follows a point.
    const ids = [...new Set(scene.materials.map(({ id }) => id.replace(/\..*/, "")))];
    return Object.fromEntries(
        ids.map((id, m) => [id, places.flatMap((place, i) => (place === m + 1 ? [i] : []))]),
    );
}

/** The exact image after an edit of `id`, whose entry has to be another one. */
export async function after(page, id, act) {
    const read = () => page.page.evaluate((key) => window.relume.state.materials[key], id);
    const before = JSON.stringify(await read());
    await act();
    await page.sees(async () =>
        assert.ok(JSON.stringify(await read()) !== before, `${id} is another one`),
    );
    await page.untilExact();
    return page.shown();
}

/** Clicks the image where it shows the material. */
export async function click(page, pixels, { width, height }) {
    const i = pixels[Math.floor(pixels.length / 2)];
    const box = await page.page.locator("#image-frame").boundingBox();
    await page.page.mouse.click(
        box.x + (((i % width) + 0.5) / width) * box.width,
        box.y + ((Math.floor(i / width) + 0.5) / height) * box.height,
    );
}

export const choose = (page, id) => page.page.locator(`[data-material="${id}"]`).click();
export const isChosen = (page, id) =>
    page.sees(async () => {
        const row = page.page.locator(`[data-material="${id}"]`);
        assert.equal(await row.getAttribute("aria-pressed"), "true");
    });
