/** The list of lights, their levels, and what is each viewer's own. */
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { relativeL2 } from "./images.mjs";
import { output, Suite } from "./suite.mjs";

const order = ["key", "fill", "rim", "light-4"];

/** Of the brightest channel, in stops: radiance times solid angle over π. */
function powerStops({ radiance, gain, angular_radius_degrees }) {
    const solidAngle = 2 * Math.PI * (1 - Math.cos((angular_radius_degrees * Math.PI) / 180));
    return Math.log2((Math.max(...radiance) * gain * solidAngle) / Math.PI);
}

describe("lights", { timeout: 240_000 }, () => {
    const suite = new Suite("lights");

    async function withLights(room, count) {
        const page = await suite.room(room);
        for (let i = 1; i <= count; ++i) {
            await page.page.keyboard.press("l");
            await page.until((relume, n) => Object.keys(relume.state.lights).length === n, i);
        }
        await page.untilExact();
        return page;
    }

    const lists = (page, names) =>
        page.sees(async () => {
            assert.deepEqual(await page.page.locator(".light-name").allInnerTexts(), names);
        });

    it("adds lights apart in place and level, a fill larger and two stops down", async () => {
        const page = await withLights("new-lights", 4);
        const { lights } = await page.state();
        assert.deepEqual(Object.keys(lights).sort(), [...order].sort());
        assert.ok(Math.abs(powerStops(lights.fill) - powerStops(lights.key) + 2) < 1e-6);
        assert.ok(lights.fill.angular_radius_degrees > 2 * lights.key.angular_radius_degrees);
        for (const a of order) {
            for (const b of order) {
                const dot = lights[a].direction.reduce(
                    (sum, part, i) => sum + part * lights[b].direction[i],
                    0,
                );
                assert.ok(a === b || dot < 0.95, `${a} and ${b} are apart: cosine ${dot}`);
            }
        }
        // The list says what the slider says.
        await page.light("fill").locator(".light-row").click();
        const slider = page.page.locator('input[aria-label="power EV"]').first();
        const figures = page.light("fill").locator(".light-figures");
        await page.sees(async () => {
            const shown = (await figures.innerText()).trim();
            assert.equal(shown, `${await slider.inputValue()} EV · 25°`);
        });
    });

    it("keeps the lights in their order over a reload, for everyone", async () => {
        const page = await withLights("order", 4);
        await lists(page, order);
        await page.page.reload();
        await page.untilExact();
        await lists(page, order);
    });

    it("renames by double-click, duplicates, and everyone sees it", async () => {
        const page = await withLights("names", 1);
        await page.light("key").locator(".light-row").dblclick();
        const field = page.page.locator(".light-rename");
        await field.fill("Fenster — 窓");
        await field.press("Enter");
        await page.until((relume) => relume.state.lights.key.name === "Fenster — 窓");
        await page.light("key").getByRole("button", { name: "Duplicate" }).click();
        await page.until((relume) => relume.state.lights.fill !== undefined);
        await page.untilExact();
        const { key, fill } = (await page.state()).lights;
        assert.deepEqual(fill.radiance, key.radiance);
        assert.notDeepEqual(fill.direction, key.direction);
        const other = await suite.room("names");
        await lists(other, ["Fenster — 窓", "Fenster — 窓 2"]);
        // Escape leaves the name alone.
        await page.light("key").locator(".light-row").dblclick();
        await page.page.locator(".light-rename").fill("no");
        await page.page.keyboard.press("Escape");
        assert.equal((await page.state()).lights.key.name, "Fenster — 窓");
    });

    it("mutes and solos: the images of the parts add up, the header says solo", async () => {
        const page = await withLights("solo", 2);
        await page.page.keyboard.press("b"); // a background of one colour …
        await page.page.keyboard.press("b"); // … and none: only what is lit counts
        await page.untilExact();
        const shown = async () => {
            await page.page.waitForTimeout(50);
            await page.untilExact();
            return (await page.shown()).rgb;
        };
        const press = async (id, key) => {
            const before = await page.revision();
            await page.light(id).locator(`.light-switch-${key}`).click();
            await page.until((relume, revision) => relume.revision > revision, before);
        };
        const all = await shown();
        await press("key", "solo");
        const key = await shown();
        const sign = page.page.locator("#solo-sign");
        await page.says(sign, "Solo: key");
        await page.page.screenshot({ path: output("solo.png") });
        const other = await suite.room("solo");
        await other.says(other.page.locator("#solo-sign"), "Solo: key");
        await page.page.bringToFront();
        await press("key", "muted");
        assert.equal(Math.max(...(await shown())), 0, "mute wins over solo");
        await sign.click();
        await page.until((relume) => !relume.state.lights.key.solo);
        const withoutKey = await shown();
        await sign.waitFor({ state: "hidden" });
        const sum = key.map((part, i) => part + withoutKey[i]);
        const error = relativeL2(sum, all);
        assert.ok(error < 2e-3, `the parts are ${error} off the whole`);
    });

    it("keeps the power of a light that is resized, unless told otherwise", async () => {
        const page = await withLights("power", 1);
        const light = async () => (await page.state()).lights.key;
        const before = await light();
        await page.type("radius °", "20");
        const hasRadius = (relume, degrees) =>
            Math.abs(relume.state.lights.key.angular_radius_degrees - degrees) < 1e-6;
        await page.until(hasRadius, 20);
        const grown = await light();
        assert.ok(Math.abs(powerStops(grown) - powerStops(before)) < 1e-3);
        const remark = page.page.locator(".pane-remark");
        await page.says(remark, /keeps the power/);
        await page.page.locator('select[aria-label="resize keeps"]').selectOption("radiance");
        await page.says(remark, /keeps the radiance/);
        await page.type("radius °", "10");
        await page.until(hasRadius, 10);
        assert.deepEqual((await light()).radiance, grown.radiance);
        await page.type("radius °", "0.3");
        await page.until(hasRadius, 0.3);
        await page.page.locator(".pane-remark", { hasText: "Smaller than a texel" }).waitFor();
    });

    it("understands Kelvin where a colour is typed", async () => {
        const page = await withLights("kelvin", 1);
        await page.type("colour", "3200K");
        await page.until((relume) => relume.state.lights.key.radiance[2] < 100);
        const [r, g, b] = (await page.state()).lights.key.radiance;
        assert.ok(
            Math.abs(g / r - 0.5) < 0.08 && Math.abs(b / r - 0.19) < 0.06,
            `${g / r} ${b / r}`,
        );
        await page.type("tint", "9000 k");
        await page.until((relume) => relume.state.environment.tint[0] < 0.9);
        const { tint } = (await page.state()).environment;
        assert.equal(tint[2], 1);
        // A picker that opens covers nothing.
        await page.page.locator("#lights .tp-colswv_b").click();
        await page.page.waitForFunction(() => {
            const box = (selector) =>
                document.querySelector(`#lights ${selector}`).getBoundingClientRect();
            const picker = box(".tp-colpv");
            const below = box('input[aria-label="radius °"]');
            return picker.height > 80 && picker.bottom <= below.top;
        });
        await page.page.screenshot({ path: output("picker.png") });
    });

    it("shows an environment that is off as dark", async () => {
        const page = await suite.room("dark");
        const brightest = () =>
            page.page.locator("#light-map canvas").evaluate((canvas) => {
                const { data } = canvas.getContext("2d").getImageData(0, 0, 320, 160);
                return data.reduce(
                    (most, code, i) => (i % 4 < 3 ? Math.max(most, code) : most),
                    0,
                );
            });
        await page.page.waitForFunction(() => {
            const canvas = document.querySelector("#light-map canvas");
            return canvas.getContext("2d").getImageData(160, 40, 1, 1).data[2] > 20;
        });
        await page.sees(async () => assert.ok((await brightest()) > 60));
        await page.type("gain EV", "-10");
        await page.until((relume) => relume.state.environment.gain === 0);
        await page.untilExact();
        await page.page.locator(".environment-dark").waitFor();
        await page.sees(async () => assert.equal(await brightest(), 0));
    });

    it("leaves exposure and tone to each viewer, the room having a default", async () => {
        const one = await suite.room("viewers");
        const two = await suite.room("viewers");
        await one.page.bringToFront();
        for (const key of "]]]]t") await one.page.keyboard.press(key);
        await one.drag(60, 0);
        await one.untilExact();
        assert.deepEqual(await one.display(), { exposure_stops: 1, tone: "linear" });
        assert.deepEqual(await two.display(), { exposure_stops: 0, tone: "filmic" });
        await one.button("Make it the room's default").click();
        await two.until((relume) => relume.display.exposure_stops === 1);
        await two.page.bringToFront();
        await two.page.keyboard.press("0");
        await two.until((relume) => relume.display.exposure_stops === 0);
        await two.button("Back to the room's default").click();
        await two.until((relume) => relume.display.exposure_stops === 1);
    });

    it("shows a viewer's own exposure while the light moves, too", async () => {
        for (const painter of ["webgl2", "canvas2d"]) {
            const query = `scene=${suite.scene}&room=own-${painter}`;
            const page = await suite.open(`${query}&painter=${painter}`);
            await page.untilExact();
            for (let i = 0; i < 8; ++i) await page.page.keyboard.press("[");
            // Medians, by the sort of image: 1 is JPEG, 2 half floats.
            await page.page.evaluate(() => {
                window.medians = { 1: [], 2: [] };
                const look = () => {
                    const { image } = window.relume;
                    const green = window.relume.pixels().filter((_, i) => i % 4 === 1);
                    if (image !== null)
                        window.medians[image.encoding].push(green.sort()[green.length >> 1]);
                    requestAnimationFrame(look);
                };
                look();
            });
            await page.drag(20, 0, { steps: 40 });
            await page.page.waitForFunction(() => window.medians[1].length > 3);
            await page.untilExact();
            await page.page.waitForTimeout(100);
            const { 1: moving, 2: settled } = await page.page.evaluate(() => window.medians);
            const range = [Math.min(...settled), Math.max(...settled)];
            for (const median of moving) {
                assert.ok(
                    median > range[0] - 12 && median < range[1] + 12,
                    `${painter}: ${median} while moving, at rest ${range}`,
                );
            }
        }
    });
});
