import "./style/index.css";
import { Api } from "./api";
import { byId, isTyping, setText } from "./dom";
import { turnLight } from "./image_drag";
import { Notices } from "./notices";
import { defaultRoom, type Place, placeFromAddress, connectionAddress } from "./place";
import { kIdentity } from "./rotation";
import { ScenePicker } from "./scene_picker";
import { fillHelp, type Gesture, listenForShortcuts, type Shortcut } from "./shortcuts";
import { Studio } from "./studio";

const kTurnDegrees = 2;
const kBigTurnDegrees = 10;
const kExposureStep = 0.25;
const kRetryMilliseconds = 2000;

const kGestures: Gesture[] = [
    { hand: "Drag the image", words: "turn the light about the vertical" },
    { hand: "Shift + drag", words: "turn and tip the light" },
    { hand: "Alt + wheel", words: "roll the light" },
    { hand: "Wheel", words: "exposure" },
    {
        hand: "Drag, where the camera moves",
        words: "orbit; with Shift or the right button pan (Alt + drag turns the light)",
    },
    { hand: "Wheel, where the camera moves", words: "nearer or farther" },
    { hand: "Two fingers, where the camera moves", words: "pan; pinch: nearer or farther" },
    { hand: "Ctrl + wheel, or pinch", words: "zoom" },
    { hand: "Space + drag", words: "pan (or middle button, two fingers)" },
    { hand: "Double-click the map", words: "add a round light" },
    { hand: "Drag a light", words: "move it" },
    { hand: "Wheel on a light", words: "resize it" },
    { hand: "Double-click a light's row", words: "rename it" },
    { hand: "Click the image, where materials are edited", words: "choose the material" },
    { hand: "Drag over a curve", words: "draw it, smooth it, or move a control point" },
    { hand: "Double-click a curve", words: "with points: add or remove one" },
    {
        hand: "Drop a file",
        words: "use an .hdr or .exr as the environment, a .json as the lighting",
    },
];

function shortcutsOf(studio: Studio): Shortcut[] {
    const { connection, exposure, lights, environments, downloads, zoom, camera } = studio;
    const { materials, materialPanel, finishes } = studio;
    const { editor } = materialPanel;
    const inMaterials = (run: () => void) => (): void => {
        if (connection.takes("materials") && materials.selected !== null) run();
    };
    const step = (event: KeyboardEvent): number =>
        event.shiftKey ? kBigTurnDegrees : kTurnDegrees;
    const modes = ["environment", "colour", "transparent"] as const;
    return [
        {
            keys: ["ArrowLeft", "ArrowRight"],
            words: "turn the light (Shift: faster)",
            run: (event) => {
                turnLight(connection, {
                    across: event.key === "ArrowLeft" ? -step(event) : step(event),
                });
            },
        },
        {
            keys: ["ArrowUp", "ArrowDown"],
            words: "tip the light",
            run: (event) => {
                turnLight(connection, {
                    down: event.key === "ArrowUp" ? -step(event) : step(event),
                });
            },
        },
        {
            keys: [",", "."],
            words: "roll the light",
            run: (event) => {
                turnLight(connection, {
                    clockwise: event.key === "," ? -kTurnDegrees : kTurnDegrees,
                });
            },
        },
        {
            keys: ["r", "R"],
            words: "reset the rotation",
            run: () => {
                if (connection.takes("rotation"))
                    connection.edit({ rotation: { quaternion: kIdentity } });
            },
        },
        {
            keys: ["e"],
            words: "next environment",
            run: () => environments.step(1),
        },
        {
            keys: ["E"],
            words: "previous environment",
            run: () => environments.step(-1),
        },
        { keys: ["["], words: "darker by ¼ stop", run: () => exposure.step(-kExposureStep) },
        { keys: ["]"], words: "brighter by ¼ stop", run: () => exposure.step(kExposureStep) },
        { keys: ["0"], words: "exposure 0", run: () => exposure.set({ exposure_stops: 0 }) },
        {
            keys: ["t", "T"],
            words: "tone curve: filmic or linear",
            run: () =>
                exposure.set({
                    tone: exposure.display.tone === "filmic" ? "linear" : "filmic",
                }),
        },
        {
            keys: ["b", "B"],
            words: "background: environment, colour, nothing",
            run: () => {
                if (!connection.takes("background")) return;
                const mode = connection.state?.background.mode ?? "environment";
                const next = modes[(modes.indexOf(mode) + 1) % modes.length] ?? "environment";
                connection.edit({ background: { mode: next } });
            },
        },
        { keys: ["l", "L"], words: "add a light", run: () => void lights.add() },
        {
            keys: ["Delete"],
            words: "remove the selected light",
            run: () => {
                if (lights.selected !== null) lights.remove(lights.selected);
            },
        },
        {
            keys: ["a", "A"],
            words: "frame all, where the camera moves",
            run: () => camera.frameAll(),
        },
        { keys: ["c", "C"], words: "the camera of the file", run: () => camera.reset() },
        {
            keys: ["z"],
            withControl: true,
            words: "undo the last edit of a material or a finish",
            run: () => (finishes.isTaken ? finishes : materials).history.undo(),
        },
        {
            keys: ["Z", "y"],
            withControl: true,
            words: "redo it",
            run: () => (finishes.isTaken ? finishes : materials).history.redo(),
        },
        {
            keys: ["d", "D"],
            words: "draw the curve",
            run: inMaterials(() => editor.choose("draw")),
        },
        { keys: ["m", "M"], words: "smooth it", run: inMaterials(() => editor.choose("smooth")) },
        {
            keys: ["p", "P"],
            words: "move its control points",
            run: inMaterials(() => editor.choose("points")),
        },
        {
            keys: ["g", "G"],
            words: "linear or logarithmic values",
            run: inMaterials(() => editor.toggleAxis()),
        },
        { keys: ["f"], words: "fit the image, or one to one", run: () => zoom.toggleActual() },
        { keys: ["F"], words: "full screen", run: toggleFullScreen },
        { keys: ["+", "="], words: "zoom in", run: () => zoom.step(1) },
        { keys: ["-"], words: "zoom out", run: () => zoom.step(-1) },
        { keys: ["h", "H"], words: "hide the panels", run: togglePanels },
        { keys: ["s"], words: "save as PNG, as it shows", run: () => void downloads.savePng() },
        {
            keys: ["S"],
            words: "save as EXR, linear half floats",
            run: () => void downloads.saveExr(),
        },
        { keys: ["?"], words: "this help", run: openHelp },
    ];
}

