// Maps with high contrast for the tests, as flat Radiance files.

function rgbe(colour) {
    const largest = Math.max(...colour);
    if (largest < 1e-30) return [0, 0, 0, 0];
    const exponent = Math.floor(Math.log2(largest)) + 1;
    return [...colour.map((value) => Math.floor(value * 2 ** (8 - exponent))), exponent + 128];
}

/** `radiance(x, y)` for the middle of every texel, x and y in 0 … 1. */
export function radianceFile(width, height, radiance) {
    const texels = [];
    for (let y = 0; y < height; ++y) {
        for (let x = 0; x < width; ++x) {
            texels.push(...rgbe(radiance((x + 0.5) / width, (y + 0.5) / height)));
        }
    }
    const header = `#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`;
    return Buffer.concat([Buffer.from(header), Buffer.from(texels)]);
}

/** A sky over ground with a small bright sun. */
export const sunnySky = radianceFile(96, 48, (x, y) => {
    const isSun = Math.hypot((x - 0.3) * 2, y - 0.3) < 0.03;
    if (isSun) return [900, 700, 400];
    return y < 0.5 ? [0.3 + y, 0.5 + 0.5 * y, 1.2 - y] : [0.2, 0.15 * x + 0.05, 0.1];
});

/** Three lamps in the dark. */
export const lamps = radianceFile(40, 20, (x, y) => {
    const lamp = Math.floor(3 * x);
    const isLit = Math.abs(3 * x - lamp - 0.5) < 0.15 && Math.abs(y - 0.4) < 0.1;
    return [0, 1, 2].map((c) => 0.01 + (isLit ? (c === lamp ? 40 : 4) : 0));
});
