// A small client of the wire (protocol/README.md §3).
import { spawnSync } from "node:child_process";
import { randomBytes } from "node:crypto";
import { EventEmitter, once } from "node:events";
import { request } from "node:http";

function refuse(condition, field) {
    if (condition) throw new Error(field);
}

/** The 64 bytes before an image; throws an Error whose message is the field at fault. */
export function imageHeader(frame) {
    refuse(frame.length < 64, "frame");
    refuse(frame.toString("latin1", 0, 4) !== "RLMI", "magic");
    refuse(frame.readUInt16LE(4) !== 1, "version");
    const encoding = { 1: "jpeg", 2: "half_planes" }[frame.readUInt16LE(6)];
    refuse(encoding === undefined, "encoding");
    const flags = frame.readUInt32LE(36);
    const header = {
        encoding,
        width: frame.readUInt32LE(8),
        height: frame.readUInt32LE(12),
        revision: Number(frame.readBigUInt64LE(16)),
        sequence: Number(frame.readBigUInt64LE(24)),
        relative_error: frame.readFloatLE(32),
        exact: (flags & 1) !== 0,
        has_alpha: (flags & 2) !== 0,
        edit_to_image_ms: frame.readFloatLE(40),
        relight_ms: frame.readFloatLE(44),
        encode_ms: frame.readFloatLE(48),
        coefficients_applied: frame.readUInt32LE(52),
        payload_bytes: frame.readUInt32LE(56),
        coefficients_remaining: frame.readUInt32LE(60),
    };
    const isSide = (side) => side >= 1 && side <= 16384;
    refuse(!isSide(header.width), "width");
    refuse(!isSide(header.height) || header.width * header.height > 2 ** 26, "height");
    for (const key of ["revision", "sequence"]) refuse(header[key] > 2 ** 53 - 1, key);
    const isMeasure = (value) => Number.isFinite(value) && value >= 0;
    for (const key of ["relative_error", "edit_to_image_ms", "relight_ms", "encode_ms"]) {
        refuse(!isMeasure(header[key]), key);
    }
    refuse((flags & ~3) !== 0 || (header.has_alpha && encoding === "jpeg"), "flags");
    refuse(header.exact && header.relative_error !== 0, "relative_error");
    refuse(header.exact && header.coefficients_remaining !== 0, "coefficients_remaining");
    refuse(header.payload_bytes === 0, "payload_bytes");
    refuse(header.payload_bytes !== frame.length - 64, "payload_bytes");
    return header;
}

