import "./style/index.css";
import { Api } from "./api";
import { byId, isTyping } from "./dom";
import { turnLight } from "./image_drag";
import { Notices } from "./notices";
import { defaultRoom, type Place, placeFromAddress, sessionAddress } from "./place";
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
    { hand: "Double-click the map", words: "add a round light" },
    { hand: "Drag a light", words: "move it" },
    { hand: "Wheel on a light", words: "resize it" },
    { hand: "Drop a file", words: "use an .hdr or .exr as the environment" },
];

function shortcutsOf(studio: Studio): Shortcut[] {
    const { session, exposure, lights, environments } = studio;
    const step = (event: KeyboardEvent): number =>
        event.shiftKey ? kBigTurnDegrees : kTurnDegrees;
    const modes = ["environment", "colour", "transparent"] as const;
    return [
        {
            keys: ["ArrowLeft", "ArrowRight"],
            words: "turn the light (Shift: faster)",
            run: (event) => {
                turnLight(session, {
                    across: event.key === "ArrowLeft" ? -step(event) : step(event),
                });
            },
        },
        {
            keys: ["ArrowUp", "ArrowDown"],
            words: "tip the light",
            run: (event) => {
                turnLight(session, {
                    down: event.key === "ArrowUp" ? -step(event) : step(event),
                });
            },
        },
        {
            keys: [",", "."],
            words: "roll the light",
            run: (event) => {
                turnLight(session, {
                    clockwise: event.key === "," ? -kTurnDegrees : kTurnDegrees,
                });
            },
        },
        {
            keys: ["r", "R"],
            words: "reset the rotation",
            run: () => session.edit({ rotation: { quaternion: kIdentity } }),
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
                const mode = session.state?.background.mode ?? "environment";
                const next = modes[(modes.indexOf(mode) + 1) % modes.length] ?? "environment";
                session.edit({ background: { mode: next } });
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
        { keys: ["f", "F"], words: "fit the image, or one to one", run: toggleFit },
        { keys: ["h", "H"], words: "hide the panels", run: togglePanels },
        {
            keys: ["s", "S"],
            words: "save the settled image as PNG",
            run: () => void studio.savePng(),
        },
        { keys: ["?"], words: "this help", run: openHelp },
    ];
}

function toggleFit(): void {
    const isActual = byId("stage").classList.toggle("actual-size");
    byId("fit-button").setAttribute("aria-pressed", String(isActual));
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
            const scene = place.scene ?? scenes[0]?.name ?? null;
            picker.show(scenes, scene);
            if (scene !== null) return scene;
            byId("stage-veil").textContent = "The server has no scenes";
        } catch (error) {
            // A scene that is named can be joined without the list.
            if (place.scene !== null) return place.scene;
            byId("stage-veil").textContent =
                error instanceof Error ? error.message : String(error);
        }
        await new Promise((resolve) => setTimeout(resolve, kRetryMilliseconds));
    }
}

async function start(): Promise<void> {
    const place = placeFromAddress(new URL(location.href));
    const api = new Api(place.server, place.token);
    const scene = await chooseScene(api, place, new ScenePicker(api));
    const room = place.room ?? defaultRoom(scene);
    const studio = new Studio(
        sessionAddress(place, scene, room),
        place.mayUseGl,
        api,
        new Notices(byId("notices")),
    );
    window.relume = studio.inspection;

    const shortcuts = shortcutsOf(studio);
    listenForShortcuts(shortcuts);
    fillHelp(byId("help-content"), kGestures, shortcuts);
    byId("save-button").addEventListener("click", () => void studio.savePng());
    byId("fit-button").addEventListener("click", toggleFit);
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

/** "One to one" is in pixels of the screen; moving to another screen or zooming changes them. */
function followPixelRatio(): void {
    document.body.style.setProperty("--pixel-ratio", String(devicePixelRatio));
    matchMedia(`(resolution: ${devicePixelRatio}dppx)`).addEventListener(
        "change",
        followPixelRatio,
        { once: true },
    );
}

followPixelRatio();
start().catch((error: unknown) => {
    byId("stage-veil").textContent = error instanceof Error ? error.message : String(error);
});
