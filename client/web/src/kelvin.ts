/** Colour temperatures as people type them, and the colour of a black body of that heat. */
import { type HexColour, hexFromLinear } from "./colour";
import type { Triple } from "./wire/state";

/** Range of the approximation to the Planckian locus [Kang02]. */
export const kCoolestKelvin = 1667;
export const kHottestKelvin = 25000;

/** `3200K`, `3200 k`, `5.6kK`; null for anything else and beyond the range. */
export function kelvinFromText(text: string): number | null {
    const match = /^\s*(\d+(?:[.,]\d+)?)\s*(k?)\s*(?:k|°k|kelvin)\s*$/i.exec(text);
    if (match === null) return null;
    const kelvin = Number(match[1]!.replace(",", ".")) * (match[2] === "" ? 1 : 1000);
    return kelvin >= kCoolestKelvin && kelvin <= kHottestKelvin ? kelvin : null;
}

/** Linear Rec. 709, the largest part 1; colours outside the gamut are brought to its edge. */
export function linearFromKelvin(kelvin: number): Triple {
    const t = 1000 / kelvin;
    const x =
        kelvin <= 4000
            ? ((-0.2661239 * t - 0.2343589) * t + 0.8776956) * t + 0.17991
            : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.24039;
    const y =
        kelvin <= 2222
            ? ((-1.1063814 * x - 1.3481102) * x + 2.18555832) * x - 0.20219683
            : kelvin <= 4000
              ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
              : ((3.081758 * x - 5.8733867) * x + 3.75112997) * x - 0.37001483;
    const [X, Z] = [x / y, (1 - x - y) / y];
    const linear = [
        3.2404542 * X - 1.5371385 - 0.4985314 * Z,
        -0.969266 * X + 1.8760108 + 0.041556 * Z,
        0.0556434 * X - 0.2040259 + 1.0572252 * Z,
    ].map((part) => Math.max(0, part));
    const largest = Math.max(...linear);
    return linear.map((part) => part / largest) as Triple;
}

export function hexFromKelvin(kelvin: number): HexColour {
    return hexFromLinear(linearFromKelvin(kelvin));
}

/**
 * Lets every colour field under `root` take a temperature: the field's text becomes the colour
 * before the field itself looks at it.
 */
export function understandKelvin(root: HTMLElement): void {
    const rewrite = (event: Event): void => {
        const field = event.target;
        if (!(field instanceof HTMLInputElement) || field.closest(".tp-colv") === null) return;
        const kelvin = kelvinFromText(field.value);
        if (kelvin !== null) field.value = hexFromKelvin(kelvin);
    };
    root.addEventListener("change", rewrite, { capture: true });
}
