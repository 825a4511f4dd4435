/** The page put together: one session, what it shows, and what acts on it. */
import type { Api } from "./api";
import { AreaLights } from "./area_lights";
import { byId, setText } from "./dom";
import { EditTimer } from "./edit_timer";
import { EnvironmentList } from "./environment_list";
import { EnvironmentPanel } from "./environment_panel";
import { ErrorPlot } from "./error_plot";
import { Exposure } from "./exposure";
import { ImageDecoder } from "./image_decoder";
import { listenOnImage } from "./image_drag";
import { ImageView } from "./image_view";
import { inspect, type Inspection } from "./inspection";
import { LightMap } from "./light_map";
import { LightsPanel } from "./lights_panel";
import type { Notices } from "./notices";
import { pngFromSettled, saveAs } from "./png";
import { PreviewStore } from "./preview_store";
import { type MarkKind, Readouts } from "./readouts";
import { Session } from "./session";
import { patchToState } from "./shared_state";
import { StatusLine } from "./status_line";
import { StrategyPanel } from "./strategy_panel";
import { Upload } from "./upload";
import { titleOf } from "./wire/message";
import { kEncodingJpeg, type ImageHeader } from "./wire/image_header";
import type { RoomState } from "./wire/state";

/** So long after an edit the light still counts as moving. */
const kMovingMilliseconds = 250;

export class Studio {
    readonly session: Session;
    readonly view: ImageView;
    readonly exposure: Exposure;
    readonly lights: AreaLights;
    readonly environments: EnvironmentList;
    private readonly decoder: ImageDecoder;
    private readonly readouts: Readouts;
    private readonly timer = new EditTimer();
    private readonly environmentPanel: EnvironmentPanel;
    private readonly previews: PreviewStore;
    private movedAt = -Infinity;
    private knownRevision = -1;

    constructor(
        address: string,
        mayUseGl: boolean,
        private readonly api: Api,
        private readonly notices: Notices,
    ) {
        const session = new Session(address);
        this.session = session;
        this.view = new ImageView(byId("image-frame"), mayUseGl);
        this.decoder = new ImageDecoder(
            (sequence) => session.acknowledge(sequence),
            (header) => this.isWanted(header),
        );
        this.exposure = new Exposure(session, this.view);
        this.lights = new AreaLights(session);
        this.previews = new PreviewStore(api);
        this.environments = new EnvironmentList(byId("environments"), api, session);
        this.environmentPanel = new EnvironmentPanel(byId("environment-controls"), session);
        new LightMap(byId("light-map"), session, this.lights, this.previews);
        new LightsPanel(byId("lights"), session, this.lights);
        new StrategyPanel(byId("strategy-controls"), session, this.exposure);
        new StatusLine(session);
        this.readouts = new Readouts(this.timer, new ErrorPlot(byId("error-plot")), () =>
            this.mark(),
        );
        new Upload(
            {
                button: byId("upload-button"),
                input: byId("upload-input"),
                dropVeil: byId("drop-veil"),
            },
            api,
            session,
            notices,
            async ({ name }) => {
                this.previews.forget(name);
                await this.loadEnvironments(true);
                this.environments.choose(name);
            },
        );
        listenOnImage(byId("image-frame"), session, this.exposure);
        this.listenToSession();
        this.listenToDecoder();
    }

    start(): void {
        this.session.connect();
    }

    get inspection(): Inspection {
        return inspect(
            this.session,
            this.view,
            () => this.isExact,
            () => this.exposure.display,
        );
    }

    async savePng(): Promise<void> {
        const { settled } = this.view;
        const { snapshot, state } = this.session;
        if (settled === null || snapshot === null || state === null) {
            this.notices.show({
                tone: "info",
                title: "The image can be saved once it has settled",
            });
            return;
        }
        const blob = await pngFromSettled(settled, this.exposure.display);
        const name = `${snapshot.scene.name}-${state.environment.name}-r${settled.header.revision}`;
        saveAs(blob, `${name}.png`);
        this.notices.show({ tone: "info", title: `Saved ${name}.png` });
    }

