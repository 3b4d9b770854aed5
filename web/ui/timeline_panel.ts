import type { KeptKeys } from "./address.ts";
import { download } from "./download.ts";
import { enable, filePicker, h, mark, section, setText, toggle } from "./dom.ts";
import type { Ghosts } from "./ghosts.ts";
import { KeyPictures, type Pictured } from "./key_pictures.ts";
import type { Stage } from "./stage.ts";
import { EASINGS, Timeline, type Easing } from "./timeline.ts";
import { continuedTimeline, readTimeline, timelineFile, timelineOf, type States } from "./timeline_file.ts";

/** What a timeline moves. */
export interface Animated<State> extends Pictured<State> {
  readonly name: string;
  readonly states: States<State>;
  /** Names of the handles, for a model that has some. */
  readonly handles?: readonly string[];
  /** Keys from before a reload, and those for the next one; null if a reload shows another model. */
  readonly kept: KeptKeys | null;
  /** The present state. */
  state(): State;
  /** Asks for a state, which is solved for before the next picture. */
  show(state: State): void;
  /** After playing or a jump: the state stays, as after a drag. */
  settle(): void;
  /** Shapes of neighbouring keys, for onion skinning. */
  readonly ghosts: Ghosts;
}

/** Seconds between a key and the next new one, and the least time that the track shows. */
const [GAP, LEAST] = [1, 3];
const LONGEST_FRAME = 0.1; // seconds: after a pause of the browser the film continues where it was