export function floatFromHalf(bits) {
    const [sign, exponent, fraction] = [bits >> 15 ? -1 : 1, (bits >> 10) & 31, bits & 1023];
    if (exponent === 0) return sign * fraction * 2 ** -24;
    if (exponent === 31) return fraction === 0 ? sign * Infinity : NaN;
    return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

/** Of one zstd frame: the content size that its header states, or null. */
function statedSize(frame) {
    if (frame.length < 6 || frame.readUInt32LE(0) !== 0xfd2fb528) return null;
    const descriptor = frame[4];
    const isSingle = (descriptor & 32) !== 0;
    const flag = descriptor >> 6;
    const at = 5 + (isSingle ? 0 : 1) + [0, 1, 2, 4][descriptor & 3];
    const bytes = flag === 0 ? (isSingle ? 1 : 0) : 1 << flag;
    if (bytes === 0 || at + bytes > frame.length) return null;
    if (bytes === 2) return frame.readUInt16LE(at) + 256;
    return frame.readUIntLE(at, Math.min(bytes, 6));
}

/** Where the first zstd frame ends [RFC 8878 §3.1.1]. */
function frameEnd(frame) {
    const descriptor = frame[4];
    const isSingle = (descriptor & 32) !== 0;
    const flag = descriptor >> 6;
    let at = 5 + (isSingle ? 0 : 1) + [0, 1, 2, 4][descriptor & 3];
    at += flag === 0 ? (isSingle ? 1 : 0) : 1 << flag;
    for (let isLast = false; !isLast; ) {
        if (at + 3 > frame.length) return null;
        const block = frame.readUIntLE(at, 3);
        isLast = (block & 1) !== 0;
        at += 3 + (((block >> 1) & 3) === 1 ? 1 : block >> 3);
    }
    return at + ((descriptor & 4) !== 0 ? 4 : 0);
}

/** Planes R, G, B and, with alpha, A, one after the other. */
export function halfPlanes(payload, width, height, hasAlpha) {
    const perPlane = width * height;
    const planes = hasAlpha ? 4 : 3;
    if (statedSize(payload) !== 2 * planes * perPlane) throw new Error("stated size");
    if (frameEnd(payload) !== payload.length) throw new Error("not one frame");
    const options = { input: payload, maxBuffer: 2 ** 30 };
    const { status, stdout } = spawnSync("zstd", ["-dcq"], options);
    if (status !== 0) throw new Error("zstd");
    const values = new Float64Array(planes * perPlane);
    for (let plane = 0; plane < planes; ++plane) {
        for (let i = 0; i < perPlane; ++i) {
            const low = stdout[2 * plane * perPlane + i];
            const high = stdout[2 * plane * perPlane + perPlane + i];
            values[plane * perPlane + i] = floatFromHalf(low | (high << 8));
        }
    }
    if (!values.every(Number.isFinite)) throw new Error("a value is not finite");
    return values;
}

/** The 8-bit code that shows a linear value. */
export function codeOf(linear, { exposure_stops: stops, tone }) {
    const x = 2 ** stops * Math.max(0, linear);
    const curve = tone === "linear" ? x : (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
    const y = Math.min(1, Math.max(0, curve));
    const s = y <= 0.0031308 ? 12.92 * y : 1.055 * y ** (1 / 2.4) - 0.055;
    return Math.floor(255 * s + 0.5);
}

export const isName = (text) =>
    /^[A-Za-z0-9_-][A-Za-z0-9._-]{0,63}$/.test(text) && !text.includes("\n");

/** JSON Merge Patch [RFC 7396]. */
export function merged(target, patch) {
    const isObject = (value) =>
        value !== null && typeof value === "object" && !Array.isArray(value);
    if (!isObject(patch)) return patch;
    const result = isObject(target) ? { ...target } : {};
    for (const [key, value] of Object.entries(patch)) {
        if (value === null) delete result[key];
        else result[key] = merged(result[key], value);
    }
    return result;
}

/** The answer to one request, as {status, body}. */
export function http(server, method, path, body) {
    return new Promise((resolve, reject) => {
        const sent = request(new URL(path, server), { method }, async (answer) => {
            const parts = [];
            for await (const part of answer) parts.push(part);
            resolve({ status: answer.statusCode, body: Buffer.concat(parts).toString() });
        });
        sent.on("error", reject);
        sent.end(body);
    });
}

/** A connection: emits "text" with a message, "image" with header and payload, "close". */
export class RoomConnection extends EventEmitter {
    static async open(server, path, token) {
        const base64url = Buffer.from(token).toString("base64url");
        const headers = {
            Connection: "Upgrade",
            Upgrade: "websocket",
            "Sec-WebSocket-Version": "13",
            "Sec-WebSocket-Key": randomBytes(16).toString("base64"),
            "Sec-WebSocket-Protocol": `relume.v1, relume.token.${base64url}`,
        };
        const asking = request(new URL(path, server), { headers });
        asking.end();
        const [answer, socket, head] = await once(asking, "upgrade");
        if (answer.headers["sec-websocket-protocol"] !== "relume.v1") {
            throw new Error("the server has not chosen relume.v1");
        }
        return new RoomConnection(socket, head);
    }

    constructor(socket, head) {
        super();
        this.socket = socket;
        this.pending = head;
        this.state = null;
        socket.on("data", (bytes) => {
            this.pending = Buffer.concat([this.pending, bytes]);
            while (this.takeFrame());
        });
        socket.on("close", () => this.emit("close"));
    }

    start() {
        while (this.takeFrame());
    }

    /** False when no whole frame is there. */
    takeFrame() {
        const bytes = this.pending;
        if (bytes.length < 2) return false;
        let [length, at] = [bytes[1] & 127, 2];
        if (length === 126 && bytes.length >= 4) [length, at] = [bytes.readUInt16BE(2), 4];
        else if (length === 127 && bytes.length >= 10) {
            [length, at] = [Number(bytes.readBigUInt64BE(2)), 10];
        } else if (length > 125) return false;
        if (bytes.length < at + length) return false;
        this.pending = bytes.subarray(at + length);
        this.takePayload(bytes[0] & 15, bytes.subarray(at, at + length));
        return true;
    }

    takePayload(opcode, payload) {
        if (opcode === 1) {
            const message = JSON.parse(payload.toString());
            if (message.type === "snapshot") this.state = message.state;
            if (message.type === "change") this.state = merged(this.state, message.patch);
            this.emit("text", message);
        } else if (opcode === 2) {
            const header = imageHeader(payload);
            this.send({ type: "ack", sequence: header.sequence });
            this.emit("image", header, payload.subarray(64));
        } else if (opcode === 9) {
            this.write(10, payload);
        }
    }

    send(message) {
        this.write(1, Buffer.from(JSON.stringify(message)));
    }

    write(opcode, payload) {
        const mask = randomBytes(4);
        const length =
            payload.length < 126
                ? Buffer.from([128 | payload.length])
                : Buffer.from([128 | 126, payload.length >> 8, payload.length & 255]);
        const masked = Buffer.from(payload.map((byte, i) => byte ^ mask[i % 4]));
        this.socket.write(Buffer.concat([Buffer.from([128 | opcode]), length, mask, masked]));
    }

    close() {
        this.write(8, Buffer.from([3, 232]));
        this.socket.end();
    }

    /** Sends the patch and waits for the exact image in half floats that holds it. */
    exactImage(patch, id) {
        return new Promise((resolve, reject) => {
            let revision = null;
            const onText = (message) => {
                if (message.type === "error") reject(new Error(JSON.stringify(message)));
                const isOurs = message.type === "change" && message.edit_id === id;
                if (isOurs) revision = message.revision;
            };
            const onImage = (header, payload) => {
                const isIt = revision !== null && header.revision >= revision && header.exact;
                if (!isIt || header.encoding !== "half_planes") return;
                this.off("text", onText).off("image", onImage);
                resolve({ header, payload });
            };
            this.on("text", onText).on("image", onImage);
            this.on("close", () => reject(new Error("the connection has ended")));
            this.send({ type: "edit", id, patch });
        });
    }
}
