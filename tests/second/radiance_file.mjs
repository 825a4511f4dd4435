// Radiance HDR files with the axes -Y H +X W, as light.md §1 reads them.

/** {width, height, texels}: interleaved linear radiance from the top left. */
export function mapFromRadiance(bytes) {
    const end = bytes.indexOf("\n\n");
    const header = bytes.toString("latin1", 0, end);
    if (!header.startsWith("#?") || !header.includes("FORMAT=32-bit_rle_rgbe")) {
        throw new Error("no Radiance file of RGBE texels");
    }
    const line = bytes.indexOf("\n", end + 2);
    const [, height, width] = /^-Y (\d+) \+X (\d+)$/
        .exec(bytes.toString("latin1", end + 2, line))
        .map(Number);
    const map = { width, height, texels: new Float32Array(3 * width * height) };
    let at = line + 1;
    for (let y = 0; y < height; ++y) {
        const row = new Uint8Array(4 * width);
        const hasRuns = width >= 8 && bytes[at] === 2 && bytes[at + 1] === 2 && bytes[at + 2] < 128;
        at = hasRuns ? readRuns(bytes, at + 4, row, width) : readFlat(bytes, at, row, width);
        for (let x = 0; x < width; ++x) {
            const exponent = row[3 * width + x];
            const step = exponent === 0 ? 0 : 2 ** (exponent - 136);
            for (let c = 0; c < 3; ++c) {
                map.texels[3 * (y * width + x) + c] = row[c * width + x] * step;
            }
        }
    }
    return map;
}

function readFlat(bytes, at, row, width) {
    for (let i = 0; i < 4 * width; ++i) row[(i % 4) * width + (i >> 2)] = bytes[at + i];
    return at + 4 * width;
}

function readRuns(bytes, at, row, width) {
    for (let channel = 0; channel < 4; ++channel) {
        for (let x = 0; x < width; ) {
            const count = bytes[at++];
            const isRun = count > 128;
            for (let i = 0; i < (isRun ? count - 128 : count); ++i) {
                row[channel * width + x++] = isRun ? bytes[at] : bytes[at + i];
            }
            at += isRun ? 1 : count;
        }
    }
    return at;
}
