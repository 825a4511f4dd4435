/**
 * Takes client/web/pictures/studio.png, street.jpg and earrings.jpg anew: `tests/browser/run`
 * sets the same variables. Of a scene whose camera moves the picture is taken from elsewhere, of
 * one whose materials are edited some are, of another the lights are set up.
 * usage: STUDIO_SERVER=… STUDIO_SCENES=… STUDIO_WEB_ROOT=… CHROMIUM=… node take-picture.mjs FILE
 */
import { Server } from "./programs.mjs";
import { launchBrowser, StudioPage } from "./studio_page.mjs";

const [file] = process.argv.slice(2);
if (file === undefined) {
    console.error("usage: node take-picture.mjs FILE.png|FILE.jpg");
    process.exit(2);
}

const server = await Server.onFreePort();
const browser = await launchBrowser();
try {
    await server.start();
    const { scenes } = await server.json("/api/scenes");
    const studio = await StudioPage.open(
        browser,
        `${server.origin}/?scene=${scenes[0].name}&room=show`,
        { width: 1600, height: 1000 },
    );
    const { page } = studio;
    await studio.untilExact();
    const editsMaterials = await page.locator("#materials-card").isVisible();
    if (!editsMaterials) {
        await page.locator(".environment", { hasText: /^sunset$/ }).click();
        await studio.until((relume) => relume.state.environment.name === "sunset");
    }
    if (editsMaterials) {
        await page.locator('[data-material="cloth"]').click();
        await studio.type("diffuse colour", "#3a60ff");
        await studio.type("diffuse EV", "2");
        await page.locator('[data-material="post"]').click();
        await page.locator('[data-preset="gold"]').click();
        await page.locator('[data-material="pearl"]').click();
        await studio.type("roughness", "0.07");
        await page.locator('[data-axis="log"]').click();
    } else if (await page.locator("#camera-card").isVisible()) {
        await studio.drag(290, -55, { steps: 20 });
    } else {
        for (const light of ["key", "fill"]) {
            await page.keyboard.press("l");
            await studio.until((relume, id) => id in relume.state.lights, light);
        }
        await studio.light("key").locator(".light-row").dblclick();
        await page.locator(".light-rename").fill("Window");
        await page.keyboard.press("Enter");
        await studio.light("key").locator(".light-row").click();
        await studio.type("power EV", "-0.5");
        await studio.type("colour", "4500K");
        for (const across of [240, 180, -60]) await studio.drag(across, 0, { steps: 20 });
    }
    await studio.untilExact();
    await page.mouse.move(800, 990);
    await page.screenshot({ path: file });
} finally {
    await browser.close();
    await server.stop("SIGTERM");
}
