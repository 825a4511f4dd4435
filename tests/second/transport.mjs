// The transport directory (protocol/README.md §2): read from the page alone.
import { readFileSync } from "node:fs";
import { join } from "node:path";

export const TILE = 16;
const SLOTS = TILE * TILE;
const COLOURS = 3;

function require(condition, message) {
    if (!condition) throw new Error(message);
}

/** The manifest, its first line apart from what its checksum covers. */
function readManifest(directory) {
    const text = readFileSync(join(directory, "manifest.json"), "utf8");
    const line = text.indexOf("\n");
    require(/^\{"xxh3":"[0-9a-f]{16}",$/.test(text.slice(0, line)), "manifest: first line");
    const manifest = JSON.parse(text);
    require(manifest.format === "relume-transport", "manifest: format");
    require(manifest.version === 2, "manifest: version");
    require(manifest.kind === "image", "manifest: kind");
    return manifest;
}

const floats = (bytes, offset, count) =>
    Float32Array.from({ length: count }, (_, i) => bytes.readFloatLE(offset + 4 * i));

/** Adds 256^power times the values of a strips8 cell; returns the offset after it. */
function addStrips(bytes, at, values, factor) {
    const count = bytes[at++];
    require(count >= 1 && count <= 32, `strips8: ${count} strips`);
    const strips = [];
    for (let i = 0; i < count; ++i) {
        strips.push([bytes[at], bytes[at + 1]]);
        at += 2;
    }
    for (const [i, [strip, occupancy]] of strips.entries()) {
        require(strip < 32 && occupancy !== 0, "strips8: strip or occupancy");
        require(i === 0 || strips[i - 1][0] < strip, "strips8: not ascending");
        for (let bit = 0; bit < 8; ++bit) {
            if (occupancy & (1 << bit)) values[8 * strip + bit] += factor * bytes.readInt8(at++);
        }
    }
    return at;
}

function addDense8(bytes, at, values) {
    for (let i = 0; i < SLOTS; ++i) values[i] += bytes.readInt8(at + i);
    return at + SLOTS;
}

/** Adds the values of one cell to 256 zeroes; returns the offset after it. */
export function readCell(tag, bytes, at, values) {
    switch (tag) {
        case 0:
            return at;
        case 1:
            return addDense8(bytes, at, values);
        case 2:
            return addStrips(bytes, at, values, 1);
        case 3:
            for (let i = 0; i < SLOTS; ++i) values[i] = bytes.readInt16LE(at + 2 * i);
            return at + 2 * SLOTS;
        case 4:
            for (let i = 0; i < SLOTS; ++i) values[i] = bytes.readFloatLE(at + 4 * i);
            return at + 4 * SLOTS;
        case 5:
            return addDense8(bytes, addStrips(bytes, at, values, 256), values);
        case 6:
            return addStrips(bytes, addStrips(bytes, at, values, 256), values, 1);
        case 7:
        case 8: {
            const low = addStrips(bytes, addStrips(bytes, at, values, 65536), values, 256);
            return tag === 7 ? addDense8(bytes, low, values) : addStrips(bytes, low, values, 1);
        }
        default:
            throw new Error(`cell: tag ${tag}`);
    }
}

function readShard(directory, entry, manifest, columns) {
    const bytes = readFileSync(join(directory, entry.file));
    const channels = manifest.colour.channels;
    require(bytes.length === entry.bytes, `${entry.file}: length`);
    require(bytes.toString("latin1", 0, 8) === "RELUMESH", `${entry.file}: magic`);
    require(bytes.readUInt32LE(8) === 2, `${entry.file}: version`);
    const shard = {
        bytes,
        firstBlock: bytes.readUInt32LE(16),
        blockCount: bytes.readUInt32LE(20),
        index: [],
        data: 0,
    };
    require(bytes.readUInt32LE(24) === columns, `${entry.file}: columns`);
    require(bytes.readUInt32LE(28) === channels, `${entry.file}: channels`);
    const segments = columns * channels;
    require(Number(bytes.readBigUInt64LE(32)) === 4 * (segments + 1), `${entry.file}: index`);
    for (let i = 0; i <= segments; ++i) shard.index.push(bytes.readUInt32LE(128 + 4 * i));
    shard.data = Math.ceil((128 + 4 * (segments + 1)) / 64) * 64;
    const end = shard.data + Number(bytes.readBigUInt64LE(48));
    require(end + 64 === bytes.length, `${entry.file}: data`);
    return shard;
}

/** Calls take(block, j, k, values) for every cell that is not empty. */
export function forEachCell(transport, take) {
    const { channels } = transport.manifest.colour;
    for (const shard of transport.shards) {
        for (let segment = 0; segment < transport.columns * channels; ++segment) {
            const begin = shard.data + shard.index[segment];
            const end = shard.data + shard.index[segment + 1];
            if (begin === end) continue;
            let at = begin + Math.ceil(shard.blockCount / 2);
            for (let block = 0; block < shard.blockCount; ++block) {
                const tag = (shard.bytes[begin + (block >> 1)] >> (4 * (block & 1))) & 15;
                if (tag === 0) continue;
                const values = new Float64Array(SLOTS);
                at = readCell(tag, shard.bytes, at, values);
                const [j, k] = [Math.floor(segment / channels), segment % channels];
                take(shard.firstBlock + block, j, k, values);
            }
            require(at === end, "a segment does not end with its last cell");
        }
    }
}

export function readTransport(directory) {
    const manifest = readManifest(directory);
    const { basis, blocks, colour, files, image } = manifest;
    const n = basis.face_resolution;
    const columns = basis.name === "haar" ? 6 * n * n : basis.order ** 2;
    require(blocks === Math.ceil(image.width / TILE) * Math.ceil(image.height / TILE), "blocks");
    const columnTable = readFileSync(join(directory, files.columns.file));
    require(columnTable.length === columns * (4 * colour.channels + 16), "columns.bin");
    const receivers = readFileSync(join(directory, files.receivers.file));
    require(receivers.length === 4 * blocks * SLOTS * (1 + COLOURS), "receivers.bin");
    return {
        manifest,
        columns,
        steps: floats(columnTable, 0, columns * colour.channels),
        coverage: floats(receivers, 0, blocks * SLOTS),
        tint: floats(receivers, 4 * blocks * SLOTS, blocks * SLOTS * COLOURS),
        shards: manifest.shards.map((entry) => readShard(directory, entry, manifest, columns)),
    };
}

/** Z-order: bit i of the column is bit 2i, bit i of the row bit 2i + 1. */
function zOrder(column, row) {
    let z = 0;
    for (let bit = 0; bit < 4; ++bit) {
        z |= ((column >> bit) & 1) << (2 * bit);
        z |= ((row >> bit) & 1) << (2 * bit + 1);
    }
    return z;
}

/** H⁻¹: from a block's coefficients to its 16×16 receivers. */
export function receiversFromCoefficients(q) {
    const receivers = new Float64Array(SLOTS);
    for (let y = 0; y < TILE; ++y) {
        for (let x = 0; x < TILE; ++x) {
            let value = q[0] / TILE;
            for (let level = 0; level < 4; ++level) {
                const support = TILE >> level;
                const z = zOrder(Math.floor(x / support), Math.floor(y / support));
                const along = x % support < support / 2 ? 1 : -1;
                const down = y % support < support / 2 ? 1 : -1;
                const slot = 4 ** level + 3 * z;
                value += (along * q[slot] + down * q[slot + 1] + along * down * q[slot + 2]) /
                    support;
            }
            receivers[y * TILE + x] = value;
        }
    }
    return receivers;
}

/** Where pixel (x, y) lies: index of its block and slot together. */
export function receiverOf(image, x, y) {
    const tilesX = Math.ceil(image.width / TILE);
    const block = Math.floor(y / TILE) * tilesX + Math.floor(x / TILE);
    return { block, slot: (y % TILE) * TILE + (x % TILE) };
}

/**
 * B = T·L: interleaved, row by row, what the surfaces send to the camera. `lighting` is one array
 * of coefficients for each colour.
 */
export function relit(transport, lighting) {
    const { blocks, colour, image } = transport.manifest;
    const sums = Array.from({ length: blocks * COLOURS }, () => new Float64Array(SLOTS));
    forEachCell(transport, (block, j, k, values) => {
        const step = transport.steps[j * colour.channels + k];
        for (let c = 0; c < COLOURS; ++c) {
            const weight = colour.matrix[c][k] * step * lighting[c][j];
            if (weight === 0) continue;
            const sum = sums[block * COLOURS + c];
            for (let slot = 0; slot < SLOTS; ++slot) sum[slot] += weight * values[slot];
        }
    });
    const receivers = sums.map(receiversFromCoefficients);
    const rgb = new Float64Array(image.width * image.height * COLOURS);
    for (let y = 0; y < image.height; ++y) {
        for (let x = 0; x < image.width; ++x) {
            const { block, slot } = receiverOf(image, x, y);
            for (let c = 0; c < COLOURS; ++c) {
                const place = block * COLOURS + c;
                rgb[(y * image.width + x) * COLOURS + c] =
                    transport.tint[place * SLOTS + slot] * receivers[place][slot];
            }
        }
    }
    return rgb;
}
