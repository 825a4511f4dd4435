// The whole image of a state (protocol/README.md §3.2): B = T·L over what lies behind.
import { coefficients } from "./basis.mjs";
import { innerCubemap, lightingCubemap, lightsOf, profile } from "./lighting_cubemap.mjs";
import { rayOf, seenOf } from "./source_map.mjs";
import { distance, turnedBack } from "./sphere.mjs";
import { receiverOf, relit } from "./transport.mjs";

function environmentBehind(rig, maps, d, omega) {
    const source = turnedBack(rig.quaternion, d);
    const first = seenOf(maps.environment.levels, source, omega);
    const second = rig.amount === 0 ? first : seenOf(maps.blend.levels, source, omega);
    const seen = [0, 1, 2].map(
        (c) => rig.scale[c] * ((1 - rig.amount) * first[c] + rig.amount * second[c]),
    );
    for (const light of rig.lights) {
        const { f } = profile(light.alpha, Math.max(Math.sqrt(omega), 1e-5));
        const part = f(distance(d, light.direction));
        for (let c = 0; c < 3; ++c) seen[c] += light.radiance[c] * part;
    }
    return seen;
}

/** A map as the light's path takes it, for transports of cubemaps of n. */
export const prepared = (levels, n) => ({ levels, inner: innerCubemap(levels, n) });

/** `maps` has the prepared `environment` and, where the state blends, `blend`. */
export function pictureOf(transport, state, maps) {
    const { basis, camera, image } = transport.manifest;
    const n = basis.face_resolution;
    const rig = lightsOf(state);
    const cubemap = lightingCubemap(
        rig,
        maps.environment.inner,
        rig.amount === 0 ? null : maps.blend.inner,
        n,
    );
    const rgb = relit(transport, coefficients(basis, cubemap));
    const alpha = new Float64Array(image.width * image.height);
    for (let y = 0; y < image.height; ++y) {
        for (let x = 0; x < image.width; ++x) {
            const { block, slot } = receiverOf(image, x, y);
            const pixel = y * image.width + x;
            alpha[pixel] = transport.coverage[256 * block + slot];
            if (alpha[pixel] === 1 || state.background.mode === "transparent") continue;
            const behind =
                state.background.mode === "colour"
                    ? state.background.colour
                    : environmentBehind(
                          rig, maps, ...rayOf(camera, image.width, image.height, x, y));
            for (let c = 0; c < 3; ++c) rgb[3 * pixel + c] += (1 - alpha[pixel]) * behind[c];
        }
    }
    return { rgb, alpha };
}
