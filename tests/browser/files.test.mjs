/** What people bring to the page and take from it, and what comes back after a restart. */
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { readFile } from "node:fs/promises";
import { describe, it } from "node:test";
import { promisify } from "node:util";
import { largestCodeDistance, readExr, relativeL2 } from "./images.mjs";
import { radianceFile } from "./maps.mjs";
import { relume } from "./programs.mjs";
import { output, Suite } from "./suite.mjs";

const run = promisify(execFile);

describe("files", { timeout: 240_000 }, () => {
    const suite = new Suite("files");

    async function download(page, act, fileName) {
        const [file] = await Promise.all([page.page.waitForEvent("download"), act()]);
        await file.saveAs(output(fileName));
        return output(fileName);
    }

    const saveFromMenu = (page, name) => async () => {
        await page.page.locator("#save-button").click();
        await page.page.locator(`#save-${name}`).click();
    };

    it("saves the settled image as it shows, as PNG", async () => {
        const page = await suite.room("png");
        const path = await download(page, () => page.page.keyboard.press("s"), "saved.png");
        const address = `data:image/png;base64,${(await readFile(path)).toString("base64")}`;
        const saved = await page.page.evaluate(async (url) => {
            const image = new Image();
            image.src = url;
            await image.decode();
            const canvas = document.createElement("canvas");
            canvas.width = image.naturalWidth;
            canvas.height = image.naturalHeight;
            const context = canvas.getContext("2d");
            context.drawImage(image, 0, 0);
            return Array.from(context.getImageData(0, 0, canvas.width, canvas.height).data);
        }, address);
        const { rgb, display } = await page.shown();
        assert.equal(saved.length, (rgb.length / 3) * 4);
        assert.ok(largestCodeDistance(saved, rgb, display) <= 1);
    });

    it("saves the half floats it holds as EXR that other programs read", async () => {
        const page = await suite.room("exr");
        const path = await download(page, saveFromMenu(page, "exr"), "saved.exr");
        const { rgb, header } = await page.shown();
        const read = await readExr(path);
        assert.deepEqual([read.width, read.height], [header.width, header.height]);
        assert.deepEqual(read.rgb, rgb);
        const { stdout } = await run("oiiotool", ["--info", "-v", "--stats", path]);
        assert.match(stdout, /half/);
        assert.match(stdout, /revision 0, exact/);
        assert.match(stdout, new RegExp(`${header.width} x +${header.height}, 3 channel`));
    });

    it("saves the lighting, which relume renders, and takes it back", async () => {
        const page = await suite.room("lighting");
        await page.page.keyboard.press("l");
        await page.until((relume) => relume.state.lights.key !== undefined);
        await page.drag(130, 0);
        await page.page.keyboard.press("]");
        await page.untilExact();
        const state = await page.state();
        const display = await page.display();
        const { rgb } = await page.shown();
        const path = await download(
            page,
            saveFromMenu(page, "lighting"),
            "saved.lighting.json",
        );
        const text = await readFile(path, "utf8");
        const file = output("lighting.exr");
        await relume(
            ...["render", "--server", suite.server.origin, "--scene", suite.scene],
            ...["--patch", `@${path}`, "--until-exact", "-o", file],
        );
        assert.ok(relativeL2((await readExr(file)).rgb, rgb) <= 1e-5);

        const other = await suite.room("lighting-2");
        await other.page.keyboard.press("l");
        await other.page.keyboard.press("l");
        await other.until((relume) => relume.state.lights.fill !== undefined);
        await other.page.evaluate((json) => {
            const files = new DataTransfer();
            files.items.add(new File([json], "saved.lighting.json"));
            window.dispatchEvent(
                new DragEvent("drop", { dataTransfer: files, cancelable: true }),
            );
        }, text);
        await other.until((relume) => relume.state.lights.fill === undefined && relume.exact);
        const found = await other.state();
        for (const section of ["environment", "blend", "rotation", "lights", "background"]) {
            assert.deepEqual(found[section], state[section]);
        }
        assert.deepEqual(await other.display(), display);
        assert.ok(relativeL2((await other.shown()).rgb, rgb) <= 1e-5);

        await other.bring("broken.json", Buffer.from('{"lights": ['));
        await other.notice().filter({ hasText: "not JSON" }).waitFor();
        await other.bring("other.json", Buffer.from('{"name": "package"}'));
        await other.notice().filter({ hasText: "no lighting" }).waitFor();
    });

    it("asks what a square picture is", async () => {
        const page = await suite.room("square");
        await page.bring("ball.hdr", radianceFile(64, 64));
        await page.until((relume) => relume.state.environment.name === "ball");
        await page.page.locator(".notice", { hasText: "angular map" }).waitFor();
        await page.untilExact();
        const ball = await page.shown();
        await page.button("Read it as lat-long").click();
        await page.page.waitForFunction(() => window.relume.revision >= 2);
        await page.untilExact();
        assert.ok(relativeL2((await page.shown()).rgb, ball.rgb) > 1e-3);
        const question = page.page.locator(".notice", { hasText: "angular map" });
        await page.sees(async () => assert.equal(await question.count(), 0));
    });

    it("shows the map that somebody else has put behind a name, light and picture", async () => {
        const page = await suite.room("replaced");
        await page.bring("ours.hdr", radianceFile(64, 32));
        await page.until((relume) => relume.state.environment.name === "ours");
        await page.untilExact();
        const before = await page.shown();
        const picture = page.page.locator(".environment", { hasText: "ours" }).locator("canvas");
        const green = () =>
            picture.evaluate((c) => c.getContext("2d").getImageData(40, 120, 1, 1).data[1]);
        await page.page.waitForFunction(() => {
            const { data } = document
                .querySelector("#light-map canvas")
                .getContext("2d")
                .getImageData(20, 150, 1, 1);
            return data[1] > 0;
        });
        const shade = await page.sees(async () => {
            const code = await green();
            assert.ok(code > 20, `green is ${code}`);
            return code;
        });
        const revision = await page.revision();
        const other = await suite.room("elsewhere");
        await other.bring("ours.hdr", radianceFile(64, 32, 30));
        await other.until((relume) => relume.state.environment.name === "ours");
        await page.page.bringToFront();
        await page.until((relume, r) => relume.revision > r && relume.exact, revision);
        assert.ok(relativeL2((await page.shown()).rgb, before.rgb) > 0.05, "it is relit");
        await page.page.waitForFunction(
            ([name, was]) => {
                const item = [...document.querySelectorAll(".environment")].find((button) =>
                    button.textContent.includes(name),
                );
                const { data } = item
                    .querySelector("canvas")
                    .getContext("2d")
                    .getImageData(40, 120, 1, 1);
                return data[3] === 255 && data[1] < was - 20;
            },
            ["ours", shade],
        );
    });

    it("brings all back after a restart, the uploaded map from its own copy", async () => {
        const page = await suite.room("restart-upload");
        await page.bring("mine.hdr", radianceFile(64, 32));
        await page.until((relume) => relume.state.environment.name === "mine");
        await page.page.keyboard.press("l");
        await page.until((relume) => relume.state.lights.key !== undefined);
        await page.drag(100, 0);
        await page.untilExact();
        const before = await page.state();
        const image = await page.shown();
        await suite.server.stop();
        await page.until((relume) => relume.status === "waiting");
        await suite.server.start();
        await page.until((relume) => relume.status === "open");
        await page.untilExact();
        assert.notEqual((await page.state()).environment.name, "mine");
        await page.button("Bring back the light as it was").click();
        await page.until((relume) => relume.state.environment.name === "mine");
        await page.untilExact();
        assert.deepEqual(await page.state(), before);
        assert.ok(relativeL2((await page.shown()).rgb, image.rgb) <= 1e-5);
        await page.page.locator(".notice", { hasText: "back as it was" }).waitFor();
        const offer = page.button("Bring back the light as it was");
        await page.sees(async () => assert.equal(await offer.count(), 0));
    });

    it("brings all but a map it has no copy of, and goes on offering", async () => {
        const page = await suite.room("restart-foreign");
        const other = await suite.room("restart-foreign");
        await other.bring("theirs.hdr", radianceFile(64, 32));
        await page.page.bringToFront();
        await page.until((relume) => relume.state.environment.name === "theirs");
        await page.drag(-90, 0);
        await page.untilExact();
        // As another browser would be: without the copy.
        await page.page.evaluate(
            () => new Promise((done) => (indexedDB.deleteDatabase("relume").onsuccess = done)),
        );
        const before = await page.state();
        await suite.server.stop();
        await page.until((relume) => relume.status === "waiting");
        await suite.server.start();
        await page.until((relume) => relume.status === "open");
        await page.untilExact();
        await page.button("Bring back the light as it was").click();
        const said = page.page.locator(".notice", { hasText: "All but the map “theirs”" });
        await said.waitFor();
        await page.says(said, /no copy/);
        await page.page.screenshot({ path: output("all-but-the-map.png") });
        await page.untilExact();
        const partly = await page.state();
        assert.deepEqual(partly.rotation, before.rotation);
        assert.notEqual(partly.environment.name, "theirs");
        // The offer stands; with the file it succeeds by itself.
        assert.equal(await page.button("Bring back the light as it was").count(), 1);
        await page.bring("theirs.hdr", radianceFile(64, 32));
        await page.page.locator(".notice", { hasText: "back as it was" }).waitFor();
        await page.untilExact();
        assert.deepEqual(await page.state(), before);
    });
});
