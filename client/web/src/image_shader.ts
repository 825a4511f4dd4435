/** The display formula in GLSL; display.ts is its twin. */

export const kVertexShader = `#version 300 es
out vec2 texel;
uniform vec2 size;
void main() {
    // One triangle that covers the canvas; textures hold the top row first.
    vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
    texel = vec2(corner.x, 1.0 - corner.y) * size;
}`;

export const kHalfFragmentShader = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D image;
uniform float scale;
uniform bool filmic;
in vec2 texel;
out vec4 colour;
void main() {
    vec3 x = clamp(texelFetch(image, ivec2(texel), 0).rgb * scale, 0.0, 1e12);
    if (filmic) x = (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
    x = clamp(x, 0.0, 1.0);
    vec3 curve = 1.055 * pow(max(x, vec3(1e-9)), vec3(1.0 / 2.4)) - 0.055;
    colour = vec4(mix(curve, 12.92 * x, lessThanEqual(x, vec3(0.0031308))), 1.0);
}`;

export const kJpegFragmentShader = `#version 300 es
precision mediump float;
uniform sampler2D image;
in vec2 texel;
out vec4 colour;
void main() {
    colour = vec4(texelFetch(image, ivec2(texel), 0).rgb, 1.0);
}`;
