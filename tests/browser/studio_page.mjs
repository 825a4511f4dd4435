/** The studio page in a browser: opening it, using it by hand, reading what it shows. */
import assert from "node:assert/strict";
import { isDeepStrictEqual } from "node:util";
import { chromium } from "playwright-core";
import { setting } from "./programs.mjs";
import { floatFromHalf } from "./images.mjs";

const kPatienceMilliseconds = 60_000;

export function launchBrowser() {
    return chromium.launch({
        executablePath: setting("CHROMIUM"),
        args: [
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
        ],
    });
}

export class StudioPage {
    constructor(page) {
        this.page = page;
        this.errors = [];
        page.setDefaultTimeout(kPatienceMilliseconds);
        page.on("pageerror", (error) => this.errors.push(String(error.stack ?? error)));
    }

    static async open(browser, address, viewport = { width: 1440, height: 900 }) {
        // Playwright waits by evaluating text in the page, which the server's policy forbids;
        // policy.test.mjs looks at the page under the policy.
        const studio = new StudioPage(await browser.newPage({ viewport, bypassCSP: true }));
        await studio.page.goto(address);
        return studio;
    }

    /** The condition is a function of window.relume, evaluated in the page. */
    async until(condition, argument) {
        const source = `window.relume !== undefined && (${condition})(window.relume, ${JSON.stringify(argument ?? null)})`;
        return await (await this.page.waitForFunction(source)).jsonValue();
    }

    /** Tries an assertion until it holds: what is shown follows what is known by a frame. */
    async sees(assertion) {
        const deadline = performance.now() + kPatienceMilliseconds;
        for (;;) {
            try {
                return await assertion();
            } catch (error) {
                if (performance.now() > deadline) throw error;
                await this.page.waitForTimeout(50);
            }
        }
    }

    /** What `read` gives once it gives the same twice, a tenth of a second apart. */
    async steady(read) {
        for (let last = await read(); ; ) {
            await this.page.waitForTimeout(100);
            const next = await read();
            if (isDeepStrictEqual(next, last)) return next;
            last = next;
        }
    }

    /** The element's words, once they are like `expected`: a string, or a pattern. */
    says(locator, expected) {
        return this.sees(async () => {
            const words = (await locator.innerText()).trim();
            if (typeof expected === "string") assert.equal(words, expected);
            else assert.match(words, expected);
            return words;
        });
    }

    untilExact() {
        return this.until((relume) => relume.exact);
    }

    revision() {
        return this.page.evaluate(() => window.relume.revision);
    }

    display() {
        return this.page.evaluate(() => window.relume.display);
    }

    button(name) {
        return this.page.getByRole("button", { name });
    }

    /** The row of a light in the list. */
    light(id) {
        return this.page.locator(`[data-light-item="${id}"]`);
    }

    /** Brings a file by the page's own button. */
    bring(name, buffer) {
        const mimeType = "application/octet-stream";
        return this.page.setInputFiles("#upload-input", { name, mimeType, buffer });
    }

    /** Types into a field of tweakpane, found by its label. */
    async type(label, text) {
        const field = this.page.locator(`input[aria-label="${label}"]`).first();
        await field.fill(text);
        await field.press("Enter");
    }

    state() {
        return this.page.evaluate(() => window.relume.state);
    }

    /** Drags on the image by (dx, dy) pixels in `steps` moves. */
    async drag(dx, dy, { steps = 12, shift = false, alt = false } = {}) {
        const { mouse, keyboard } = this.page;
        const box = await this.page.locator("#image-frame").boundingBox();
        const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
        if (shift) await keyboard.down("Shift");
        if (alt) await keyboard.down("Alt");
        await mouse.move(x, y);
        await mouse.down();
        for (let i = 1; i <= steps; ++i)
            await mouse.move(x + (dx * i) / steps, y + (dy * i) / steps);
        await mouse.up();
        if (shift) await keyboard.up("Shift");
        if (alt) await keyboard.up("Alt");
    }

    /** `{header, rgb, pixels, display}`: the settled image, linear, and the canvas as it is. */
    async shown() {
        const raw = await this.page.evaluate(() => {
            const { header, planes } = window.relume.settled();
            return {
                header,
                display: window.relume.display,
                planes: [planes.R, planes.G, planes.B].map((plane) => Array.from(plane)),
                pixels: Array.from(window.relume.pixels()),
            };
        });
        const { header, display, pixels, planes } = raw;
        const rgb = new Float32Array(header.width * header.height * 3);
        planes.forEach((plane, c) => {
            plane.forEach((bits, i) => (rgb[i * 3 + c] = floatFromHalf(bits)));
        });
        return { header, display, pixels, rgb };
    }

    notice() {
        return this.page.locator(".notice-error").last();
    }

    saysMark(words) {
        return this.says(this.page.locator("#mark-words"), words);
    }

    close() {
        return this.page.close();
    }
}
