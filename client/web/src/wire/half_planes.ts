/**
 * The settled image: R, G, B and perhaps A planes of half floats, of each plane first all low
 * bytes, then all high bytes, all in order as one zstd frame [protocol/README.md §3.2].
 */
import { decompress } from "fzstd";
import { WireError } from "./message";

export const kHalfOne = 0x3c00;
const kZstdMagic = 0xfd2fb528;

/** Bytes of the planes once decompressed. */
export function planeBytes(width: number, height: number, hasAlpha: boolean): number {
    return width * height * 2 * (hasAlpha ? 4 : 3);
}

/**
 * Decompresses and interleaves the planes: `height·width·4` half floats as bits, row by row from
 * the top left, R G B A, A being 1 where the image has none.
 */
export function rgbaHalvesFromPayload(
    payload: Uint8Array,
    width: number,
    height: number,
    hasAlpha: boolean,
): Uint16Array<ArrayBuffer> {
    const expected = planeBytes(width, height, hasAlpha);
    // Into a buffer of ours fzstd writes what there is, short or not: so the frame must state its
    // length, and nothing is allocated by what it states.
    const stated = contentBytesOfFrame(payload);
    if (stated !== expected) {
        throw new WireError(`half planes state ${stated ?? "no"} bytes, expected ${expected}`);
    }
    const bytes = decompress(payload, new Uint8Array(expected));
    return interleavePlanes(bytes, width * height, hasAlpha ? 4 : 3);
}

/** Frame_Content_Size of a zstd frame [RFC 8878 §3.1.1.1]; null where it states none. */
function contentBytesOfFrame(frame: Uint8Array): number | null {
    if (frame.length < 6) throw new WireError(`half planes are ${frame.length} bytes of zstd`);
    const view = new DataView(frame.buffer, frame.byteOffset, frame.byteLength);
    if (view.getUint32(0, true) !== kZstdMagic) throw new WireError("half planes are not zstd");
    const descriptor = view.getUint8(4);
    const singleSegment = (descriptor & 0x20) !== 0;
    const sizeCode = descriptor >> 6;
    if (sizeCode === 0 && !singleSegment) return null;
    const dictionaryBytes = [0, 1, 2, 4][descriptor & 3]!;
    const offset = 5 + (singleSegment ? 0 : 1) + dictionaryBytes;
    if (frame.length < offset + 2 ** sizeCode)
        throw new WireError("zstd frame header is cut off");
    if (sizeCode === 0) return view.getUint8(offset);
    if (sizeCode === 1) return view.getUint16(offset, true) + 256;
    if (sizeCode === 2) return view.getUint32(offset, true);
    return Number(view.getBigUint64(offset, true));
}

/** `bytes` holds `planes` planes of `count` halves, low bytes before high bytes in each. */
export function interleavePlanes(
    bytes: Uint8Array,
    count: number,
    planes: 3 | 4,
): Uint16Array<ArrayBuffer> {
    const rgba = new Uint16Array(count * 4);
    if (planes === 3) rgba.fill(kHalfOne);
    for (let plane = 0; plane < planes; ++plane) {
        const low = plane * count * 2;
        const high = low + count;
        for (let i = 0, out = plane; i < count; ++i, out += 4) {
            rgba[out] = bytes[low + i]! | (bytes[high + i]! << 8);
        }
    }
    return rgba;
}
