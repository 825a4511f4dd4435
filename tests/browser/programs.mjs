/** The programs under test: relume-server as a child process, relume run to its end. */
import { execFile, spawn } from "node:child_process";
import { once } from "node:events";
import { createServer } from "node:net";
import { setTimeout as delay } from "node:timers/promises";
import { promisify } from "node:util";

/** From the environment that `run` sets. */
export function setting(name) {
    const value = process.env[name];
    if (value === undefined || value === "") {
        throw new Error(`${name} is not set: start this test by tests/browser/run`);
    }
    return value;
}

async function freePort() {
    const probe = createServer().listen(0, "127.0.0.1");
    await once(probe, "listening");
    const { port } = probe.address();
    probe.close();
    await once(probe, "close");
    return port;
}

export class Server {
    #child = null;
    #log = "";

    constructor(port) {
        this.port = port;
        this.origin = `http://127.0.0.1:${port}`;
    }

    static async onFreePort() {
        return new Server(await freePort());
    }

    get log() {
        return this.#log;
    }

    /** Resolves once the server says that it is ready. */
    async start(...options) {
        const child = spawn(
            setting("STUDIO_SERVER"),
            [
                "--scenes",
                setting("STUDIO_SCENES"),
                "--materials",
                `${setting("STUDIO_SCENES")}/materials`,
                "--listen",
                `127.0.0.1:${this.port}`,
                "--web-root",
                setting("STUDIO_WEB_ROOT"),
                ...options,
            ],
            { stdio: ["ignore", "pipe", "pipe"] },
        );
        for (const stream of [child.stdout, child.stderr]) {
            stream.on("data", (text) => (this.#log += text));
        }
        this.#child = child;
        for (;;) {
            if (child.exitCode !== null) {
                throw new Error(`relume-server ended with ${child.exitCode}:\n${this.#log}`);
            }
            const ready = await fetch(`${this.origin}/readyz`).catch(() => null);
            if (ready?.ok === true) return;
            await delay(50);
        }
    }

    /** SIGKILL unless told otherwise: a crash, from the page's side. */
    async stop(signal = "SIGKILL") {
        const child = this.#child;
        if (child === null || child.exitCode !== null || child.signalCode !== null) return;
        const ended = once(child, "exit");
        child.kill(signal);
        await ended;
    }

    async json(path) {
        const response = await fetch(this.origin + path);
        return response.json();
    }
}

const run = promisify(execFile);

/** Runs `relume` with `args`; its output is in the error where it fails. */
export async function relume(...args) {
    try {
        return await run(setting("STUDIO_CLIENT"), args, { timeout: 120_000 });
    } catch (error) {
        throw new Error(`relume ${args.join(" ")}\n${error.stdout}${error.stderr}`, {
            cause: error,
        });
    }
}
