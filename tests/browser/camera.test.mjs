/** Moving the camera of a scene whose surface was baked. */
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import { Suite } from "./suite.mjs";

const distance = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));
const arm = ({ eye, look_at }) => distance(eye, look_at);

describe("camera", { timeout: 180_000 }, () => {
    const suite = new Suite("camera");
    const walk = async (room) => {
        const page = await suite.open(`scene=walk&room=${room}`);
        await page.untilExact();
        return page;
    };
    const camera = (page) => page.until((relume) => relume.state.camera);
    const isElsewhere = (page, eye) =>
        page.until(
            (relume, from) => {
                const { camera } = relume.state;
                return Math.hypot(...camera.eye.map((x, i) => x - from[i])) > 1e-3 && camera;
            },
            eye,
        );

    it("orbits by a drag, around what it looks at, and the image stays exact", async () => {
        const page = await walk("orbit");
        const before = await camera(page);
        const shown = await page.shown();
        await page.drag(120, 20);
        const after = await isElsewhere(page, before.eye);
        assert.ok(Math.abs(arm(after) - arm(before)) < 1e-3 * arm(before), "as far as before");
        assert.deepEqual(after.look_at, before.look_at);
        await page.untilExact();
        const turned = await page.shown();
        assert.ok(
            turned.rgb.some((value, i) => Math.abs(value - shown.rgb[i]) > 0.01),
            "another picture",
        );
    });

    it("pans with Shift and dollies by the wheel", async () => {
        const page = await walk("pan");
        const before = await camera(page);
        await page.drag(40, 0, { shift: true });
        const panned = await isElsewhere(page, before.eye);
        assert.ok(distance(panned.look_at, before.look_at) > 1e-3, "what it looks at moves too");
        assert.ok(Math.abs(arm(panned) - arm(before)) < 1e-3 * arm(before));
        await page.page.mouse.wheel(0, -240);
        const nearer = await isElsewhere(page, panned.eye);
        assert.ok(arm(nearer) < arm(panned), "nearer");
    });

    it("has views, frames all and returns to the camera of the file", async () => {
        const page = await walk("views");
        const file = await camera(page);
        const press = (name) =>
            page.page.locator("#camera-views button", { hasText: name }).click();
        await press("Top");
        const top = await isElsewhere(page, file.eye);
        assert.ok(top.eye[1] > top.look_at[1], "from above");
        await press("Frame all");
        await page.untilExact();
        await press("File");
        await page.until(
            (relume, eye) => Math.hypot(...relume.state.camera.eye.map((x, i) => x - eye[i])) < 1e-4,
            file.eye,
        );
    });

    it("offers none of it where receivers are the pixels of one camera", async () => {
        const page = await suite.room("still");
        assert.ok(await page.page.locator("#camera-card").isHidden());
        const before = await camera(page);
        const turned = await page.until((relume) => relume.state.rotation.quaternion);
        await page.drag(60, 0, { shift: true });
        await page.until(
            (relume, from) => relume.state.rotation.quaternion.some((x, i) => x !== from[i]),
            turned,
        );
        assert.deepEqual(await camera(page), before);
    });
});
