/** What a person does with the studio page, done by a browser; see README.md. */
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { largestCodeDistance, readExr, relativeL2 } from "./images.mjs";
import { radianceFile } from "./maps.mjs";
import { relume, Server } from "./programs.mjs";
import { output, Suite } from "./suite.mjs";

describe("studio page", { timeout: 240_000 }, () => {
    const suite = new Suite("studio");
    const openStudio = (query) => suite.open(query);

    /** Renders the same state by the command line and holds the page's image against it. */
    async function compareWithClient(test, page, room, fileName) {
        const file = output(fileName);
        await relume(
            "render",
            "--server",
            suite.server.origin,
            "--scene",
            suite.scene,
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
        const page = await openStudio(`scene=${suite.scene}&room=drag`);
        await page.untilExact();
        const before = (await page.state()).rotation.quaternion;
        const first = await page.shown();
        await page.drag(180, 0);
        await page.drag(60, 40, { shift: true });
        assert.notDeepEqual((await page.state()).rotation.quaternion, before);
        await page.page.screenshot({ path: output("moving.png") });
        await page.untilExact();
        await page.saysMark("Exact");
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
                `scene=${suite.scene}&room=display-${painter}&painter=${painter}`,
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
            // It is this viewer's own until he makes it the room's.
            const mine = { exposure_stops: -1, tone: "linear" };
            assert.deepEqual((await page.state()).display, {
                exposure_stops: 0,
                tone: "filmic",
            });
            assert.deepEqual(await page.display(), mine);
            await page.button("Make it the room's default").click();
            await page.until((relume) => relume.state.display.exposure_stops === -1);
            await page.untilExact();
            assert.deepEqual((await page.state()).display, mine);
        }
    });

    it("adds, moves, resizes and removes an area light", async () => {
        const page = await openStudio(`scene=${suite.scene}&room=lights`);
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
            await openStudio(`scene=${suite.scene}&room=shared`),
            await openStudio(`scene=${suite.scene}&room=shared`),
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
        await one.says(one.page.locator("#viewers"), "2");
    });

    it("says what is wrong with an upload, and lives on", async () => {
        const page = await openStudio(`scene=${suite.scene}&room=upload`);
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
            await page.says(page.notice(), /not an image.*found.*expected/is);
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

    it("joins by a token that stands in no request's address", async () => {
        const token = "geheim/ü+?";
        const guarded = await Server.onFreePort();
        await guarded.start("--token", token);
        try {
            const query = `scene=${suite.scene}&room=token`;
            const stranger = await suite.open(query, undefined, guarded);
            await stranger.until((relume) => relume.status === "refused");
            const hash = `#token=${encodeURIComponent(token)}`;
            const page = await suite.open("", undefined, guarded);
            const addresses = [];
            page.page.on("request", (request) => addresses.push(request.url()));
            page.page.on("websocket", (socket) => addresses.push(socket.url()));
            await page.page.goto(`${guarded.origin}/?${query}${hash}`);
            await page.page.reload();
            await page.untilExact();
            await page.bring("mine.hdr", radianceFile(64, 32));
            await page.until((relume) => relume.state.environment.name === "mine");
            assert.ok(addresses.some((address) => address.startsWith("ws:")));
            const wire = addresses.map((address) => decodeURIComponent(address.split("#")[0]));
            assert.deepEqual(
                wire.filter((address) => address.includes("geheim")),
                [],
            );
        } finally {
            await guarded.stop("SIGTERM");
        }
    });

    it("comes back by itself after the server was killed and started again", async () => {
        const page = await openStudio(`scene=${suite.scene}&room=restart`);
        await page.untilExact();
        await page.drag(100, 0);
        await page.untilExact();
        const before = await page.state();
        const image = await page.shown();
        await suite.server.stop();
        await page.until((relume) => relume.status === "waiting");
        await page.saysMark("Offline");
        await page.page.screenshot({ path: output("offline.png") });
        await suite.server.start();
        await page.until((relume) => relume.status === "open");
        await page.untilExact();
        // A new server knows nothing of the room: the page takes its word, and offers its own.
        assert.notDeepEqual((await page.state()).rotation, before.rotation);
        await page.button("Bring back the light").click();
        await page.page.locator(".notice", { hasText: "back as it was" }).waitFor();
        await page.untilExact();
        assert.deepEqual(await page.state(), before);
        const error = relativeL2((await page.shown()).rgb, image.rgb);
        assert.ok(error <= 1e-5, `the image is ${error} off what it was`);
    });
});
