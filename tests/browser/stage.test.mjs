/** The stage and what is around it: zoom, full screen, messages, the header, small screens. */
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { output, Suite } from "./suite.mjs";

const phone = { width: 390, height: 844 };

function overlap(a, b) {
    const width = Math.min(a.x + a.width, b.x + b.width) - Math.max(a.x, b.x);
    const height = Math.min(a.y + a.height, b.y + b.height) - Math.max(a.y, b.y);
    return Math.max(0, width) * Math.max(0, height);
}

describe("stage", { timeout: 240_000 }, () => {
    const suite = new Suite("stage");

    it("zooms about the pointer and pans; pixels are crisp beyond three", async () => {
        const page = await suite.room("zoom");
        const frame = page.page.locator("#image-frame");
        const pixels = () => frame.getAttribute("data-pixels");
        const rendering = () =>
            page.page
                .locator(".image-canvas")
                .evaluate((c) => getComputedStyle(c).imageRendering);
        const fit = await frame.boundingBox();
        const image = (await page.shown()).header;
        const perPixel = async () => (await frame.boundingBox()).width / image.width;
        await page.page.keyboard.press("f");
        await page.sees(async () => {
            assert.ok(Math.abs((await perPixel()) - 1) < 1e-3, "one to one");
            assert.equal(await rendering(), "auto");
        });
        const fits = () =>
            page.sees(async () => assert.deepEqual(await frame.boundingBox(), fit));
        await page.page.keyboard.press("f");
        await fits();

        const at = { x: fit.x + fit.width * 0.25, y: fit.y + fit.height * 0.3 };
        const exposure = (await page.display()).exposure_stops;
        await page.page.mouse.move(at.x, at.y);
        await page.page.keyboard.down("Control");
        for (let i = 0; i < 12; ++i) await page.page.mouse.wheel(0, -100);
        await page.page.keyboard.up("Control");
        await page.page.waitForFunction(
            () => document.getElementById("image-frame").dataset.pixels === "crisp",
        );
        await page.sees(async () => assert.equal(await rendering(), "pixelated"));
        const near = await page.steady(() => frame.boundingBox());
        assert.ok(Math.abs((at.x - near.x) / near.width - 0.25) < 1e-2);
        assert.ok(Math.abs((at.y - near.y) / near.height - 0.3) < 1e-2);
        assert.equal((await page.display()).exposure_stops, exposure);
        await page.page.screenshot({ path: output("zoomed.png") });

        const revision = await page.revision();
        const pan = async () => {
            await page.page.mouse.down();
            await page.page.mouse.move(at.x + 60, at.y + 40, { steps: 4 });
            await page.page.mouse.up();
        };
        await page.page.keyboard.down("Space");
        await pan();
        await page.page.keyboard.up("Space");
        await page.sees(async () => {
            const moved = await frame.boundingBox();
            assert.ok(Math.abs(moved.x - near.x - 60) < 1, `${moved.x}, was ${near.x}`);
            assert.ok(Math.abs(moved.y - near.y - 40) < 1, `${moved.y}, was ${near.y}`);
        });
        assert.equal(await page.revision(), revision, "panning is no edit");
        // Without Space the hand turns the light, zoomed or not.
        await page.page.mouse.move(at.x, at.y);
        await pan();
        await page.until((relume, r) => relume.revision > r, revision);
        // The plain wheel stays with exposure.
        await page.page.mouse.wheel(0, -100);
        await page.until((relume, e) => relume.display.exposure_stops > e, exposure);
        await page.page.keyboard.press("f");
        await fits();
        assert.ok(["crisp", "smooth"].includes(await pixels()));
    });

    it("fills the screen and comes back", async () => {
        const page = await suite.room("full");
        const before = await page.page.locator("#stage").boundingBox();
        await page.page.keyboard.press("Shift+F");
        await page.page.waitForFunction(() => document.fullscreenElement?.id === "stage");
        await page.page.waitForFunction(
            () => document.getElementById("stage").clientWidth === innerWidth,
        );
        const full = await page.page.locator("#stage").boundingBox();
        assert.ok(full.width > before.width && full.height > before.height);
        await page.page.keyboard.press("Shift+F");
        await page.page.waitForFunction(() => document.fullscreenElement === null);
    });

    it("says faults beside the picture, counts what is said again, and lets them go", async () => {
        const page = await suite.room("notices");
        await page.page.clock.install();
        for (let i = 0; i < 3; ++i) {
            await page.bring("noise.hdr", Buffer.from("this is no picture"));
            await page.page.locator("#upload-button:not([disabled])").waitFor();
        }
        await page.page.locator(".notice-count", { hasText: "× 3" }).waitFor();
        assert.equal(await page.page.locator(".notice").count(), 1);
        await page.page.screenshot({ path: output("notice.png") });
        const notice = await page.page.locator(".notice").boundingBox();
        const image = await page.page.locator("#image-frame").boundingBox();
        assert.equal(overlap(notice, image), 0, "the picture stays free");
        await page.page.clock.fastForward(30_000);
        const notices = page.page.locator(".notice");
        await page.sees(async () => assert.equal(await notices.count(), 0));
    });

    it("shows mark and figures of one image", async () => {
        const page = await suite.room("figures");
        // Looks at every change of the readouts, not only now and then.
        await page.page.evaluate(() => {
            window.seen = [];
            const look = () => {
                const mark = document.getElementById("mark").dataset.kind;
                const error = document.getElementById("figure-error").textContent;
                const pending = document.getElementById("figure-pending").textContent;
                if (mark === "exact" && (error !== "0" || pending !== "all coefficients"))
                    window.seen.push(`${mark} beside ${error}, ${pending}`);
            };
            const readouts = document.querySelector(".readouts");
            new MutationObserver(look).observe(readouts, {
                subtree: true,
                childList: true,
                characterData: true,
                attributes: true,
            });
        });
        for (let i = 0; i < 3; ++i) {
            await page.drag(80, 0);
            await page.untilExact();
        }
        assert.deepEqual(await page.page.evaluate(() => window.seen), []);
    });

    it("says beside exact what the bake is off by, as the scene list does", async () => {
        const { scenes } = await suite.server.json("/api/scenes");
        const page = await suite.room("bake-error");
        const [{ bake_error: error }] = scenes;
        const note = await page.says(
            page.page.locator("#mark-note"),
            error === undefined ? /^$/ : /^bake ± \d.* %$/,
        );
        if (error !== undefined) {
            const percent = Number(/[\d.]+/.exec(note)[0]);
            assert.ok(Math.abs(percent - 100 * error) < 0.06 * percent, `${note}, ${error}`);
        }
    });

    it("fits its header and panels into a phone", async () => {
        const page = await suite.room("phone", phone);
        await page.page.keyboard.press("l");
        await page.until((relume) => relume.state.lights.key !== undefined);
        await page.light("key").locator(".light-switch-solo").click();
        await page.page.locator("#solo-sign").waitFor();
        await page.untilExact();
        await page.page.evaluate(() => scrollTo(0, 0));
        for (const selector of [".bar > *:visible", ".bar-actions > *", ".light-item > *"]) {
            for (const element of await page.page.locator(selector).all()) {
                const box = await element.boundingBox();
                if (box === null || box.width === 0) continue;
                assert.ok(
                    box.x >= 0 && box.x + box.width <= phone.width,
                    `${selector} lies at ${box.x} … ${box.x + box.width}`,
                );
            }
        }
        const width = await page.page.evaluate(() => document.documentElement.scrollWidth);
        assert.equal(width, phone.width, "nothing is wider than the screen");
        await page.page.screenshot({ path: output("phone.png") });
    });

    it("folds what few need away, a line of words beside each", async () => {
        const page = await suite.room("advanced");
        const advanced = page.page.locator("#strategy-controls");
        const method = advanced.locator('select[aria-label="method"]');
        const height = () => advanced.evaluate((e) => e.getBoundingClientRect().height);
        const folded = await height();
        assert.ok(folded < 60, `folded it is ${folded} px high`);
        await page.button("Advanced").click();
        await page.page.waitForFunction(
            (h) =>
                document.getElementById("strategy-controls").getBoundingClientRect().height > h,
            folded + 150,
        );
        await method.waitFor();
        await page.sees(async () => {
            const notes = await advanced.locator(".blade-note").allInnerTexts();
            assert.equal(notes.length, 4);
            for (const note of notes) assert.ok(note.length > 30, note);
        });
    });

    it("says which scenes there are where one is unknown", async () => {
        const page = await suite.open(`scene=${suite.scene.slice(0, -1)}x&room=nowhere`);
        const veil = page.page.locator("#stage-veil");
        await page.page.locator("#stage-veil a").first().waitFor();
        await page.says(veil, new RegExp(`Did you mean ${suite.scene}\\?`));
        await page.says(veil, /There is:/);
        await page.page.screenshot({ path: output("unknown-scene.png") });
        await veil.locator("a").first().click();
        await page.untilExact();
        assert.equal(await page.page.evaluate(() => window.relume.scene), suite.scene);
    });
});
