/**
 * How bright a round light is. Its power is radiance times solid angle: what it gives to the
 * scene. In stops, 0 EV lights a white matte surface that faces a small light to radiance 1.
 */
import { brightnessFromLinear, type HexColour, linearFromBrightness } from "./colour";
import { type AreaLight, kRanges, type Triple } from "./wire/state";

const kLargestRadiance = kRanges.lights.radiance.highest;

/** 2π(1 − cos r), written so that small angles keep their digits. */
export function solidAngleSr(angularRadiusDegrees: number): number {
    const sine = Math.sin((angularRadiusDegrees * Math.PI) / 360);
    return 4 * Math.PI * sine * sine;
}

/** Radius of the round light that is as large as a mean texel of the lighting cubemap. */
export function texelRadiusDegrees(faceResolution: number): number {
    const texelSr = (4 * Math.PI) / (6 * faceResolution ** 2);
    return (Math.asin(Math.sqrt(texelSr / (4 * Math.PI))) * 360) / Math.PI;
}

export interface LightLevel {
    /** Of the brightest channel, with gain and tint; −∞ for a light that gives nothing. */
    stops: number;
    /** What remains: its largest part is full. */
    colour: HexColour;
}

export function levelOfLight(light: AreaLight): LightLevel {
    const { intensity, colour } = brightnessFromLinear(radianceOfLight(light));
    const power = (intensity * solidAngleSr(light.angular_radius_degrees)) / Math.PI;
    return { stops: Math.log2(power), colour };
}

/** With gain and tint in it. */
export function radianceOfLight({ radiance, tint, gain }: AreaLight): Triple {
    return radiance.map((part, c) => part * tint[c]! * gain) as Triple;
}

/** Fields of a light of that level, as bright as the server takes. Gain and tint are in it. */
export function fieldsFromLevel(
    { stops, colour }: LightLevel,
    angularRadiusDegrees: number,
): Pick<AreaLight, "radiance" | "gain" | "tint"> {
    const intensity = (2 ** stops * Math.PI) / solidAngleSr(angularRadiusDegrees);
    const radiance = linearFromBrightness({
        intensity: Math.min(kLargestRadiance, intensity),
        colour,
    });
    return { radiance, gain: 1, tint: [1, 1, 1] };
}

/** Radiance of the same power at another radius; it stops at what the server takes. */
export function radianceAtRadius(light: AreaLight, angularRadiusDegrees: number): Triple {
    const ratio =
        solidAngleSr(light.angular_radius_degrees) / solidAngleSr(angularRadiusDegrees);
    const largest = Math.max(...light.radiance);
    const most = largest > 0 ? kLargestRadiance / largest : ratio;
    return light.radiance.map((part) => part * Math.min(ratio, most)) as Triple;
}
