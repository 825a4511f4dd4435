/** Radiance files as people bring them. */

/** A Radiance file of uncoded pixels: a bright disc in a grey surround. */
export function radianceFile(width, height, grey = 130) {
    const header = `#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${height} +X ${width}\n`;
    const pixels = Buffer.alloc(width * height * 4);
    for (let y = 0; y < height; ++y) {
        for (let x = 0; x < width; ++x) {
            const inDisc = Math.hypot(x - width / 2, y - height / 3) < 3;
            pixels.set(
                inDisc ? [200, 180, 150, 134] : [128, grey, 140, 126],
                (y * width + x) * 4,
            );
        }
    }
    return Buffer.concat([Buffer.from(header, "latin1"), pixels]);
}
