import type { DecodedImage } from "./image_decoder";
import { kHalfFragmentShader, kJpegFragmentShader, kVertexShader } from "./image_shader";
import type { Painter } from "./painter";
import type { DisplayState } from "./wire/state";

interface Program {
    program: WebGLProgram;
    size: WebGLUniformLocation | null;
    scale: WebGLUniformLocation | null;
    filmic: WebGLUniformLocation | null;
}

export class GlPainter implements Painter {
    readonly name = "webgl2";
    readonly largestSide: number;
    private readonly half: Program;
    private readonly jpeg: Program;
    private readonly texture: WebGLTexture;
    private kind: DecodedImage["kind"] = "jpeg";

    /** Throws where the context cannot do what is needed. */
    constructor(
        private readonly canvas: HTMLCanvasElement,
        private readonly gl: WebGL2RenderingContext,
    ) {
        this.largestSide = gl.getParameter(gl.MAX_TEXTURE_SIZE) as number;
        this.half = this.makeProgram(kHalfFragmentShader);
        this.jpeg = this.makeProgram(kJpegFragmentShader);
        this.texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
            gl.texParameteri(gl.TEXTURE_2D, side, gl.NEAREST);
        }
        for (const axis of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) {
            gl.texParameteri(gl.TEXTURE_2D, axis, gl.CLAMP_TO_EDGE);
        }
        gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
    }

    load(image: DecodedImage): void {
        const { gl } = this;
        const { width, height } = image.header;
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        if (image.kind === "half") {
            gl.texImage2D(
                gl.TEXTURE_2D,
                0,
                gl.RGBA16F,
                width,
                height,
                0,
                gl.RGBA,
                gl.HALF_FLOAT,
                image.rgba,
            );
        } else {
            gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, image.bitmap);
        }
        this.kind = image.kind;
        if (this.canvas.width !== width || this.canvas.height !== height) {
            this.canvas.width = width;
            this.canvas.height = height;
        }
    }

    paint(display: DisplayState): void {
        const { gl, canvas } = this;
        const program = this.kind === "half" ? this.half : this.jpeg;
        gl.viewport(0, 0, canvas.width, canvas.height);
        gl.useProgram(program.program);
        gl.uniform2f(program.size, canvas.width, canvas.height);
        gl.uniform1f(program.scale, 2 ** display.exposure_stops);
        gl.uniform1i(program.filmic, display.tone === "filmic" ? 1 : 0);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }

    read(display: DisplayState): Uint8ClampedArray {
        const { gl, canvas } = this;
        // The drawing buffer is emptied once shown, so paint again in the same task.
        this.paint(display);
        const rowBytes = canvas.width * 4;
        const bottomUp = new Uint8Array(rowBytes * canvas.height);
        gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, bottomUp);
        const pixels = new Uint8ClampedArray(bottomUp.length);
        for (let row = 0; row < canvas.height; ++row) {
            const from = (canvas.height - 1 - row) * rowBytes;
            pixels.set(bottomUp.subarray(from, from + rowBytes), row * rowBytes);
        }
        return pixels;
    }

    private makeProgram(fragmentSource: string): Program {
        const { gl } = this;
        const program = gl.createProgram();
        for (const [type, source] of [
            [gl.VERTEX_SHADER, kVertexShader],
            [gl.FRAGMENT_SHADER, fragmentSource],
        ] as const) {
            const shader = gl.createShader(type);
            if (shader === null) throw new Error("WebGL context is lost");
            gl.shaderSource(shader, source);
            gl.compileShader(shader);
            gl.attachShader(program, shader);
            gl.deleteShader(shader);
        }
        gl.linkProgram(program);
        if (gl.getProgramParameter(program, gl.LINK_STATUS) !== true) {
            throw new Error(`shader does not link: ${gl.getProgramInfoLog(program)}`);
        }
        return {
            program,
            size: gl.getUniformLocation(program, "size"),
            scale: gl.getUniformLocation(program, "scale"),
            filmic: gl.getUniformLocation(program, "filmic"),
        };
    }
}
