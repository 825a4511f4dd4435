/** The page put together: one connection, what it shows, and what acts on it. */
import type { Api } from "./api";
import { AreaLights } from "./area_lights";
import { CameraHand, movingBounds } from "./camera_hand";
import { CameraPanel } from "./camera_panel";
import { DisplayPanel } from "./display_panel";
import { byId, setText } from "./dom";
import { Downloads } from "./downloads";
import { EditTimer } from "./edit_timer";
import { EnvironmentList } from "./environment_list";
import { EnvironmentPanel } from "./environment_panel";
import { ErrorPlot } from "./error_plot";
import { Exposure } from "./exposure";
import { FinishPanel } from "./finish_panel";
import { Finishes } from "./finishes";
import { ImageDecoder } from "./image_decoder";
import { listenOnImage } from "./image_drag";
import { ImageView } from "./image_view";
import { ImageZoom } from "./image_zoom";
import { inspect, type Inspection } from "./inspection";
import { LightMap } from "./light_map";
import { LightReturn } from "./light_return";
import { type Lighting, wholeLightingOf } from "./lighting";
import { LightsPanel } from "./lights_panel";
import { editsMaterials, MaterialPanel } from "./material_panel";
import { MaterialPicker } from "./material_picker";
import { Materials } from "./materials";
import type { Notices } from "./notices";
import { medianRadiance } from "./median_radiance";
import { type Place, subprotocols } from "./place";
import { PreviewStore } from "./preview_store";
import { type MarkKind, Readouts } from "./readouts";
import { RoomConnection } from "./room_connection";
import { SoloSign } from "./solo_sign";
import { StatusLine } from "./status_line";
import { StrategyPanel } from "./strategy_panel";
import { Upload } from "./upload";
import { UploadStore } from "./upload_store";
import { isObject } from "./wire/merge_patch";
import { titleOf } from "./wire/message";
import { kEncodingJpeg, type ImageHeader } from "./wire/image_header";
import { makesAnotherImage } from "./wire/stages";

/** So long after an edit the light still counts as moving. */
const kMovingMilliseconds = 250;

export class Studio {
    readonly connection: RoomConnection;
    readonly view: ImageView;
    readonly exposure: Exposure;
    readonly lights: AreaLights;
    readonly environments: EnvironmentList;
    readonly downloads: Downloads;
    readonly zoom: ImageZoom;
    readonly camera: CameraPanel;
    readonly materials: Materials;
    readonly materialPanel: MaterialPanel;
    readonly finishes: Finishes;
    private readonly decoder: ImageDecoder;
    private readonly readouts: Readouts;
    private readonly timer = new EditTimer();
    private readonly environmentPanel: EnvironmentPanel;
    private readonly previews: PreviewStore;
    private readonly lightReturn: LightReturn;
    private movedAt = -Infinity;
    private knownRevision = -1;

