/**
 * From frames to images: decodes one at a time and keeps at most the newest of those that wait.
 * A frame is acknowledged when it is taken up or overtaken, so the server sends no faster than
 * this page decodes.
 */
import type { HalfAnswer, HalfRequest } from "./half_worker";
import { Signal } from "./signal";
import {
    type ImageHeader,
    imageHeaderFromFrame,
    kEncodingJpeg,
    kImageHeaderBytes,
} from "./wire/image_header";

export type DecodedImage =
    | { kind: "jpeg"; header: ImageHeader; bitmap: ImageBitmap }
    | { kind: "half"; header: ImageHeader; rgba: Uint16Array<ArrayBuffer> };

interface Frame {
    header: ImageHeader;
    bytes: ArrayBuffer;
}

export class ImageDecoder {
    readonly decoded = new Signal<DecodedImage>();
    readonly failed = new Signal<string>();

    private readonly worker = new Worker(new URL("./half_worker.ts", import.meta.url), {
        type: "module",
    });
    private pending: Frame | null = null;
    private busy = false;
    private connection = 0;

    constructor(
        private readonly acknowledge: (sequence: number) => void,
        /** False for an image that would show less than what is on the canvas. */
        private readonly isWanted: (header: ImageHeader) => boolean,
    ) {}

    /** Takes a binary frame; throws WireError where it is not an image. Returns its header. */
    take(bytes: ArrayBuffer): ImageHeader {
        const header = imageHeaderFromFrame(bytes);
        if (this.pending !== null) this.acknowledge(this.pending.header.sequence);
        this.pending = { header, bytes };
        if (!this.busy) void this.decodePending();
        return header;
    }

    /** Forgets the waiting frame and the one in work: they are of another connection. */
    clear(): void {
        this.pending = null;
        ++this.connection;
    }

    private async decodePending(): Promise<void> {
        this.busy = true;
        while (this.pending !== null) {
            const frame: Frame = this.pending;
            this.pending = null;
            this.acknowledge(frame.header.sequence);
            if (!this.isWanted(frame.header)) continue;
            const { connection } = this;
            try {
                const image = await this.decode(frame);
                if (connection === this.connection) this.decoded.send(image);
                else if (image.kind === "jpeg") image.bitmap.close();
            } catch (error) {
                this.failed.send(error instanceof Error ? error.message : String(error));
            }
        }
        this.busy = false;
    }

    private async decode({ header, bytes }: Frame): Promise<DecodedImage> {
        if (header.encoding === kEncodingJpeg) {
            const blob = new Blob([new Uint8Array(bytes, kImageHeaderBytes)], {
                type: "image/jpeg",
            });
            const bitmap = await createImageBitmap(blob, { colorSpaceConversion: "none" });
            if (bitmap.width !== header.width || bitmap.height !== header.height) {
                bitmap.close();
                throw new Error(
                    `JPEG is ${bitmap.width}x${bitmap.height}, its header says ` +
                        `${header.width}x${header.height}`,
                );
            }
            return { kind: "jpeg", header, bitmap };
        }
        return { kind: "half", header, rgba: await this.decodeHalves(header, bytes) };
    }

    private decodeHalves(
        header: ImageHeader,
        frame: ArrayBuffer,
    ): Promise<Uint16Array<ArrayBuffer>> {
        return new Promise((resolve, reject) => {
            this.worker.onmessage = (event: MessageEvent<HalfAnswer>) => {
                if (event.data.sequence !== header.sequence) return;
                if ("rgba" in event.data) resolve(event.data.rgba);
                else reject(new Error(event.data.failure));
            };
            this.worker.onerror = (event) => reject(new Error(event.message));
            const request: HalfRequest = {
                sequence: header.sequence,
                frame,
                payloadOffset: kImageHeaderBytes,
                width: header.width,
                height: header.height,
                hasAlpha: header.hasAlpha,
            };
            this.worker.postMessage(request, [frame]);
        });
    }
}
