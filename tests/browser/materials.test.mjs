/** Light and materials of one scene, edited in one room. */
import assert from "node:assert/strict";
import { writeFile } from "node:fs/promises";
import { describe, it } from "node:test";
import { readExr, relativeL2 } from "./images.mjs";
import { after, choose, click, isChosen, pixelsByMaterial, ratio } from "./material_hand.mjs";
import { relume } from "./programs.mjs";
import { output, Suite } from "./suite.mjs";

describe("materials beside the light", { timeout: 240_000 }, () => {
    const suite = new Suite("materials");
    const wear = async (room) => {
        const page = await suite.open(`scene=wear&room=${room}`);
        await page.untilExact();
        return page;
    };
    const picture = (page, name) =>
        page.page.screenshot({ path: output(`materials-${name}.png`) });
    const turned = (page) =>
        page.page.evaluate(() => JSON.stringify(window.relume.state.rotation.quaternion));
    /** Turns the light by hand. */
    async function turn(page, pixels) {
        const before = await turned(page);
        await page.drag(pixels, 0);
        await page.sees(async () => assert.notEqual(await turned(page), before));
        await page.untilExact();
        return page.shown();
    }

    it("shows both panels, and edits of each keep those of the other", async () => {
        const page = await wear("both");
        for (const id of ["environment-panel", "light-card", "materials-card"]) {
            assert.ok(await page.page.locator(`#${id}`).isVisible(), id);
        }
        const pixels = await pixelsByMaterial(suite, page, "wear");
        const baked = await page.shown();
        await click(page, pixels.pearl, baked.header);
        await isChosen(page, "pearl.distribution");
        await picture(page, "baked");

        await choose(page, "cloth.distribution");
        const blue = await after(page, "cloth.distribution", async () => {
            await page.type("diffuse colour", "#1040ff");
            await page.type("diffuse EV", "3");
        });
        const blueness = ratio(2, 0);
        assert.ok(
            blueness(blue.rgb, pixels.cloth) > 1.5 * blueness(baked.rgb, pixels.cloth),
            "another cloth",
        );
        await choose(page, "post.fresnel");
        const gold = await after(page, "post.fresnel", () =>
            page.page.locator('[data-preset="gold"]').click(),
        );
        const yellowness = ratio(0, 2);
        assert.ok(
            yellowness(gold.rgb, pixels.post) > 1.2 * yellowness(blue.rgb, pixels.post),
            "gold posts",
        );
        await picture(page, "gold");

        const lit = await turn(page, 160);
        assert.ok(relativeL2(lit.rgb, gold.rgb) > 0.02, "another light");
        assert.ok(
            blueness(lit.rgb, pixels.cloth) > 1.2 * blueness(baked.rgb, pixels.cloth),
            "the cloth is as edited under it",
        );
        await page.saysMark("Exact");
        await picture(page, "turned");

        // The client comes to the same from nothing.
        const { environment, rotation, materials } = await page.state();
        const patch = output("wear.json");
        const file = output("wear.exr");
        await writeFile(patch, JSON.stringify({ environment, rotation, materials }));
        await relume(
            ...["render", "--server", suite.server.origin, "--scene", "wear"],
            ...["--patch", `@${patch}`, "--until-exact", "-o", file],
        );
        assert.ok(relativeL2((await readExr(file)).rgb, lit.rgb) <= 1e-5);

        // All taken back, every half is as it was.
        const fresh = await wear("fresh");
        await turn(fresh, 160);
        const unedited = await fresh.shown();
        for (const id of ["post.fresnel", "cloth.distribution"]) {
            await choose(page, id);
            await after(page, id, () => page.button("As baked").click());
        }
        const back = await page.shown();
        assert.ok(back.rgb.every((value, i) => value === unedited.rgb[i]));
    });

    it("is a load that edits light and materials", async () => {
        const { stdout } = await relume(
            ...["load", "--server", suite.server.origin, "--scene", "wear"],
            ...["--sessions", "2", "--idle", "1", "--seconds", "1"],
        );
        const result = JSON.parse(stdout);
        assert.ok(result.ok && result.edits > 10 && result.edits_shown > 0, stdout);
    });
});