    constructor(
        place: Place,
        address: string,
        private readonly api: Api,
        private readonly notices: Notices,
    ) {
        const connection = new RoomConnection(address, subprotocols(place));
        this.connection = connection;
        this.view = new ImageView(byId("image-frame"), place.mayUseGl);
        this.decoder = new ImageDecoder(
            (sequence) => connection.acknowledge(sequence),
            (header) => this.isWanted(header),
        );
        this.exposure = new Exposure(connection, this.view);
        this.lights = new AreaLights(connection, () => ({
            medianRadiance:
                this.view.settled === null ? null : medianRadiance(this.view.settled),
            exposureStops: this.exposure.display.exposure_stops,
        }));
        this.downloads = new Downloads(connection, this.view, this.exposure, notices);
        this.previews = new PreviewStore(api);
        this.environments = new EnvironmentList(byId("environments"), this.previews, connection);
        this.environmentPanel = new EnvironmentPanel(byId("environment-controls"), connection);
        new LightMap(byId("light-map"), connection, this.lights, this.previews);
        new LightsPanel(byId("lights"), connection, this.lights);
        new DisplayPanel(byId("display-controls"), connection, this.exposure);
        new StrategyPanel(byId("strategy-controls"), connection);
        new StatusLine(connection);
        new SoloSign(connection, this.lights);
        this.readouts = new Readouts(
            this.timer,
            new ErrorPlot(byId("error-plot")),
            () => this.mark(),
            () => this.view.header,
            () => connection.snapshot?.scene.bake_error,
        );
        this.zoom = new ImageZoom(
            byId("stage"),
            byId("image-frame"),
            () => this.view.header?.width ?? 0,
            (words) => this.readouts.setZoom(words),
            () => movingBounds(connection) === null,
        );
        this.camera = new CameraPanel(
            byId("camera-card"),
            byId("camera-controls"),
            byId("camera-views"),
            connection,
        );
        // With Alt the light is turned as elsewhere; with Ctrl the page zooms.
        new CameraHand(
            byId("image-frame"),
            connection,
            (event) => event.altKey || event.ctrlKey,
        );
        this.materials = new Materials(connection);
        this.materialPanel = new MaterialPanel(
            byId("materials-card"),
            connection,
            this.materials,
        );
        new MaterialPicker(byId("image-frame"), api, connection, this.materials);
        this.finishes = new Finishes(connection);
        new FinishPanel(byId("finishes-card"), connection, this.finishes);
        const uploads = new UploadStore(place.server);
        this.lightReturn = new LightReturn(connection, api, uploads, notices, () =>
            this.loadEnvironments(),
        );
        this.listenForFiles(uploads);
        listenOnImage(byId("image-frame"), connection, this.exposure);
        this.listenToConnection();
        this.listenToDecoder();
    }

    start(): void {
        this.connection.connect();
    }

    get inspection(): Inspection {
        return inspect(
            this.connection,
            this.view,
            () => this.isExact,
            () => this.exposure.display,
        );
    }

    async loadEnvironments(): Promise<void> {
        try {
            const entries = await this.api.environments();
            this.previews.setEntries(entries);
            this.environments.show(entries);
            this.environmentPanel.setEnvironments(entries);
        } catch (error) {
            const title = error instanceof Error ? error.message : String(error);
            this.notices.show({ tone: "error", title: `Environments: ${title}` });
        }
    }

    private async loadMaterials(): Promise<void> {
        try {
            this.finishes.setOffer(await this.api.materials());
        } catch (error) {
            const title = error instanceof Error ? error.message : String(error);
            this.notices.show({ tone: "error", title: `Materials: ${title}` });
        }
    }

    private get isExact(): boolean {
        const { header } = this.view;
        return (
            this.connection.status.kind === "open" &&
            header !== null &&
            header.exact &&
            this.view.settled !== null &&
            header.revision >= this.connection.imageRevision &&
            this.connection.isSettled
        );
    }

    private mark(): MarkKind {
        if (this.connection.status.kind !== "open") return "offline";
        if (this.isExact) return "exact";
        const { header, settled } = this.view;
        if (header === null) return "waiting";
        const isCurrent =
            header.revision >= this.connection.imageRevision && !this.connection.awaitsImage;
        if (settled !== null && isCurrent) return header.exact ? "exact" : "settled";
        return performance.now() - this.movedAt < kMovingMilliseconds ? "moving" : "converging";
    }

    /** A JPEG of light that already shows settled would be a step back. */
    private isWanted(header: ImageHeader): boolean {
        const { settled } = this.view;
        const { imageRevision, revision } = this.connection;
        return !(
            header.encoding === kEncodingJpeg &&
            settled !== null &&
            settled.header.revision >= imageRevision &&
            header.revision <= revision
        );
    }

