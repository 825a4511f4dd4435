/** Editing materials by hand on the page: earrings are sharpened, clouded and gilded. */
import assert from "node:assert/strict";
import { writeFile } from "node:fs/promises";
import { describe, it } from "node:test";
import { readExr, relativeL2 } from "./images.mjs";
import { relume } from "./programs.mjs";
import {
    after,
    choose,
    click,
    highest,
    isChosen,
    luminance,
    mean,
    pixelsByMaterial,
    ratio,
} from "./material_hand.mjs";
import { output, Suite } from "./suite.mjs";

/** Around the curve, in CSS pixels (client/web/src/curve_canvas.ts). */
const kMargin = { left: 44, right: 10, top: 10, bottom: 22 };

describe("curves", { timeout: 240_000 }, () => {
    const suite = new Suite("curves");
    const worn = async (room, viewport) => {
        const page = await suite.open(`scene=worn&room=${room}`, viewport);
        await page.untilExact();
        return page;
    };

    /** A place in the picture of the curve: parts of its width and height, from the lower left. */
    async function place(page, u, height) {
        const box = await page.page.locator(".curve-frame").boundingBox();
        return [
            box.x + kMargin.left + u * (box.width - kMargin.left - kMargin.right),
            box.y + kMargin.top + (1 - height) * (box.height - kMargin.top - kMargin.bottom),
        ];
    }

    async function drawCurve(page, points) {
        const { mouse } = page.page;
        await mouse.move(...(await place(page, ...points[0])));
        await mouse.down();
        for (const point of points.slice(1)) {
            await mouse.move(...(await place(page, ...point)), { steps: 8 });
        }
        await mouse.up();
    }

    const tool = (page, name) => page.page.locator(`[data-tool="${name}"]`).click();
    const picture = (page, name) => page.page.screenshot({ path: output(`curves-${name}.png`) });
    const isEdited = (page, id) =>
        page.page.evaluate((key) => key in window.relume.state.materials, id);

    it("takes earrings from dull to golden: sharper, hazy, another cloth, gold", async (test) => {
        const page = await worn("figure");
        const pixels = await pixelsByMaterial(suite, page, "worn");
        const baked = await page.shown();
        await choose(page, "cloth");
        await click(page, pixels.pearl, baked.header);
        await isChosen(page, "pearl");
        await picture(page, "baked");

        const sharp = await after(page, "pearl", () => page.type("roughness", "0.03"));
        assert.ok(
            highest(sharp.rgb, pixels.pearl) > 1.2 * highest(baked.rgb, pixels.pearl),
            "sharper pearls have brighter highlights",
        );
        await picture(page, "sharp");

        await page.page.locator('[data-axis="log"]').click();
        const hazy = await after(page, "pearl", () =>
            drawCurve(page, [
                [0.35, 0.72],
                [0.55, 0.6],
                [0.7, 0.3],
            ]),
        );
        assert.ok(
            mean(hazy.rgb, pixels.pearl) > 1.05 * mean(sharp.rgb, pixels.pearl),
            "a second, hazy reflection adds light",
        );
        const [pearl] = await page.page.evaluate(() => [window.relume.state.materials.pearl]);
        assert.equal(pearl.samples.length, 256);
        assert.equal(pearl.shape ?? null, null, "what is drawn is no shape");
        await picture(page, "hazy");

        await choose(page, "cloth");
        const blue = await after(page, "cloth", async () => {
            await page.type("diffuse colour", "#1040ff");
            await page.type("diffuse EV", "3");
        });
        const blueness = ratio(2, 0);
        assert.ok(
            blueness(blue.rgb, pixels.cloth) > 1.5 * blueness(hazy.rgb, pixels.cloth),
            "another cloth colour",
        );
        await picture(page, "cloth");

        await choose(page, "post");
        const gold = await after(page, "post", () =>
            page.page.locator('[data-preset="gold"]').click(),
        );
        const yellowness = ratio(0, 2);
        assert.ok(
            yellowness(gold.rgb, pixels.post) > 1.2 * yellowness(blue.rgb, pixels.post),
            "gold posts",
        );
        await page.saysMark("Exact");
        await picture(page, "gold");
        const highlights = [baked, sharp].map(({ rgb }) => highest(rgb, pixels.pearl));
        test.diagnostic(`highlights of the pearls: ${highlights.join(" to ")}`);

        // A pixel of one material has that material's edits, and no other's.
        const others = pixels.post.filter((i) => luminance(baked.rgb, i) > 0);
        const same = others.filter((i) =>
            [0, 1, 2].every((c) => blue.rgb[i * 3 + c] === hazy.rgb[i * 3 + c]),
        );
        assert.ok(same.length > others.length / 3, "the cloth's colour is not the posts'");

        for (const id of ["post", "cloth", "cloth", "pearl", "pearl"]) {
            await after(page, id, () => page.page.keyboard.press("Control+z"));
        }
        const back = await page.shown();
        assert.ok(
            back.rgb.every((value, i) => value === baked.rgb[i]),
            "undone, every half is as it was",
        );
        for (const id of ["pearl", "pearl", "cloth", "cloth", "post"]) {
            await after(page, id, () => page.page.keyboard.press("Control+Shift+Z"));
        }
        assert.ok(relativeL2((await page.shown()).rgb, gold.rgb) < 1e-4, "done again");
    });

    it("shows everyone the same curve, and what the client renders by it", async () => {
        const page = await worn("shared");
        const other = await worn("shared");
        await choose(page, "pearl");
        await after(page, "pearl", () =>
            drawCurve(page, [
                [0.05, 0.9],
                [0.3, 0.5],
            ]),
        );
        const { samples } = (await page.state()).materials.pearl;
        await other.until(
            (relume, wanted) => JSON.stringify(relume.state.materials.pearl?.samples) === wanted,
            JSON.stringify(samples),
        );
        await other.untilExact();
        const shown = await page.shown();
        assert.equal(relativeL2((await other.shown()).rgb, shown.rgb), 0);

        const curve = output("curve.json");
        const file = output("curve.exr");
        await writeFile(curve, JSON.stringify(samples));
        await relume(
            ...["render", "--server", suite.server.origin, "--scene", "worn"],
            ...["--curve", `pearl=@${curve}`, "--until-exact", "-o", file],
        );
        assert.ok(relativeL2((await readExr(file)).rgb, shown.rgb) <= 1e-5);

        await after(other, "pearl", () => other.button("As baked").click());
        await page.until((relume) => !("pearl" in relume.state.materials));
    });

    it("says how a measured material comes into a scene", async () => {
        const page = await worn("measured");
        const remark = page.page.locator("details.material-remark");
        const option = remark.getByText("--measured MATERIAL=FILE");
        assert.equal(await option.isVisible(), false);
        await remark.getByText("Measured materials").click();
        await option.waitFor({ state: "visible" });
    });

    it("is worked by the keyboard, and has points to move, add and remove", async () => {
        const page = await worn("keys");
        const { keyboard, mouse } = page.page;
        await choose(page, "pearl");
        const curve = () => page.page.evaluate(() => window.relume.state.materials.pearl?.samples);
        await page.page.locator(".curve-frame").focus();
        for (let i = 0; i < 3; ++i) await keyboard.press("ArrowRight");
        await after(page, "pearl", () => keyboard.press("ArrowUp"));
        const raised = await curve();
        assert.equal(raised.length, 256);
        await after(page, "pearl", () => keyboard.press("Control+z"));
        assert.equal(await isEdited(page, "pearl"), false);

        await tool(page, "points");
        await page.page.locator(".curve-frame").focus();
        for (let i = 0; i < 2; ++i) await keyboard.press("ArrowRight");
        await after(page, "pearl", () => keyboard.press("ArrowUp"));
        const points = () => page.page.evaluate(() => window.relume.state.materials.pearl.points);
        const count = (await points()).length;
        await after(page, "pearl", () => keyboard.press("Insert"));
        assert.equal((await points()).length, count + 1);
        await after(page, "pearl", () => keyboard.press("Delete"));
        assert.equal((await points()).length, count);
        const [x, y] = await place(page, 0.9, 0.8);
        await after(page, "pearl", () => mouse.dblclick(x, y));
        assert.equal((await points()).length, count + 1);
        const added = (await points()).find(([u]) => Math.abs(u - 0.9) < 0.02);
        assert.ok(added !== undefined, "a point stands where the hand was");
        const samples = await curve();
        assert.ok(
            Math.abs(samples[Math.round(added[0] * 255)][0] - added[1]) < 0.05 * added[1],
            "the curve passes its points",
        );
    });

    it("has no light to turn, and fits a phone, where a finger draws", async () => {
        const page = await worn("phone", { width: 390, height: 844 });
        for (const id of ["environment-panel", "light-card", "camera-card"]) {
            assert.ok(await page.page.locator(`#${id}`).isHidden(), id);
        }
        await choose(page, "pearl");
        const revision = await page.revision();
        await page.drag(60, 20);
        assert.equal(await page.revision(), revision, "a drag on the image edits nothing");
        const wide = await page.page.evaluate(() => document.documentElement.scrollWidth);
        assert.ok(wide <= 390, `${wide} pixels across`);
        await page.page.locator(".curve-frame").scrollIntoViewIfNeeded();
        await page.sees(async () => {
            const frame = await page.page.locator("#image-frame").boundingBox();
            assert.ok(frame.y + frame.height > 100 && frame.y < 300, "the image stays in sight");
        });
        const session = await page.page.context().newCDPSession(page.page);
        const touch = async (type, ...at) =>
            session.send("Input.dispatchTouchEvent", {
                type,
                touchPoints: at.length === 0 ? [] : [{ x: at[0], y: at[1] }],
            });
        await after(page, "pearl", async () => {
            await touch("touchStart", ...(await place(page, 0.2, 0.3)));
            await touch("touchMove", ...(await place(page, 0.3, 0.5)));
            await touch("touchMove", ...(await place(page, 0.5, 0.6)));
            await touch("touchEnd");
        });
        await picture(page, "phone");
    });

    it("is a load that the client makes", async () => {
        const { stdout } = await relume(
            ...["load", "--server", suite.server.origin, "--scene", "worn"],
            ...["--sessions", "2", "--idle", "1", "--seconds", "1"],
        );
        const result = JSON.parse(stdout);
        assert.ok(result.ok && result.edits > 10 && result.edits_shown > 0, stdout);
        await assert.rejects(
            relume(
                ...["render", "--server", suite.server.origin, "--scene", "worn"],
                ...["--diffuse", "perl=1,0,0", "-o", output("none.png")],
            ),
            /did you mean pearl/,
        );
    });
});
