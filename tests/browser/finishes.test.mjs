/** Parts of a scene that are given other materials, while light and camera move. */
import assert from "node:assert/strict";
import { writeFile } from "node:fs/promises";
import { describe, it } from "node:test";
import { readExr, relativeL2 } from "./images.mjs";
import { relume } from "./programs.mjs";
import { output, Suite } from "./suite.mjs";

describe("finishes", { timeout: 180_000 }, () => {
    const suite = new Suite("finishes");
    const walk = async (room) => {
        const page = await suite.open(`scene=walk&room=${room}`);
        await page.untilExact();
        return page;
    };
    const state = (page) => page.page.evaluate(() => JSON.stringify(window.relume.state));
    /** The exact image after an act that changes the room's state. */
    async function after(page, act) {
        const before = await state(page);
        await act();
        await page.sees(async () => assert.notEqual(await state(page), before));
        await page.untilExact();
        return page.shown();
    }
    const finishOf = async (page, part) => (await page.state()).finishes[part] ?? null;
    const choosePart = (page, part) => page.page.locator(`[data-part="${part}"]`).click();
    const press = (page, name) =>
        page.page.locator("#finishes-card").getByRole("button", { name, exact: true }).click();
    const chooseMaterial = (page, name) =>
        page.page.locator("#finishes-card select").selectOption({ label: name });

    it("are chosen by part, with number and colour; undone, and taken back", async () => {
        const page = await walk("chosen");
        const { scenes } = await suite.server.json("/api/scenes");
        const { parts } = scenes.find(({ name }) => name === "walk");
        assert.ok(parts.length > 1);
        const part = parts[0].id;
        const baked = await page.shown();
        await choosePart(page, part);
        const sharp = await after(page, () => chooseMaterial(page, "phong"));
        assert.ok(relativeL2(sharp.rgb, baked.rgb) > 0.01, "another picture");
        assert.equal((await finishOf(page, part)).material, "phong");

        const soft = await after(page, () => page.type("exponent", "8"));
        assert.ok(relativeL2(sharp.rgb, soft.rgb) > 0.001, "another exponent");
        assert.equal((await finishOf(page, part)).parameter, 8);

        const red = await after(page, () => page.type("colour", "#ff2000"));
        const share = ({ rgb }, c) =>
            rgb.reduce((sum, value, i) => sum + (i % 3 === c ? value : 0), 0) /
            rgb.reduce((sum, value) => sum + value, 0);
        assert.ok(share(red, 0) > share(soft, 0), "redder");
        await page.page.screenshot({ path: output("finishes.png") });

        const undone = await after(page, () => press(page, "Undo"));
        assert.ok(undone.rgb.every((value, i) => value === soft.rgb[i]), "undone bit for bit");
        const back = await after(page, () => press(page, "As baked"));
        assert.ok(back.rgb.every((value, i) => value === baked.rgb[i]), "as baked bit for bit");
        assert.equal(await finishOf(page, part), null);
    });

    it("move with light and camera, for everybody, and the client makes the same", async () => {
        const page = await walk("moving");
        const other = await walk("moving");
        const part = await page.page.locator("[data-part]").first().getAttribute("data-part");
        await choosePart(page, part);
        await after(page, () => chooseMaterial(page, "white"));
        await after(page, () => page.drag(90, 15)); // the camera
        const lit = await after(page, () => page.drag(90, 0, { alt: true })); // the light
        await page.saysMark("Exact");
        await other.untilExact();
        const seen = await other.shown();
        assert.ok(seen.rgb.every((value, i) => value === lit.rgb[i]), "everybody sees it");

        const { environment, rotation, camera, finishes } = await page.state();
        const patch = output("finishes.json");
        const file = output("finishes.exr");
        await writeFile(patch, JSON.stringify({ environment, rotation, camera, finishes }));
        await relume(
            ...["render", "--server", suite.server.origin, "--scene", "walk"],
            ...["--patch", `@${patch}`, "--until-exact", "-o", file],
        );
        assert.ok(relativeL2((await readExr(file)).rgb, lit.rgb) <= 1e-5);
    });

    it("are no more than what the server offers for the scene", async () => {
        const page = await walk("offered");
        const offered = await page.page
            .locator("#finishes-card select option")
            .allTextContents();
        assert.deepEqual(offered, ["as baked", "phong", "white"]);
        const elsewhere = await suite.room("no-parts");
        assert.ok(await elsewhere.page.locator("#finishes-card").isHidden());
    });

    it("are a load that moves all there is, and a step of a sequence", async () => {
        const { stdout } = await relume(
            ...["load", "--server", suite.server.origin, "--scene", "walk"],
            ...["--sessions", "2", "--seconds", "1"],
        );
        const result = JSON.parse(stdout);
        assert.ok(result.ok && result.edits > 10 && result.edits_shown > 0, stdout);
        const part = (await suite.server.json("/api/scenes")).scenes.find(
            ({ name }) => name === "walk",
        ).parts[0].id;
        const script = output("finish-sequence.json");
        const finish = { part, material: "phong", parameter: [4, 32], images: 8 };
        await writeFile(
            script,
            JSON.stringify({ scene: "walk", steps: [{ finish }, { rest: { until: "exact" } }] }),
        );
        const played = await relume("sequence", script, "--server", suite.server.origin);
        assert.equal(JSON.parse(played.stdout).exact, true, played.stdout);
    });
});
