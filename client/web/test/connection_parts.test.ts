import { describe, expect, it } from "vitest";
import { Backoff } from "../src/backoff";
import { EditTimer } from "../src/edit_timer";
import { amountText, bakeErrorText, bytesText, percentText, stopsText } from "../src/format";
import {
    defaultRoom,
    nameFromText,
    placeFromAddress,
    PlaceError,
    connectionAddress,
    subprotocols,
} from "../src/place";
import { RateMeter } from "../src/rate_meter";
import { closeMeaning } from "../src/wire/close_code";
import { messageFromText, WireError } from "../src/wire/message";

describe("Backoff", () => {
    it("grows to its ceiling, with jitter in its upper half", () => {
        const least = new Backoff(() => 0);
        const most = new Backoff(() => 1);
        let previous = 0;
        for (let i = 0; i < 40; ++i) {
            const [low, high] = [least.next(), most.next()];
            expect(low).toBe(high / 2);
            expect(high).toBeGreaterThanOrEqual(previous);
            expect(high).toBeLessThanOrEqual(10_000);
            previous = high;
        }
        expect(previous).toBe(10_000);
        most.reset();
        expect(most.next()).toBeLessThan(1000);
    });
});

describe("closeMeaning", () => {
    it("gives up where trying again cannot help", () => {
        for (const code of [1003, 4001, 4004]) expect(closeMeaning(code).retry).toBe("never");
        for (const code of [4003, 4007]) expect(closeMeaning(code).retry).toBe("later");
        for (const code of [1000, 1001, 1006, 4002, 4005, 4006, 4999]) {
            expect(closeMeaning(code).retry).toBe("soon");
        }
    });
});

describe("EditTimer", () => {
    it("measures from sending to the first image that holds the edit", () => {
        const timer = new EditTimer();
        timer.imageShown(4, 90);
        timer.editSent(1, 100);
        timer.imageShown(5, 105);
        timer.editConfirmed(1, 6);
        expect(timer.latestMilliseconds).toBeNull();
        timer.imageShown(6, 120);
        expect(timer.latestMilliseconds).toBe(20);
    });

    it("counts an image that overtook the confirmation", () => {
        const timer = new EditTimer();
        timer.editSent(1, 100);
        timer.imageShown(7, 112);
        timer.editConfirmed(1, 7);
        expect(timer.latestMilliseconds).toBe(12);
    });

    it("counts every edit of those taken together, and none that was refused", () => {
        const timer = new EditTimer();
        for (const id of [1, 2, 3]) timer.editSent(id, 100 * id);
        timer.editDropped(2);
        timer.editConfirmed(3, 9);
        timer.imageShown(9, 310);
        expect(timer.latestMilliseconds).toBe(10);
        expect(timer.medianMilliseconds).toBe(210);
    });
});

describe("RateMeter", () => {
    it("forgets after a second", () => {
        const meter = new RateMeter();
        for (const at of [0, 400, 900]) meter.add(at, 10);
        expect(meter.read(950)).toEqual({ count: 3, amount: 30 });
        expect(meter.read(1500)).toEqual({ count: 1, amount: 10 });
        expect(meter.read(5000)).toEqual({ count: 0, amount: 0 });
    });
});

describe("place", () => {
    const at = (address: string) => placeFromAddress(new URL(address));

    it("takes what the address names, and nothing else", () => {
        const bare = at("https://studio.test/");
        expect(bare).toEqual({
            server: "https://studio.test",
            scene: null,
            room: null,
            token: null,
            mayUseGl: true,
        });
        expect(at("http://a.test/?token=a#token=b%26").token).toBe("b&");
        const full = at("http://a.test/?server=b.test:81&scene=table&room=r1&token=t%26");
        expect(full.server).toBe("http://b.test:81");
        expect(connectionAddress(full, "table", "r1")).toBe(
            "ws://b.test:81/session/r1?scene=table",
        );
        expect(subprotocols(full)).toEqual(["relume.v1", "relume.token.dCY"]);
        expect(subprotocols({ ...full, token: "§?>" })[1]).toBe("relume.token.wqc_Pg");
        expect(subprotocols(bare)).toEqual(["relume.v1"]);
        expect(connectionAddress(bare, "box", defaultRoom("box"))).toBe(
            "wss://studio.test/session/studio-box?scene=box",
        );
    });

    it.each(["?scene=a/b", "?room=%20", "?server=javascript:alert(1)", "?room=.x"])(
        "refuses %s",
        (query) => expect(() => at(`http://a.test/${query}`)).toThrow(PlaceError),
    );

    it("makes a name of a file name", () => {
        expect(nameFromText("Été à la mer (4k)")).toBe("Ete-a-la-mer-4k");
        expect(nameFromText("..")).toBe("");
        expect(nameFromText("x".repeat(99))).toHaveLength(64);
    });
});

describe("messages", () => {
    it("refuses malformed ones and skips unknown ones", () => {
        for (const text of [
            "",
            "[]",
            "{}",
            '{"type":"change"}',
            '{"type":"viewers","count":"2"}',
        ]) {
            expect(() => messageFromText(text)).toThrow(WireError);
        }
        expect(messageFromText('{"type":"weather"}')).toBeNull();
    });

    it("reads what the bake says of its error, where it does", () => {
        const scene = { name: "s", width: 1, height: 1, face_resolution: 4 };
        const rest = { room: "r", revision: 0, state: {}, viewers: 1, limits: {} };
        const snapshot = (more: object) =>
            messageFromText(
                JSON.stringify({
                    type: "snapshot",
                    protocol: 1,
                    scene: { ...scene, ...more },
                    ...rest,
                }),
            );
        expect(snapshot({ bake_error: 0.008 })).toMatchObject({ scene: { bake_error: 0.008 } });
        expect(snapshot({})).toMatchObject({ scene });
        const moving = {
            edits: ["environment", "camera", "image"],
            bounds: { centre: [1, 2, 3], radius: 4 },
            camera: { eye: [5, 6, 7], look_at: [1, 2, 3], up: [0, 1, 0], fov_degrees: 40 },
        };
        expect(snapshot(moving)).toMatchObject({ scene: moving });
        expect(() => snapshot({ bounds: { centre: [1, 2], radius: 4 } })).toThrow("centre");
        expect(bakeErrorText(0.008)).toBe("bake ± 0.8 %");
        expect(bakeErrorText(undefined)).toBe("");
    });

    it("refuses another protocol", () => {
        expect(() => messageFromText('{"type":"snapshot","protocol":2}')).toThrow(/protocol 2/);
    });

    it("reads an error of which only code and message are sure", () => {
        expect(messageFromText('{"type":"error","code":"c","message":"m","found":3}')).toEqual({
            type: "error",
            code: "c",
            message: "m",
            found: "3",
        });
    });
});

describe("figures", () => {
    it.each([
        [0, "0"],
        [1.5, "150 %"],
        [0.123, "12.3 %"],
        [0.0041, "0.41 %"],
        [1e-4, "0.01 %"],
        [2.5e-6, "2.5·10⁻⁶"],
    ])("%f is %s", (value, text) => expect(percentText(value)).toBe(text));

    it("writes bytes, stops and amounts", () => {
        expect(bytesText(999)).toBe("999 B");
        expect(bytesText(1_540_000)).toBe("1.5 MB");
        expect(stopsText(-0.25)).toBe("−0.25");
        expect(amountText(40.04)).toBe("40");
        expect(amountText(12345)).toBe("12\u202f345");
    });
});
