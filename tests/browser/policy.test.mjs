/** The page under the server's content security policy, which the other tests set aside. */
import assert from "node:assert/strict";
import { after, before, describe, it } from "node:test";
import { setTimeout as wait } from "node:timers/promises";
import { Server } from "./programs.mjs";
import { launchBrowser } from "./studio_page.mjs";

describe("policy", { timeout: 120_000 }, () => {
    const server = { it: undefined };
    let browser;

    before(async () => {
        server.it = await Server.onFreePort();
        await server.it.start();
        browser = await launchBrowser();
    });
    after(async () => {
        await browser?.close();
        await server.it?.stop("SIGTERM");
    });

    it("needs nothing that the policy forbids", async () => {
        const page = await browser.newPage();
        await page.addInitScript(() => {
            window.violations = [];
            document.addEventListener("securitypolicyviolation", (event) =>
                window.violations.push(`${event.violatedDirective} ${event.blockedURI}`),
            );
        });
        const { scenes } = await server.it.json("/api/scenes");
        const answer = await page.goto(
            `${server.it.origin}/?scene=${scenes[0].name}&room=policy`,
        );
        assert.match(answer.headers()["content-security-policy"], /frame-ancestors 'none'/);
        assert.equal(answer.headers()["x-content-type-options"], "nosniff");
        const until = async (what) => {
            while (!(await page.evaluate(what))) await wait(100);
        };
        // Thumbnails, previews, the settled image's worker: all that a page loads by itself.
        await until(() => window.relume?.exact === true && window.relume.settled() !== null);
        await page.locator(".image-canvas").hover();
        await page.mouse.down();
        await page.mouse.move(500, 300, { steps: 5 });
        await page.mouse.up();
        await until(() => window.relume.revision > 0 && window.relume.exact);
        assert.deepEqual(await page.evaluate(() => window.violations), []);
    });
});
