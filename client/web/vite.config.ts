import { defineConfig, loadEnv } from "vite";

/** `npm run dev` works against a running relume-server, by default one on this machine. */
export default defineConfig(({ mode }) => {
    const server = loadEnv(mode, ".", "RELUME_")["RELUME_SERVER"] ?? "http://127.0.0.1:8080";
    return {
        base: "./",
        build: { target: "es2022", assetsInlineLimit: 0 },
        worker: { format: "es" },
        server: {
            proxy: {
                "/api": server,
                "/session": { target: server, ws: true },
            },
        },
    };
});
