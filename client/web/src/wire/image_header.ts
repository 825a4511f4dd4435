/** The 64-byte header in front of every image [protocol/README.md §3.2]. */
import { WireError } from "./message";

export const kImageHeaderBytes = 64;
export const kImageVersion = 1;
export const kEncodingJpeg = 1;
export const kEncodingHalfPlanes = 2;

const kMagic = 0x494d4c52; // "RLMI", little-endian
const kFlagExact = 1;
const kFlagAlpha = 2;
const kMaxSide = 16384;
const kMaxPixels = 2 ** 26;

export interface ImageHeader {
    encoding: typeof kEncodingJpeg | typeof kEncodingHalfPlanes;
    width: number;
    height: number;
    /** Every edit up to this one is in the image. */
    revision: number;
    /** Per room, ascending. */
    sequence: number;
    /** Stated relative L2 error; 0 when exact. */
    statedError: number;
    exact: boolean;
    hasAlpha: boolean;
    editToImageMilliseconds: number;
    relightMilliseconds: number;
    encodeMilliseconds: number;
    coefficientsApplied: number;
    payloadBytes: number;
    coefficientsPending: number;
}

function refuse(field: string, found: unknown, expected: string): never {
    throw new WireError(`image ${field} is ${found}, expected ${expected}`, field);
}

/** Parses the header of a binary frame; throws WireError naming a field out of its range. */
export function imageHeaderFromFrame(frame: ArrayBuffer): ImageHeader {
    if (frame.byteLength < kImageHeaderBytes) {
        refuse("frame", `${frame.byteLength} bytes`, `at least ${kImageHeaderBytes} bytes`);
    }
    const view = new DataView(frame, 0, kImageHeaderBytes);
    const magic = view.getUint32(0, true);
    if (magic !== kMagic) refuse("magic", `0x${magic.toString(16)}`, "RLMI");
    const version = view.getUint16(4, true);
    if (version !== kImageVersion) refuse("version", version, String(kImageVersion));
    const flags = view.getUint32(36, true);
    if ((flags & ~(kFlagExact | kFlagAlpha)) !== 0) refuse("flags", flags, "bits 0 and 1 only");
    const encoding = view.getUint16(6, true);
    if (encoding !== kEncodingJpeg && encoding !== kEncodingHalfPlanes) {
        refuse("encoding", encoding, "1 (JPEG) or 2 (half planes)");
    }
    const header = fieldsFromView(view, encoding, flags);
    check(header, frame.byteLength - kImageHeaderBytes);
    return header;
}

function check(header: ImageHeader, payloadBytes: number): void {
    const { width, height } = header;
    const sides = `1 to ${kMaxSide}`;
    if (width < 1 || width > kMaxSide) refuse("width", width, sides);
    if (height < 1 || height > kMaxSide) refuse("height", height, sides);
    if (width * height > kMaxPixels) {
        refuse("height", `${width}x${height} pixels`, `at most ${kMaxPixels} pixels`);
    }
    if (header.exact && header.statedError !== 0) {
        refuse("relative_error", header.statedError, "0 in an exact image");
    }
    if (header.hasAlpha && header.encoding === kEncodingJpeg) {
        refuse("flags", "alpha in a JPEG", "alpha only in half planes");
    }
    if (header.exact && header.coefficientsPending !== 0) {
        refuse("coefficients_remaining", header.coefficientsPending, "0 in an exact image");
    }
    if (header.payloadBytes !== payloadBytes || payloadBytes === 0) {
        refuse("payload_bytes", header.payloadBytes, `${payloadBytes}, the rest of the frame`);
    }
}

function integerAt(view: DataView, offset: number, field: string): number {
    const value = view.getBigUint64(offset, true);
    if (value > BigInt(Number.MAX_SAFE_INTEGER)) refuse(field, value, "at most 2^53 - 1");
    return Number(value);
}

function amountAt(view: DataView, offset: number, field: string): number {
    const value = view.getFloat32(offset, true);
    if (!(value >= 0) || value === Infinity) refuse(field, value, "a finite number, 0 or more");
    return value;
}

function fieldsFromView(
    view: DataView,
    encoding: ImageHeader["encoding"],
    flags: number,
): ImageHeader {
    return {
        encoding,
        width: view.getUint32(8, true),
        height: view.getUint32(12, true),
        revision: integerAt(view, 16, "revision"),
        sequence: integerAt(view, 24, "sequence"),
        statedError: amountAt(view, 32, "relative_error"),
        exact: (flags & kFlagExact) !== 0,
        hasAlpha: (flags & kFlagAlpha) !== 0,
        editToImageMilliseconds: amountAt(view, 40, "edit_to_image_ms"),
        relightMilliseconds: amountAt(view, 44, "relight_ms"),
        encodeMilliseconds: amountAt(view, 48, "encode_ms"),
        coefficientsApplied: view.getUint32(52, true),
        payloadBytes: view.getUint32(56, true),
        coefficientsPending: view.getUint32(60, true),
    };
}