function toggleFullScreen(): void {
    if (document.fullscreenElement !== null) void document.exitFullscreen();
    else void byId("stage").requestFullscreen();
}

function togglePanels(): void {
    document.body.classList.toggle("panels-hidden");
}

function openHelp(): void {
    byId<HTMLDialogElement>("help-dialog").showModal();
}

/** Asks until the server answers: the page may be open before the server is up. */
async function chooseScene(api: Api, place: Place, picker: ScenePicker): Promise<string> {
    for (;;) {
        try {
            const scenes = await api.scenes();
            const names = scenes.map(({ name }) => name);
            const scene = place.scene ?? names[0] ?? null;
            picker.show(scenes, scene);
            if (scene !== null && names.includes(scene)) return scene;
            if (scene === null) setText(byId("stage-veil"), "The server has no scenes");
            else picker.offerInsteadOf(scene, scenes);
        } catch (error) {
            // A scene that is named can be joined without the list.
            if (place.scene !== null) return place.scene;
            setText(byId("stage-veil"), error instanceof Error ? error.message : String(error));
        }
        await new Promise((resolve) => setTimeout(resolve, kRetryMilliseconds));
    }
}

async function start(): Promise<void> {
    const place = placeFromAddress(new URL(location.href));
    const api = new Api(place.server, place.token);
    const scene = await chooseScene(api, place, new ScenePicker(api));
    const room = place.room ?? defaultRoom(scene);
    byId("stage-veil").classList.remove("stage-veil-links");
    const studio = new Studio(
        place,
        connectionAddress(place, scene, room),
        api,
        new Notices(byId("notices")),
    );
    window.relume = studio.inspection;

    const shortcuts = shortcutsOf(studio);
    listenForShortcuts(shortcuts);
    fillHelp(byId("help-content"), kGestures, shortcuts);
    for (const [id, save] of [
        ["save-png", () => void studio.downloads.savePng()],
        ["save-exr", () => void studio.downloads.saveExr()],
        ["save-lighting", () => studio.downloads.saveLighting()],
    ] as const) {
        byId(id).addEventListener("click", () => {
            byId("save-menu").hidePopover();
            save();
        });
    }
    byId("fit-button").addEventListener("click", () => studio.zoom.toggleActual());
    byId("full-screen-button").addEventListener("click", toggleFullScreen);
    byId("add-light-button").addEventListener("click", () => void studio.lights.add());
    studio.start();
}

byId("help-button").addEventListener("click", openHelp);
for (const dialog of document.querySelectorAll("dialog")) {
    dialog.addEventListener("click", (event) => {
        if (event.target === dialog) dialog.close();
    });
}
// A slider that has been dragged keeps the focus; shortcuts should work all the same.
window.addEventListener("pointerup", () => {
    const { activeElement } = document;
    if (isTyping(activeElement) && activeElement?.getAttribute("type") === "range") {
        (activeElement as HTMLElement).blur();
    }
});

start().catch((error: unknown) => {
    byId("stage-veil").textContent = error instanceof Error ? error.message : String(error);
});
