/** Figures of the connection: what shows, how good it is, how fast it came. */
import { byId, setText } from "./dom";
import type { EditTimer } from "./edit_timer";
import type { ErrorPlot } from "./error_plot";
import {
    bakeErrorText,
    bytesText,
    millisecondsText,
    percentText,
    thousandsText,
} from "./format";
import { RateMeter } from "./rate_meter";
import type { ImageHeader } from "./wire/image_header";

export type MarkKind = "exact" | "settled" | "converging" | "moving" | "offline" | "waiting";

const kMarkWords: { [kind in MarkKind]: string } = {
    exact: "Exact",
    settled: "Settled",
    converging: "Converging",
    moving: "Moving",
    offline: "Offline",
    waiting: "Waiting",
};

const kRefreshMilliseconds = 200;
/** After so long without an image every rate is zero and the clock can stop. */
const kQuietMilliseconds = 1500;

export class Readouts {
    private readonly mark = byId("mark");
    private readonly markWords = byId("mark-words");
    private readonly markNote = byId("mark-note");
    private readonly error = byId("figure-error");
    private readonly pending = byId("figure-pending");
    private readonly images = byId("figure-images");
    private readonly editMedian = byId("figure-edit");
    private readonly editLatest = byId("figure-edit-latest");
    private readonly relight = byId("figure-relight");
    private readonly encode = byId("figure-encode");
    private readonly bytes = byId("figure-bytes");
    private readonly revision = byId("figure-revision");
    private readonly resolution = byId("figure-resolution");
    private readonly rate = new RateMeter();
    private receivedAt = 0;
    private clock = 0;
    private zoomWords = "";

    constructor(
        private readonly timer: EditTimer,
        private readonly plot: ErrorPlot,
        private readonly markOf: () => MarkKind,
        /** Header of the image on the canvas. */
        private readonly shown: () => ImageHeader | null,
        /** Of the scene, where its bake states one. */
        private readonly bakeError: () => number | undefined,
    ) {}

    frameReceived(header: ImageHeader, bytes: number, now: number): void {
        this.rate.add(now, bytes);
        this.receivedAt = now;
        this.plot.add(header, now);
        if (this.clock === 0) {
            this.refresh();
            this.clock = window.setInterval(() => this.refresh(), kRefreshMilliseconds);
        }
    }

    clear(): void {
        this.plot.clear();
        this.refresh();
    }

    /** Mark and figures of the image that shows: always of the same one. */
    refreshImage(): void {
        const kind = this.markOf();
        if (this.mark.dataset["kind"] !== kind) {
            this.mark.dataset["kind"] = kind;
            setText(this.markWords, kMarkWords[kind]);
        }
        setText(this.markNote, kind === "exact" ? bakeErrorText(this.bakeError()) : "");
        const shown = this.shown();
        if (shown === null) return;
        setText(this.error, percentText(shown.statedError));
        setText(
            this.pending,
            shown.exact
                ? "all coefficients"
                : `${thousandsText(shown.coefficientsPending)} to come`,
        );
        setText(this.relight, millisecondsText(shown.relightMilliseconds));
        setText(this.encode, `encode ${millisecondsText(shown.encodeMilliseconds)}`);
        setText(this.revision, thousandsText(shown.revision));
        setText(this.resolution, `${shown.width} × ${shown.height}${this.zoomWords}`);
    }

    /** In screen pixels an image pixel. */
    setZoom(words: string): void {
        this.zoomWords = ` · ${words}`;
        this.refreshImage();
    }

    private refresh(): void {
        const now = performance.now();
        this.refreshImage();
        const { count, amount } = this.rate.read(now);
        setText(this.images, String(count));
        setText(this.bytes, bytesText(amount));
        setText(this.editMedian, millisecondsText(this.timer.medianMilliseconds));
        setText(this.editLatest, `last ${millisecondsText(this.timer.latestMilliseconds)}`);
        if (now - this.receivedAt > kQuietMilliseconds) {
            clearInterval(this.clock);
            this.clock = 0;
        }
    }
}