/** Keys of poses or blends with small pictures, played by solving every frame. */
export class TimelinePanel<State> {
  readonly element: HTMLElement;
  readonly #stage: Stage;
  readonly #animated: Animated<State>;
  #states: States<State>;
  #timeline = new Timeline<State>();
  #time = 0;
  #isPlaying = false;
  #onion = false;
  readonly #pictures: KeyPictures<State>;
  readonly #play = toggle("Play keys", "Solves and shows every frame; P", false, (on) => this.play(on));
  readonly #add = h(
    "button",
    { type: "button", title: "K", id: "add-key", onclick: () => this.add() },
    "Add key",
  );
  readonly #clock = h("output", {});
  readonly #track = h("input", { type: "range", min: 0, step: "any", "aria-label": "Time" });
  readonly #keys = h("div", { className: "keys", role: "group", "aria-label": "Keys" });
  readonly #when = h("input", { type: "number", min: 0, step: 0.1, required: true });
  readonly #easing = h("select", {}, ...EASINGS.map((easing) => h("option", { value: easing }, easing)));
  readonly #remove = h("button", { type: "button", onclick: () => this.#delete() }, "Delete");
  readonly #loop = toggle("Loop", "Plays again and again", false, (on) =>
    this.#take(this.#timeline.looping(on)),
  );
  readonly #save = h("button", { type: "button", onclick: () => this.#give() }, "Save keys");
  readonly #selected = h("div", { className: "row picture-size" });
  readonly #fault = h("p", { className: "hint", role: "status" });

  constructor(stage: Stage, animated: Animated<State>) {
    [this.#stage, this.#animated, this.#states] = [stage, animated, animated.states];
    this.#pictures = new KeyPictures(stage, animated, (state, picture) => {
      const key = this.states.indexOf(state);
      this.#keys.children[key].prepend(imageOf(picture));
    });
    this.#play.id = "play-keys";
    const onion = toggle("Onion skin", "The keys before and after, pale", false, (on) => {
      this.#onion = on;
      this.skin();
    });
    this.#when.setAttribute("aria-label", "Time of the key in seconds");
    this.#easing.setAttribute("aria-label", "How the next key is approached");
    this.#track.addEventListener("input", () => {
      this.play(false);
      this.#go(this.#track.valueAsNumber);
    });
    this.#track.addEventListener("change", () => animated.settle());
    this.#when.addEventListener("change", () => this.#reschedule());
    this.#easing.addEventListener("change", () => {
      const key = this.#timeline.find(this.#time);
      if (key >= 0) this.#take(this.#timeline.eased(key, this.#easing.value as Easing));
    });
    this.#selected.append(this.#when, h("span", {}, "s"), this.#easing, this.#remove);
    this.element = section(
      "Timeline",
      h("div", { className: "row" }, this.#play, this.#add),
      h("label", { className: "slider" }, h("span", {}, "Time"), this.#clock, this.#track),
      this.#keys,
      this.#selected,
      h("div", { className: "row" }, this.#loop, onion),
      h(
        "div",
        { className: "row" },
        this.#save,
        filePicker("Open keys…", ".json", (file) => void this.#open(file)),
      ),
      this.#fault,
    );
    this.#show();
  }

  /** The content of a file; null without keys. */
  get content(): string | null {
    return this.#timeline.keys.length > 0 ? timelineFile(this.#timeline, this.#states) : null;
  }

  /** Continues with states of another kind, for instance of more handles, which `other` makes of those before. */
  become(states: States<State>, other: (state: State) => State): void {
    this.#states = states;
    for (const state of this.states) this.#pictures.become(state, other(state));
    this.#take(this.#timeline.map(other));
  }

  /** Restores the keys from before another view or a reload, else the timeline that the model came with; the shape
   * stays. */
  begin(before: string | null | undefined, own: unknown): void {
    const { kept, handles = [] } = this.#animated;
    const text = before ?? kept?.keys;
    if (!text && own === undefined) return;
    try {
      const { timeline, lost } = text
        ? continuedTimeline(text, this.#states, handles)
        : { timeline: timelineOf(own, this.#states), lost: [] };
      this.#timeline = timeline; // kept for a reload once it is changed
      this.#time = timeline.end; // the next key comes after the last one
      this.#show();
      if (lost.length > 0) this.#fault.textContent = `Keys no longer move ${lost.join(", ")}.`;
    } catch (error) {
      this.#fault.textContent = (error as Error).message;
    }
  }

  /** The states of all keys. */
  get states(): State[] {
    return this.#timeline.keys.map(({ state }) => state);
  }

  get isPlaying(): boolean {
    return this.#isPlaying;
  }

  /** For scripts and tests. */
  get timeline(): Timeline<State> {
    return this.#timeline;
  }

  get time(): number {
    return this.#time;
  }

  /** Starts, from the first key if the film was at its end, or stops. */
  play(on: boolean): void {
    if (on === this.#isPlaying || (on && this.#timeline.keys.length < 2)) {
      mark(this.#play, "aria-pressed", this.#isPlaying);
      return;
    }
    this.#isPlaying = on;
    mark(this.#play, "aria-pressed", on);
    if (on && this.#time >= this.#timeline.end) this.#time = this.#timeline.keys[0].time;
    if (!on) this.#animated.settle();
    this.skin();
    this.#stage.draw();
  }

  /** Before a picture: moves on in time. */
  advance(seconds: number): void {
    if (!this.#isPlaying) return;
    const [first, end] = [this.#timeline.keys[0].time, this.#timeline.end];
    let time = this.#time + Math.min(seconds, LONGEST_FRAME);
    if (time >= end) time = this.#timeline.loop ? first + ((time - first) % (end - first)) : end;
    this.#go(time);
    if (time === end) this.play(false);
  }

  /** The present state becomes a key: in place of the one at this time, or a second after the last. */
  add(): void {
    this.play(false);
    const { keys, end } = this.#timeline;
    const isNew = keys.length > 0 && this.#timeline.find(this.#time) < 0 && this.#time > end;
    const time = keys.length === 0 ? 0 : isNew || this.#time < end ? this.#time : end + GAP;
    const state = this.#animated.state();
    this.#pictures.take(state);
    this.#time = time;
    this.#take(this.#timeline.with(time, state));
  }

  dispose(): void {
    this.#pictures.dispose();
    this.#animated.ghosts.clear();
  }

  #delete(): void {
    const key = this.#timeline.find(this.#time);
    if (key < 0) return;
    this.#take(this.#timeline.without(key));
    // Delete, which had the focus, is hidden now
    const { children } = this.#keys;
    ((children[Math.min(key, children.length - 1)] as HTMLElement | undefined) ?? this.#add).focus();
  }

  #reschedule(): void {
    const key = this.#timeline.find(this.#time);
    if (key < 0) return;
    if (!this.#when.validity.valid) return this.#showTime(); // the number that was refused goes
    const moved = this.#timeline.moved(key, this.#when.valueAsNumber);
    if (moved !== this.#timeline) this.#time = this.#when.valueAsNumber;
    this.#take(moved);
  }

  #take(timeline: Timeline<State>): void {
    this.#timeline = timeline;
    const { kept } = this.#animated;
    if (kept) kept.keys = this.content;
    this.#show();
  }

  /** Goes to a time; `isJump` as for a click on a key. */
  #go(time: number, isJump = false): void {
    this.#time = time;
    const between = this.#timeline.at(time);
    if (between) {
      const { from, to, share } = between;
      this.#animated.show(share === 0 ? from : this.#states.between(from, to, share));
    }
    if (isJump) this.#animated.settle();
    this.#showTime();
    this.skin();
  }

  /** Shows the keys next to the present time, where that is wanted. */
  skin(): void {
    const { keys } = this.#timeline;
    const { ghosts } = this.#animated;
    if (!this.#onion || this.#isPlaying || keys.length === 0) return ghosts.show([]);
    const before = keys.findLast((key) => key.time < this.#time - 1e-3);
    const after = keys.find((key) => key.time > this.#time + 1e-3);
    const beside = [before, after].filter((key) => key !== undefined).map(({ state }) => state);
    ghosts.show(this.#animated.shapes(beside));
  }

  #show(): void {
    const { keys, loop, end } = this.#timeline;
    this.#track.max = String(Math.max(end, LEAST));
    mark(this.#loop, "aria-pressed", loop);
    enable(this.#play, keys.length > 1);
    enable(this.#save, keys.length > 0);
    this.#keys.replaceChildren(
      ...keys.map(({ time, state }) => {
        const picture = this.#pictures.of(state);
        const image = picture ? [imageOf(picture)] : [];
        const act = () => {
          this.play(false);
          this.#go(time, true);
        };
        return h("button", { type: "button", className: "key", onclick: act }, ...image, seconds(time));
      }),
    );
    this.#pictures.want(this.states);
    this.#showTime();
    this.skin();
  }

  #showTime(): void {
    setText(this.#clock, seconds(this.#time));
    this.#track.value = String(this.#time);
    this.#track.ariaValueText = seconds(this.#time);
    const at = this.#timeline.find(this.#time);
    [...this.#keys.children].forEach((key, k) => mark(key as HTMLElement, "aria-current", k === at));
    if (this.#selected.hidden !== at < 0) this.#selected.hidden = at < 0;
    if (at < 0 || this.#isPlaying) return;
    const { time, easing } = this.#timeline.keys[at];
    this.#when.value = String(Number(time.toFixed(3)));
    this.#easing.value = easing;
  }

  #give(): void {
    const name = `${this.#animated.name || "snapspace"}.timeline.json`;
    download(timelineFile(this.#timeline, this.#states), name, "application/json");
    this.#fault.textContent = `${name} is in your downloads; snapspace animate takes it.`;
  }

  async #open(file: File): Promise<void> {
    try {
      const timeline = readTimeline(await file.text(), this.#states);
      this.play(false);
      this.#time = timeline.keys[0].time;
      this.#take(timeline);
      this.#go(this.#time, true);
      this.#fault.textContent = `${timeline.keys.length} keys from ${file.name}.`;
    } catch (error) {
      this.#fault.textContent = (error as Error).message;
    }
  }
}

const imageOf = (src: string) => h("img", { src, alt: "", draggable: false });
const seconds = (time: number) => `${time.toFixed(time >= 10 ? 1 : 2)} s`;
