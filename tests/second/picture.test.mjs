// The server's exact image against the second implementation's own: bakes, serves, uploads, edits.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { setTimeout as sleep } from "node:timers/promises";
import { pictureOf, prepared } from "./picture.mjs";
import { mapFromRadiance } from "./radiance_file.mjs";
import { lamps, sunnySky } from "./radiance_writer.mjs";
import { levelsOf } from "./source_map.mjs";
import { readTransport } from "./transport.mjs";
import { RoomConnection, halfPlanes, http } from "./wire.mjs";

const { RELUME_BAKE, RELUME_SERVER } = process.env;
const TOKEN = "a token, with §?>";
const BASES = { haar: ["--basis", "haar"], sh: ["--basis", "sh", "--order", "6"] };
const N = 8;
const maps = { sunny: sunnySky, lamps };
const ofMaps = Object.fromEntries(
    Object.entries(maps).map(([name, file]) => [
        name, prepared(levelsOf(mapFromRadiance(file)), N),
    ]),
);

let folder;
let server;
let address;

before(async () => {
    folder = mkdtempSync(join(tmpdir(), "relume-second-"));
    mkdirSync(join(folder, "scenes"));
    for (const [name, basis] of Object.entries(BASES)) {
        const baked = spawnSync(RELUME_BAKE, [
            "--builtin", "box", "--size", "40x24", "--light-resolution", `${N}`, "--bounces", "1",
            "--samples", "4", ...basis, "-o", join(folder, "scenes", `${name}.relume`),
        ], { encoding: "utf8" });
        assert.equal(baked.status, 0, baked.stderr);
    }
    const portFile = join(folder, "port");
    server = spawn(RELUME_SERVER, [
        "--scenes", join(folder, "scenes"), "--listen", "127.0.0.1:0", "--port-file", portFile,
        "--token", TOKEN,
    ], { stdio: "ignore" });
    while (!existsSync(portFile) || readFileSync(portFile, "utf8").trim() === "") await sleep(20);
    address = `http://127.0.0.1:${readFileSync(portFile, "utf8").trim()}`;
    while ((await http(address, "GET", "/readyz")).status !== 200) await sleep(20);
    for (const [name, file] of Object.entries(maps)) {
        const token = encodeURIComponent(TOKEN);
        const path = `/api/environments?name=${name}&token=${token}`;
        const answer = await http(address, "POST", path, file);
        assert.equal(answer.status, 201, answer.body);
        assert.deepEqual(JSON.parse(answer.body).warnings, []);
    }
});

after(() => {
    server?.kill("SIGTERM");
    rmSync(folder, { recursive: true, force: true });
});

/** ‖a − b‖ / ‖b‖. */
function relativeL2(a, b) {
    let [difference, norm] = [0, 0];
    for (let i = 0; i < b.length; ++i) {
        difference += (a[i] - b[i]) ** 2;
        norm += b[i] ** 2;
    }
    return Math.sqrt(difference / norm);
}

const interleaved = (planes, pixels) =>
    Float64Array.from(
        { length: 3 * pixels }, (_, i) => planes[(i % 3) * pixels + Math.floor(i / 3)]);

const light = { direction: [0.4, 0.8, 0.6], angular_radius_degrees: 9, radiance: [30, 20, 10] };
const STATES = {
    "a turned map": {
        environment: { name: "sunny" },
        rotation: { yaw_degrees: 70, pitch_degrees: 20, roll_degrees: -35 },
    },
    "a blend under gain and tint over a colour": {
        environment: { name: "sunny", gain: 1.7, tint: [1, 0.6, 0.2] },
        blend: { name: "lamps", amount: 0.7 },
        rotation: { yaw_degrees: -15 },
        background: { mode: "colour", colour: [0.2, 0.4, 0.9] },
    },
    "lights before the map, one of them muted, one below a texel": {
        environment: { name: "lamps", gain: 0.3 },
        blend: { name: null },
        background: { mode: "environment" },
        lights: {
            key: { ...light, gain: 2, tint: [1, 0.5, 0.25] },
            point: {
                ...light,
                direction: [-1, 0.5, 0.2],
                angular_radius_degrees: 0.3,
                radiance: [5e3, 5e3, 9e3],
            },
            off: { ...light, direction: [0, 1, 0], muted: true },
            // The camera looks towards it, so that the background shows it.
            seen: { ...light, direction: [0.1, 0.3, -1], angular_radius_degrees: 25 },
        },
    },
    "one light alone over nothing": {
        lights: { key: { solo: true } },
        background: { mode: "transparent" },
    },
};

for (const name of Object.keys(BASES)) {
    test(`${name}: the server's exact image is the page's`, async () => {
        const transport = readTransport(join(folder, "scenes", `${name}.relume`));
        const { width, height } = transport.manifest.image;
        const connection = await RoomConnection.open(
            address, `/session/${name}?scene=${name}&images=settled`, TOKEN);
        connection.start();
        let id = 0;
        for (const [what, patch] of Object.entries(STATES)) {
            const { header, payload } = await connection.exactImage(patch, ++id);
            const planes = halfPlanes(payload, width, height, header.has_alpha);
            const state = connection.state;
            const { rgb, alpha } = pictureOf(transport, state, {
                environment: ofMaps[state.environment.name],
                blend: ofMaps[state.blend.name],
            });
            const error = relativeL2(interleaved(planes, width * height), rgb);
            assert.ok(error <= 3e-4, `${what}: relative L2 ${error}`);
            assert.equal(header.has_alpha, state.background.mode === "transparent");
            if (header.has_alpha) {
                const found = planes.subarray(3 * width * height);
                assert.ok(relativeL2(found, alpha) <= 3e-4, `${what}: coverage`);
            }
        }
        connection.close();
    });
}
