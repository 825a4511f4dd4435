/** What a person does with the studio page, done by a browser; see README.md. */
import assert from "node:assert/strict";
import { readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { after, afterEach, before, describe, it } from "node:test";
import { largestCodeDistance, readExr, relativeL2 } from "./images.mjs";
import { relume, Server, setting } from "./programs.mjs";
import { launchBrowser, StudioPage } from "./studio_page.mjs";

const output = (name) => join(setting("STUDIO_OUTPUT"), name);

describe("studio page", { timeout: 240_000 }, () => {
    let server;
    let browser;
    let scene;
    const open = [];

    before(async () => {
        server = await Server.onFreePort();
        await server.start();
        browser = await launchBrowser();
        ({
            scenes: [scene],
        } = await server.json("/api/scenes"));
    });

    after(async () => {
        await browser?.close();
        await server?.stop("SIGTERM");
        await writeFile(output("server.log"), server?.log ?? "");
    });

    afterEach(async () => {
        for (const page of open.splice(0)) {
            assert.deepEqual(page.errors, [], "no script of the page failed");
            await page.close();
        }
    });

    async function openStudio(query) {
        const page = await StudioPage.open(browser, `${server.origin}/?${query}`);
        open.push(page);
        return page;
    }

    /** Renders the same state by the command line and holds the page's image against it. */
    async function compareWithClient(test, page, room, fileName) {
        const file = output(fileName);
        await relume(
            "render",
            "--server",
            server.origin,
            "--scene",
            scene.name,
            ...room,
            "--until-exact",
            "-o",
            file,
        );
        const shown = await page.shown();
        const reference = await readExr(file);
        assert.deepEqual(
            [reference.width, reference.height],
            [shown.header.width, shown.header.height],
        );
        const error = relativeL2(shown.rgb, reference.rgb);
        const distance = largestCodeDistance(shown.pixels, reference.rgb, shown.display);
        test.diagnostic(`${fileName}: relative L2 ${error}, ${distance} code values`);
        assert.ok(
            error <= 1e-5,
            `relative L2 of page to client is ${error}, expected at most 1e-5`,
        );
        assert.ok(distance <= 1, `canvas is ${distance} code values off, expected at most 1`);
    }

    it("drags to another light, becomes exact, and shows what the client renders", async (test) => {
        const page = await openStudio(`scene=${scene.name}&room=drag`);
        await page.untilExact();
        const before = (await page.state()).rotation.quaternion;
        const first = await page.shown();
        await page.drag(180, 0);
        await page.drag(60, 40, { shift: true });
        assert.notDeepEqual((await page.state()).rotation.quaternion, before);
        await page.page.screenshot({ path: output("moving.png") });
        await page.untilExact();
        assert.equal(await page.markWords(), "Exact");
        const second = await page.shown();
        assert.ok(relativeL2(second.rgb, first.rgb) > 1e-3, "the light has moved in the image");
        await page.page.screenshot({ path: output("exact.png") });

        await compareWithClient(test, page, ["--room", "drag"], "same-room.exr");
        const state = JSON.stringify(await page.state());
        await compareWithClient(test, page, ["--patch", state], "own-room.exr");
    });

    it("develops exposure and tone curve itself, at once, with and without WebGL2", async () => {
        for (const painter of ["webgl2", "canvas2d"]) {
            const page = await openStudio(
                `scene=${scene.name}&room=display-${painter}&painter=${painter}`,
            );
            await page.untilExact();
            assert.equal(await page.page.evaluate(() => window.relume.painter), painter);
            const { rgb, header } = await page.shown();
            for (const keys of ["]]]]]", "t", "[[[[[[[[["]) {
                for (const key of keys) await page.page.keyboard.press(key);
                // Before the server can have answered: only this page has developed it.
                const shown = await page.shown();
                assert.equal(shown.header.sequence >= header.sequence, true);
                const distance = largestCodeDistance(shown.pixels, rgb, shown.display);
                assert.ok(
                    distance <= 1,
                    `${painter}: ${distance} code values off after ${keys}`,
                );
            }
            await page.untilExact();
            assert.deepEqual((await page.state()).display, {
                exposure_stops: -1,
                tone: "linear",
            });
        }
    });

    it("adds, moves, resizes and removes an area light", async () => {
        const page = await openStudio(`scene=${scene.name}&room=lights`);
        await page.untilExact();
        const dark = await page.shown();
        const map = page.page.locator("#light-map");
        const { width, height } = await map.boundingBox();
        await map.dblclick({ position: { x: width * 0.75, y: height * 0.25 } });
        await page.until((relume) => relume.state.lights.key !== undefined);
        const light = async () => (await page.state()).lights.key;
        const added = await light();
        // A quarter right of the centre is +X, halfway up is 45°.
        [Math.SQRT1_2, Math.SQRT1_2, 0].forEach((part, i) => {
            assert.ok(
                Math.abs(added.direction[i] - part) < 0.03,
                `direction ${added.direction}`,
            );
        });
        await page.untilExact();
        assert.ok(relativeL2((await page.shown()).rgb, dark.rgb) > 1e-3, "the light lights");

        const shape = page.page.locator('[data-light="key"]');
        await shape.focus();
        await page.page.keyboard.press("ArrowUp");
        await page.page.keyboard.press("+");
        await page.until((relume, before) => {
            const { key } = relume.state.lights;
            return (
                key.direction[1] > before.direction[1] &&
                key.angular_radius_degrees > before.angular_radius_degrees
            );
        }, added);
        await page.untilExact();
        await page.page.screenshot({ path: output("light.png") });
        await page.page.keyboard.press("Delete");
        await page.until((relume) => relume.state.lights.key === undefined);
        await page.untilExact();
        const error = relativeL2((await page.shown()).rgb, dark.rgb);
        assert.ok(error <= 1e-5, `without the light the image is ${error} off what it was`);
    });

    it("shows the same image to everyone in the room", async () => {
        const [one, two] = [
            await openStudio(`scene=${scene.name}&room=shared`),
            await openStudio(`scene=${scene.name}&room=shared`),
        ];
        for (const page of [one, two]) await page.untilExact();
        await one.page.bringToFront();
        await one.drag(120, 0);
        await one.untilExact();
        const revision = await one.revision();
        await two.until((relume, r) => relume.revision >= r && relume.exact, revision);
        const [a, b] = [await one.shown(), await two.shown()];
        assert.deepEqual(a.rgb, b.rgb);
        assert.deepEqual(a.pixels, b.pixels);
        assert.deepEqual(await one.state(), await two.state());
        assert.equal(await one.page.locator("#viewers").innerText(), "2");
    });

    it("says what is wrong with an upload, and lives on", async () => {
        const page = await openStudio(`scene=${scene.name}&room=upload`);
        await page.untilExact();
        const environment = (await page.state()).environment.name;
        const truncated = Buffer.from(
            "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 64 +X 128\n\x02\x02",
        );
        for (const [name, buffer] of [
            ["noise.hdr", Buffer.from("this is no picture")],
            ["truncated.hdr", truncated],
            ["empty.exr", Buffer.alloc(0)],
        ]) {
            await page.page.setInputFiles("#upload-input", {
                name,
                mimeType: "application/octet-stream",
                buffer,
            });
            await page.notice().filter({ hasText: name }).waitFor();
            assert.match(await page.notice().innerText(), /not an image.*found.*expected/is);
        }
        await page.page.screenshot({ path: output("upload-refused.png") });
        assert.equal((await page.state()).environment.name, environment);
        await page.drag(90, 0);
        await page.untilExact();

        await page.page.setInputFiles("#upload-input", {
            name: "My light (1).hdr",
            mimeType: "application/octet-stream",
            buffer: radianceFile(64, 32),
        });
        await page.until((relume) => relume.state.environment.name === "My-light-1");
        await page.untilExact();
        await page.page
            .locator('.environment[aria-pressed="true"]', { hasText: "My-light-1" })
            .waitFor();
    });

    it("saves the settled image as it shows", async () => {
        const page = await openStudio(`scene=${scene.name}&room=save`);
        await page.untilExact();
        const [download] = await Promise.all([
            page.page.waitForEvent("download"),
            page.page.keyboard.press("s"),
        ]);
        await download.saveAs(output("saved.png"));
        const address = `data:image/png;base64,${await readBase64(output("saved.png"))}`;
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

    it("does not come back to a scene that is not there", async () => {
        const page = await openStudio("scene=no-such-scene&room=nowhere");
        await page.until((relume) => relume.status === "refused");
        assert.match(await page.page.locator("#status-words").innerText(), /scene is unknown/);
    });

    it("comes back by itself after the server was killed and started again", async () => {
        const page = await openStudio(`scene=${scene.name}&room=restart`);
        await page.untilExact();
        await page.drag(100, 0);
        await page.untilExact();
        const before = await page.state();
        const image = await page.shown();
        await server.stop();
        await page.until((relume) => relume.status === "waiting");
        assert.equal(await page.markWords(), "Offline");
        await page.page.screenshot({ path: output("offline.png") });
        await server.start();
        await page.until((relume) => relume.status === "open");
        await page.untilExact();
        // A new server knows nothing of the room: the page takes its word, and offers its own.
        assert.notDeepEqual((await page.state()).rotation, before.rotation);
        await page.page.getByRole("button", { name: "Bring back the light" }).click();
        await page.untilExact();
        assert.deepEqual(await page.state(), before);
        const error = relativeL2((await page.shown()).rgb, image.rgb);
        assert.ok(error <= 1e-5, `the image is ${error} off what it was`);
    });
});

/** A Radiance file of uncoded pixels: a bright disc in a grey surround. */
function radianceFile(width, height) {
    const header = `#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`;
    const pixels = Buffer.alloc(width * height * 4);
    for (let y = 0; y < height; ++y) {
        for (let x = 0; x < width; ++x) {
            const inDisc = Math.hypot(x - width / 2, y - height / 3) < 3;
            pixels.set(
                inDisc ? [200, 180, 150, 134] : [128, 130, 140, 126],
                (y * width + x) * 4,
            );
        }
    }
    return Buffer.concat([Buffer.from(header, "latin1"), pixels]);
}

async function readBase64(path) {
    return (await readFile(path)).toString("base64");
}