    private listenToConnection(): void {
        const { connection } = this;
        connection.opened.listen(({ snapshot: { scene, room }, forgotten }) => {
            byId("stage").dataset["camera"] = String(movingBounds(connection) !== null);
            this.showWhatIsEdited();
            this.decoder.clear();
            this.timer.clear();
            this.readouts.clear();
            this.knownRevision = connection.revision;
            this.view.forget();
            setText(byId("room-name"), room);
            document.title = `${scene.name} – Relume`;
            void this.loadEnvironments();
            if (this.finishes.isTaken) void this.loadMaterials();
            if (forgotten !== null) this.lightReturn.offer(wholeLightingOf(forgotten));
        });
        connection.stateChanged.listen((state) => {
            if (connection.isSettled) this.lightReturn.roomChanged(state);
            if (connection.imageRevision !== this.knownRevision || !connection.isSettled) {
                this.knownRevision = connection.imageRevision;
                this.movedAt = performance.now();
            }
            this.readouts.refreshImage();
        });
        // A map that is named again may be another one of that name.
        connection.changed.listen((patch) => {
            const named = [patch["environment"], patch["blend"]].map((section) =>
                isObject(section) ? section["name"] : undefined,
            );
            const maps = named.filter((name): name is string => typeof name === "string");
            for (const name of maps) this.previews.forget(name);
            if (maps.length > 0) void this.loadEnvironments();
        });
        connection.statusChanged.listen(({ kind }) => {
            byId("stage").dataset["status"] = kind;
            this.readouts.refreshImage();
        });
        connection.viewersChanged.listen((count) => setText(byId("viewers"), String(count)));
        connection.frameReceived.listen((frame) => {
            const header = this.decoder.take(frame);
            this.readouts.frameReceived(header, frame.byteLength, performance.now());
        });
        connection.refused.listen((refusal) => {
            const { path, found, expected } = refusal;
            const title =
                path === undefined ? titleOf(refusal) : `${path}: ${titleOf(refusal)}`;
            this.notices.show({ tone: "error", title, found, expected });
        });
        connection.editSent.listen(({ id, patch }) => {
            // After an edit of display or policy no image has to come.
            if (makesAnotherImage(patch)) this.timer.editSent(id, performance.now());
        });
        connection.editConfirmed.listen(({ id, revision }) =>
            this.timer.editConfirmed(id, revision),
        );
        connection.editDropped.listen((id) => this.timer.editDropped(id));
    }

    /** Panels of what the scene does not let people edit are not there. */
    private showWhatIsEdited(): void {
        const materials = editsMaterials(this.connection);
        const light = this.connection.takes("environment");
        document.body.classList.toggle("edits-materials", materials && !light);
        byId("materials-card").hidden = !materials;
        byId("finishes-card").hidden = !this.finishes.isTaken;
        for (const id of ["environment-panel", "light-card"]) {
            byId(id).hidden = !light;
        }
    }

    private listenForFiles(uploads: UploadStore): void {
        const elements = {
            button: byId<HTMLButtonElement>("upload-button"),
            input: byId<HTMLInputElement>("upload-input"),
            dropVeil: byId("drop-veil"),
        };
        new Upload(elements, this.api, this.connection, uploads, this.notices, {
            uploaded: async ({ name }) => {
                this.previews.forget(name);
                await this.loadEnvironments();
                this.environments.choose(name);
                this.lightReturn.mapArrived(name);
            },
            lightingRead: (lighting) => this.takeLighting(lighting),
        });
    }

    /** The display in a file is for whoever brought it, not for the room. */
    private async takeLighting({ display, ...light }: Lighting): Promise<void> {
        if (display !== undefined) this.exposure.set(display);
        if (await this.lightReturn.bring(light)) {
            this.notices.show({ tone: "info", title: "The room is lit as the file says" });
        }
    }

    private listenToDecoder(): void {
        this.decoder.decoded.listen((image) => {
            this.view.show(image);
            this.zoom.apply();
            this.timer.imageShown(image.header.revision, performance.now());
            this.readouts.refreshImage();
        });
        this.decoder.failed.listen((title) => this.notices.show({ tone: "error", title }));
    }
}
