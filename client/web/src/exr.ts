/**
 * The settled image as an OpenEXR file: scanlines of half floats, bit for bit those that the
 * server sent, ZIP compressed [OpenEXR file layout]. Linear Rec. 709; with alpha premultiplied,
 * as OpenEXR means it.
 */
import type { SettledImage } from "./image_view";

const kMagic = 20000630;
const kVersion = 2;
const kHalf = 1;
const kZip = 3;
const kRowsPerChunk = 16;

class Bytes {
    private readonly parts: Uint8Array<ArrayBuffer>[] = [];
    length = 0;

    add(bytes: Uint8Array<ArrayBuffer>): this {
        this.parts.push(bytes);
        this.length += bytes.length;
        return this;
    }

    integer(value: number): this {
        const bytes = new Uint8Array(4);
        new DataView(bytes.buffer).setInt32(0, value, true);
        return this.add(bytes);
    }

    float(value: number): this {
        const bytes = new Uint8Array(4);
        new DataView(bytes.buffer).setFloat32(0, value, true);
        return this.add(bytes);
    }

    offset(value: number): this {
        const bytes = new Uint8Array(8);
        new DataView(bytes.buffer).setBigUint64(0, BigInt(value), true);
        return this.add(bytes);
    }

    byte(value: number): this {
        return this.add(Uint8Array.of(value));
    }

    text(text: string): this {
        return this.add(new TextEncoder().encode(text));
    }

    /** Ended by a zero byte. */
    name(text: string): this {
        return this.text(text).byte(0);
    }

    attribute(name: string, type: string, value: Bytes): this {
        return this.name(name).name(type).integer(value.length).append(value);
    }

    append(other: Bytes): this {
        for (const part of other.parts) this.add(part);
        return this;
    }

    joined(): Uint8Array<ArrayBuffer> {
        const all = new Uint8Array(this.length);
        let at = 0;
        for (const part of this.parts) {
            all.set(part, at);
            at += part.length;
        }
        return all;
    }
}

/** Channels in the order of the file, by name, and where each lies in R G B A. */
function channelsOf(hasAlpha: boolean): { name: string; index: number }[] {
    const colours = [
        { name: "B", index: 2 },
        { name: "G", index: 1 },
        { name: "R", index: 0 },
    ];
    return hasAlpha ? [{ name: "A", index: 3 }, ...colours] : colours;
}

function headerOf(image: SettledImage, comments: string): Bytes {
    const { width, height, hasAlpha } = image.header;
    const channels = new Bytes();
    for (const { name } of channelsOf(hasAlpha)) {
        channels.name(name).integer(kHalf).integer(0).integer(1).integer(1);
    }
    channels.byte(0);
    const window = (): Bytes =>
        new Bytes()
            .integer(0)
            .integer(0)
            .integer(width - 1)
            .integer(height - 1);
    return new Bytes()
        .integer(kMagic)
        .integer(kVersion)
        .attribute("channels", "chlist", channels)
        .attribute("comments", "string", new Bytes().text(comments))
        .attribute("compression", "compression", new Bytes().byte(kZip))
        .attribute("dataWindow", "box2i", window())
        .attribute("displayWindow", "box2i", window())
        .attribute("lineOrder", "lineOrder", new Bytes().byte(0))
        .attribute("pixelAspectRatio", "float", new Bytes().float(1))
        .attribute("screenWindowCenter", "v2f", new Bytes().float(0).float(0))
        .attribute("screenWindowWidth", "float", new Bytes().float(1))
        .byte(0);
}

/** Rows `first` to `end` as the file has them: row by row, channel by channel. */
function rowsOf(image: SettledImage, first: number, end: number): Uint8Array<ArrayBuffer> {
    const { width, hasAlpha } = image.header;
    const channels = channelsOf(hasAlpha);
    const bytes = new Uint8Array((end - first) * width * channels.length * 2);
    let at = 0;
    for (let y = first; y < end; ++y) {
        for (const { index } of channels) {
            for (let x = 0; x < width; ++x) {
                const bits = image.rgba[(y * width + x) * 4 + index]!;
                bytes[at++] = bits & 0xff;
                bytes[at++] = bits >> 8;
            }
        }
    }
    return bytes;
}

/** Even bytes, then odd ones, each as its difference to the one before. */
function predicted(bytes: Uint8Array<ArrayBuffer>): Uint8Array<ArrayBuffer> {
    const half = (bytes.length + 1) >> 1;
    const apart = new Uint8Array(bytes.length);
    for (let i = 0; i < bytes.length; ++i) {
        apart[(i & 1) * half + (i >> 1)] = bytes[i]!;
    }
    for (let i = apart.length - 1; i > 0; --i) apart[i] = apart[i]! - apart[i - 1]! + 128;
    return apart;
}

async function compressed(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
    // "deflate" is the zlib format [RFC 1950], which is what OpenEXR wants.
    const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** `comments` is put into the file's header. */
export async function exrFromSettled(image: SettledImage, comments: string): Promise<Blob> {
    const { height } = image.header;
    const header = headerOf(image, comments);
    const chunks: { row: number; data: Uint8Array<ArrayBuffer> }[] = [];
    for (let row = 0; row < height; row += kRowsPerChunk) {
        const raw = rowsOf(image, row, Math.min(height, row + kRowsPerChunk));
        const packed = await compressed(predicted(raw));
        // A chunk that does not shrink is stored as it is; readers know it by its size.
        chunks.push({ row, data: packed.length < raw.length ? packed : raw });
    }
    const file = new Bytes().append(header);
    let offset = header.length + 8 * chunks.length;
    for (const { data } of chunks) {
        file.offset(offset);
        offset += 8 + data.length;
    }
    for (const { row, data } of chunks) file.integer(row).integer(data.length).add(data);
    return new Blob([file.joined()], { type: "image/x-exr" });
}
