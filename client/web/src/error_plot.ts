/** The stated error over time, logarithmic, as it falls. It stands still while nothing arrives. */
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { percentText } from "./format";
import type { ImageHeader } from "./wire/image_header";

const kWindowSeconds = 12;
/** A pause this long parts the line: nothing was shown in between. */
const kPauseSeconds = 0.5;
const kMostImages = 4000;
/** The lower border; exact images stand on it. */
const kFloor = 1e-5;
const kCeiling = 2;
const kRedrawMilliseconds = 80;
const kHeight = 84;

export class ErrorPlot {
    private readonly times: number[] = [];
    private readonly errors: (number | null)[] = [];
    private readonly exact: (number | null)[] = [];
    private readonly plot: uPlot;
    private timer = 0;

    constructor(root: HTMLElement) {
        const style = getComputedStyle(document.documentElement);
        const colour = (name: string): string => style.getPropertyValue(name).trim();
        const axis = {
            stroke: colour("--text-faint"),
            font: `10px ${colour("--font")}`,
            grid: { stroke: colour("--line-faint"), width: 1 },
            ticks: { show: false },
        };
        this.plot = new uPlot(
            {
                width: Math.max(120, root.clientWidth),
                height: kHeight,
                padding: [6, 4, 0, 0],
                legend: { show: false },
                cursor: { show: false },
                scales: {
                    x: { time: false },
                    y: { distr: 3, range: [kFloor, kCeiling] },
                },
                axes: [
                    { ...axis, show: false },
                    {
                        ...axis,
                        size: 46,
                        splits: () => [1, 1e-2, 1e-4],
                        values: (_plot, values) => values.map((value) => percentText(value)),
                        filter: (_plot, values) => values,
                    },
                ],
                series: [
                    {},
                    {
                        stroke: colour("--text"),
                        width: 1.5,
                        points: { show: false },
                    },
                    {
                        stroke: colour("--exact"),
                        points: { show: true, size: 6, fill: colour("--exact") },
                        paths: () => null,
                    },
                ],
            },
            [[], [], []],
            root,
        );
        new ResizeObserver(() => {
            this.plot.setSize({ width: Math.max(120, root.clientWidth), height: kHeight });
        }).observe(root);
    }

    add(header: ImageHeader, now: number): void {
        const last = this.times[this.times.length - 1];
        if (last !== undefined && now / 1000 - last > kPauseSeconds) {
            this.times.push(now / 1000 - kPauseSeconds / 2);
            this.errors.push(null);
            this.exact.push(null);
        }
        this.times.push(now / 1000);
        this.errors.push(Math.max(kFloor, header.statedError));
        this.exact.push(header.exact ? kFloor : null);
        const oldest = now / 1000 - kWindowSeconds;
        let stale = Math.max(0, this.times.length - kMostImages);
        while (this.times[stale]! < oldest) ++stale;
        for (const column of [this.times, this.errors, this.exact]) column.splice(0, stale);
        if (this.timer === 0) {
            this.timer = window.setTimeout(() => this.redraw(), kRedrawMilliseconds);
        }
    }

    clear(): void {
        for (const column of [this.times, this.errors, this.exact]) column.length = 0;
        this.redraw();
    }

    private redraw(): void {
        clearTimeout(this.timer);
        this.timer = 0;
        const last = this.times[this.times.length - 1] ?? 0;
        this.plot.batch(() => {
            this.plot.setData([this.times, this.errors, this.exact], false);
            this.plot.setScale("x", { min: last - kWindowSeconds, max: last });
        });
    }
}
