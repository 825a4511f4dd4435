/** What the tests of one file share: a server of its own, a browser, pages that close. */
import assert from "node:assert/strict";
import { writeFile } from "node:fs/promises";
import { join } from "node:path";
import { after, afterEach, before } from "node:test";
import { Server, setting } from "./programs.mjs";
import { launchBrowser, StudioPage } from "./studio_page.mjs";

export const output = (name) => join(setting("STUDIO_OUTPUT"), name);

export class Suite {
    server;
    /** Name of the server's first scene. */
    scene;
    #browser;
    #open = [];

    /** Registers the hooks of the `describe` it is made in. */
    constructor(name) {
        before(async () => {
            this.server = await Server.onFreePort();
            await this.server.start();
            this.#browser = await launchBrowser();
            const { scenes } = await this.server.json("/api/scenes");
            this.scene = scenes[0].name;
        });
        after(async () => {
            await this.#browser?.close();
            await this.server?.stop("SIGTERM");
            await writeFile(output(`${name}-server.log`), this.server?.log ?? "");
        });
        afterEach(async () => {
            for (const page of this.#open.splice(0)) {
                assert.deepEqual(page.errors, [], "no script of the page failed");
                await page.close();
            }
        });
    }

    async open(query, viewport, { origin } = this.server) {
        const address = `${origin}/?${query}`;
        const page = await StudioPage.open(this.#browser, address, viewport);
        this.#open.push(page);
        return page;
    }

    /** A page of the first scene in that room, exact. */
    async room(room, viewport) {
        const page = await this.open(`scene=${this.scene}&room=${room}`, viewport);
        await page.untilExact();
        return page;
    }
}
