/** Decompresses settled images off the page's thread. */
import { rgbaHalvesFromPayload } from "./wire/half_planes";

export interface HalfRequest {
    sequence: number;
    frame: ArrayBuffer;
    payloadOffset: number;
    width: number;
    height: number;
    hasAlpha: boolean;
}

export type HalfAnswer =
    | { sequence: number; rgba: Uint16Array<ArrayBuffer> }
    | { sequence: number; failure: string };

addEventListener("message", (event: MessageEvent<HalfRequest>) => {
    const { sequence, frame, payloadOffset, width, height, hasAlpha } = event.data;
    let answer: HalfAnswer;
    try {
        const payload = new Uint8Array(frame, payloadOffset);
        answer = { sequence, rgba: rgbaHalvesFromPayload(payload, width, height, hasAlpha) };
    } catch (error) {
        answer = { sequence, failure: error instanceof Error ? error.message : String(error) };
    }
    postMessage(answer, { transfer: "rgba" in answer ? [answer.rgba.buffer] : [] });
});