    async loadEnvironments(replaced = false): Promise<void> {
        try {
            const entries = await this.api.environments();
            this.environments.show(entries, replaced);
            this.environmentPanel.setEnvironments(entries);
        } catch (error) {
            const title = error instanceof Error ? error.message : String(error);
            this.notices.show({ tone: "error", title: `Environments: ${title}` });
        }
    }

    private get isExact(): boolean {
        const { header } = this.view;
        return (
            this.session.status.kind === "open" &&
            header !== null &&
            header.exact &&
            this.view.settled !== null &&
            header.revision >= this.session.lightRevision &&
            this.session.isSettled &&
            !this.exposure.isPending
        );
    }

    private mark(): MarkKind {
        if (this.session.status.kind !== "open") return "offline";
        if (this.isExact) return "exact";
        const { header, settled } = this.view;
        if (header === null) return "waiting";
        const isCurrent = header.revision >= this.session.lightRevision;
        if (settled !== null && isCurrent) return header.exact ? "exact" : "settled";
        return performance.now() - this.movedAt < kMovingMilliseconds ? "moving" : "converging";
    }

    /** A JPEG of light that already shows settled would be a step back. */
    private isWanted(header: ImageHeader): boolean {
        const { settled } = this.view;
        const { lightRevision, revision } = this.session;
        return !(
            header.encoding === kEncodingJpeg &&
            settled !== null &&
            settled.header.revision >= lightRevision &&
            header.revision <= revision
        );
    }

    private listenToSession(): void {
        const { session } = this;
        session.opened.listen(({ snapshot: { scene, room }, forgotten }) => {
            this.decoder.clear();
            this.timer.clear();
            this.readouts.clear();
            this.knownRevision = session.revision;
            this.view.forget();
            setText(byId("room-name"), room);
            document.title = `${scene.name} – Relume`;
            void this.loadEnvironments();
            if (forgotten !== null) this.offerBack(forgotten);
        });
        session.stateChanged.listen((state) => {
            if (session.lightRevision !== this.knownRevision || !session.isSettled) {
                this.knownRevision = session.lightRevision;
                this.movedAt = performance.now();
            }
            const { names } = this.environments;
            if (names.length > 0 && !names.includes(state.environment.name)) {
                void this.loadEnvironments();
            }
            this.readouts.refreshMark();
        });
        session.statusChanged.listen(({ kind }) => {
            byId("stage").dataset["status"] = kind;
            this.readouts.refreshMark();
        });
        session.viewersChanged.listen((count) => setText(byId("viewers"), String(count)));
        session.frameReceived.listen((frame) => {
            const header = this.decoder.take(frame);
            this.readouts.frameReceived(header, frame.byteLength, performance.now());
        });
        session.refused.listen((refusal) => {
            const { path, found, expected } = refusal;
            const title =
                path === undefined ? titleOf(refusal) : `${path}: ${titleOf(refusal)}`;
            this.notices.show({ tone: "error", title, found, expected });
        });
        session.editSent.listen(({ id, patch }) => {
            // Display shows at once, whatever the server does with it.
            if (Object.keys(patch).some((key) => key !== "display")) {
                this.timer.editSent(id, performance.now());
            }
        });
        session.editConfirmed.listen(({ id, revision }) =>
            this.timer.editConfirmed(id, revision),
        );
        session.editDropped.listen((id) => this.timer.editDropped(id));
    }

    /** A server that was started anew begins the room anew; this page still knows the light. */
    private offerBack(forgotten: RoomState): void {
        this.notices.show({
            tone: "warning",
            title: "The server has begun this room anew",
            action: {
                words: "Bring back the light as it was",
                run: () => {
                    const { state } = this.session;
                    if (state !== null) this.session.edit(patchToState(state, forgotten));
                },
            },
        });
    }

    private listenToDecoder(): void {
        this.decoder.decoded.listen((image) => {
            this.view.show(image);
            this.timer.imageShown(image.header.revision, performance.now());
            this.readouts.refreshMark();
        });
        this.decoder.failed.listen((title) => this.notices.show({ tone: "error", title }));
    }
}
