/** Linear colour as brightness times a picked sRGB colour. */
import { linearFromSrgb, srgbFromLinear } from "./display";
import type { Triple } from "./wire/state";

/** sRGB as `#rrggbb`, as the colour picker and CSS hold it. */
export type HexColour = string;

export interface Brightness {
    /** The largest linear part. */
    intensity: number;
    /** What remains: its largest part is full. */
    colour: HexColour;
}

export function brightnessFromLinear(linear: Triple): Brightness {
    const intensity = Math.max(...linear);
    if (!(intensity > 0)) return { intensity: 0, colour: "#ffffff" };
    return { intensity, colour: hexFromLinear(linear.map((p) => p / intensity) as Triple) };
}

/** The picked colour is scaled so that its largest part is full: brightness is `intensity`. */
export function linearFromBrightness({ intensity, colour }: Brightness): Triple {
    const parts = linearFromHex(colour);
    const largest = Math.max(...parts);
    return largest > 0
        ? (parts.map((part) => (intensity * part) / largest) as Triple)
        : [intensity, intensity, intensity];
}

/** Takes `#rgb` as well; anything else is black. */
export function linearFromHex(hex: HexColour): Triple {
    const short = /^#([0-9a-f])([0-9a-f])([0-9a-f])$/i.exec(hex);
    const long = /^#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})$/i.exec(hex);
    const digits = long?.slice(1) ?? short?.slice(1).map((digit) => digit + digit);
    if (digits === undefined) return [0, 0, 0];
    return digits.map((pair) => linearFromSrgb(parseInt(pair, 16) / 255)) as Triple;
}

/** Parts beyond [0, 1] are clamped. */
export function hexFromLinear(linear: Triple): HexColour {
    const digits = linear.map((part) => {
        const code = Math.round(255 * srgbFromLinear(Math.min(1, Math.max(0, part))));
        return code.toString(16).padStart(2, "0");
    });
    return `#${digits.join("")}`;
}
