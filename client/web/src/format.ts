/** Figures as people read them. */

const kSuperscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹";

export function percentText(fraction: number): string {
    if (fraction === 0) return "0";
    const percent = fraction * 100;
    if (percent >= 100) return `${Math.round(percent)} %`;
    if (percent >= 10) return `${percent.toFixed(1)} %`;
    if (percent >= 0.01) return `${Number(percent.toPrecision(2))} %`;
    const exponent = Math.floor(Math.log10(fraction));
    const digits = [...String(-exponent)].map((digit) => kSuperscripts[Number(digit)]).join("");
    return `${(fraction / 10 ** exponent).toFixed(1)}·10⁻${digits}`;
}

/** What an exact image is off by all the same; empty where the bake does not say. */
export function bakeErrorText(error: number | undefined): string {
    return error === undefined ? "" : `bake ± ${percentText(error)}`;
}

export function millisecondsText(milliseconds: number | null): string {
    if (milliseconds === null) return "–";
    if (milliseconds < 10) return milliseconds.toFixed(1);
    return milliseconds < 1000 ? String(Math.round(milliseconds)) : thousandsText(milliseconds);
}

export function thousandsText(value: number): string {
    return Math.round(value).toLocaleString("en-US").replaceAll(",", "\u202f");
}

/** With unit: B, kB, MB, GB in powers of 1000. */
export function bytesText(bytes: number): string {
    let value = bytes;
    let unit = "B";
    for (const larger of ["kB", "MB", "GB"]) {
        if (value < 1000) break;
        value /= 1000;
        unit = larger;
    }
    return `${value < 10 && unit !== "B" ? value.toFixed(1) : Math.round(value)} ${unit}`;
}

export function stopsText(stops: number): string {
    const sign = stops > 0 ? "+" : stops < 0 ? "−" : "";
    return `${sign}${Math.abs(stops).toFixed(2)}`;
}

/** A light's power in stops; it gives nothing at −∞. */
export function levelText(stops: number): string {
    return Number.isFinite(stops) ? `${stopsText(stops)} EV` : "no light";
}

/** Three significant digits without an exponent. */
export function amountText(value: number): string {
    if (value === 0) return "0";
    if (value >= 1000) return thousandsText(value);
    return String(Number(value.toPrecision(3)));
}
