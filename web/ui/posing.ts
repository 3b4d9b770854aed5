import type { Dynamics, FrameReport, Motion, PosingSession } from "../engine/index.ts";
import type { Continued } from "./continued.ts";
import { HandlePaint } from "./handle_paint.ts";
import { carriedOver, ShapeTransition } from "./shape_transition.ts";
import { History } from "./history.ts";
import { Jiggle } from "./jiggle.ts";
import { approach, areSame } from "./motion_parts.ts";
import type { Pulled } from "./pulling.ts";
import { Snapping } from "./snapping.ts";
import type { Stage } from "./stage.ts";
import type { Surface } from "./surface.ts";

export type Mode = "move" | "turn" | "pull";

/** The state of posing: the motions that are asked for, the selection, and the history.
 *
 * Wishes are collected and solved once before the next picture. */
export class Posing {
  readonly stage: Stage;
  mode: Mode = "move";
  /** After each solve, many times a second in a drag. */
  onSolved: (report: FrameReport) => void = () => {};
  /** After the end of a drag, after undo, and when a swing or a transition has come to rest. */
  onReleased: () => void = () => {};
  /** Before an edit that is no drag: ends a film, which would overwrite it. */
  beforeEdit: () => void = () => {};
  /** After selection, mode or history have changed. */
  onChange: () => void = () => {};
  #session: PosingSession;
  #surface: Surface;
  #selected = -1;
  #paint: HandlePaint;
  readonly #wishes = new Map<number, Motion>();
  /** Steps in time; static frames while it is off. */
  readonly jiggle: Jiggle;
  /** Rounds what drags ask for. */
  readonly snapping: Snapping;
  /** Whether arrows and rings are along the handle's own axes, else along those of the model. */
  isLocal = false;
  /** What pulls on points of the surface. */
  pulled: Pulled | null = null;
  #isPulledAnew = false;
  #history: History<readonly Motion[]>;
  /** Where the handles were when the present drag began. */
  #beforeDrag: readonly Motion[] | null = null;
  #isCancelled = false;
  /** The transition from the shape of the model before. */
  #transition: ShapeTransition | null = null;

  constructor(stage: Stage, session: PosingSession, surface: Surface) {
    this.stage = stage;
    this.#session = session;
    this.#surface = surface;
    this.#paint = new HandlePaint(surface, session.model, -1);
    this.#history = new History<readonly Motion[]>(this.motions, areSame);
    this.snapping = new Snapping(session.model.diagonal);
    this.jiggle = new Jiggle({
      step: (dt, dynamics) => this.#step(dt, dynamics),
      settle: () => this.session.solve(),
      speed: () => this.session.speed,
    });
    this.#show();
  }

  get session(): PosingSession {
    return this.#session;
  }

  get surface(): Surface {
    return this.#surface;
  }

  /** Continues with another model of these handles and perhaps more: motions, selection and history stay.
   *
   * The shape moves smoothly to that of the new model, if this knows the modes of the one before. */
  replace(session: PosingSession, surface: Surface, { motions, all, pulled }: Continued): void {
    const [shown, { fromBefore }] = [this.#shown, session.model];
    [this.#session, this.#surface, this.pulled] = [session, surface, pulled];
    this.#history.map(all);
    this.#beforeDrag &&= all(this.#beforeDrag);
    this.#paint = new HandlePaint(surface, session.model, this.#selected);
    this.#transition = null;
    const own = approach(session, motions);
    if (pulled) pulled.q = session.q;
    this.#solved(own);
    const isKnown = fromBefore?.length === session.q.length * shown.length;
    this.#comeFrom(isKnown ? carriedOver(fromBefore, shown) : this.#shown);
    this.#show();
    this.onChange();
  }

  /** Begins with the handles at motions. */
  begin(motions: readonly Motion[]): void {
    this.#solved(approach(this.session, motions));
    this.#history = new History<readonly Motion[]>(this.motions, areSame);
    this.#comeFrom(this.session.q);
    this.onChange();
  }

  /** Motions of all handles, from rest. */
  get motions(): Motion[] {
    return this.session.model.handles.map((_, handle) => this.session.motion(handle));
  }

  /** The steps of undo. */
  get history(): Pick<History<readonly Motion[]>, "states" | "canUndo" | "canRedo"> {
    return this.#history;
  }

  get selected(): number {
    return this.#selected;
  }

  select(handle: number): void {
    if (handle === this.#selected) return;
    const before = this.#selected;
    this.#selected = handle;
    for (const changed of [before, handle]) if (changed >= 0) this.#paint.paint(changed, changed === handle);
    this.onChange();
    this.stage.draw();
  }

  setMode(mode: Mode): void {
    this.mode = mode;
    this.onChange();
    this.stage.draw();
  }

  /** Asks for a motion of a handle; it is solved for before the next picture. */
  wish(handle: number, motion: Motion): void {
    if (this.#isCancelled) return; // the pointer still moves, the drag is over
    this.#wishes.set(handle, motion);
    this.stage.draw();
  }

  /** Moves handles at once, as a step of undo. */
  edit(motions: Iterable<readonly [number, Motion]>): void {
    this.beforeEdit();
    for (const [handle, motion] of motions) this.wish(handle, motion);
    this.commit();
  }

  /** What a drag from `start` asks for, rounded if that is switched on. */
  snapped(start: Motion, asked: Motion): Motion {
    return this.snapping.rounded(start, asked, this.isLocal);
  }

  /** The motion that is asked for, or the present one. */
  motion(handle: number): Motion {
    return this.#wishes.get(handle) ?? this.session.motion(handle);
  }

  /** Solves for what was asked since the last time. */
  solveWishes(): void {
    if (this.#wishes.size === 0 && !this.#isPulledAnew) return;
    if (this.jiggle.isOn && !this.pulled) {
      this.jiggle.wake();
      return;
    }
    this.#isPulledAnew = false;
    const report = this.session.moveAll(this.#wishes);
    this.#wishes.clear();
    this.#solved(report);
  }

  /** Sets the points that are pulled. Without any, the shape goes back to that of the handles, or swings. */
  pull(pulled: Pulled | null): void {
    const before = this.pulled?.q;
    [this.pulled, this.#isPulledAnew] = [pulled, true];
    if (before && !pulled && this.jiggle.isOn) {
      this.session.restore(this.motions, before);
      this.jiggle.wake();
    } else if (before && !pulled) this.#comeFrom(before);
    this.stage.draw();
  }

  /** Before each picture: swings, and shows the next step of the transition from the model before. */
  advance(seconds: number): void {
    const wasOnTheWay = this.isOnTheWay;
    const report = this.jiggle.advance(seconds);
    if (report) this.#solved(report);
    if (this.#transition) {
      this.#transition.advance(seconds);
      if (this.#transition.isOver) this.#transition = null;
      this.#show();
    }
    if (wasOnTheWay && !this.isOnTheWay && !this.isDragging) this.onReleased();
  }

  /** Whether a swing or a transition needs more pictures. */
  get isOnTheWay(): boolean {
    return this.#transition !== null || this.jiggle.moves;
  }

  /** Begins a drag: until its end there is no undo, and it can be cancelled. */
  grab(): void {
    this.#beforeDrag = this.motions;
    this.#isCancelled = false;
  }

  get isDragging(): boolean {
    return this.#beforeDrag !== null;
  }

  /** Cancels a drag: the pointer has no effect until it is released. */
  cancelDrag(): void {
    const before = this.#beforeDrag;
    if (!before || this.#isCancelled) return;
    this.#goTo(before);
    this.#isCancelled = true;
  }

  /** Ends a drag in which nothing moved. */
  release(): void {
    this.#beforeDrag = null;
    this.#isCancelled = false;
  }

  /** Ends a drag: a step of undo. */
  commit(): void {
    const isCancelled = this.#isCancelled;
    this.release();
    if (isCancelled) return this.onReleased();
    this.solveWishes();
    this.#history.push(this.session.model.handles.map((_, handle) => this.motion(handle)));
    this.onChange();
    this.onReleased();
  }

  undo(): void {
    if (this.isDragging) return;
    this.beforeEdit();
    this.#goTo(this.#history.undo());
  }

  redo(): void {
    if (this.isDragging) return;
    this.beforeEdit();
    this.#goTo(this.#history.redo());
  }

  reset(): void {
    if (this.isDragging) return;
    this.beforeEdit();
    this.#wishes.clear();
    this.session.reset();
    this.#history.push(this.motions);
    this.#jumped(this.session.solve());
  }

  set dimension(dimension: number) {
    this.session.dimension = dimension;
    this.#solved(this.session.solve());
  }

  /** One step in time, in which the handles come to where they are asked to be. */
  #step(dt: number, dynamics: Dynamics): FrameReport {
    this.session.time.dynamics = dynamics;
    const report = this.session.step(dt, this.#wishes);
    this.#wishes.clear();
    return report;
  }

  #goTo(motions: readonly Motion[] | undefined): void {
    if (!motions) return;
    this.#wishes.clear();
    this.#jumped(this.session.moveAll(new Map(motions.entries())));
  }

  /** After a solve for other motions than those that were dragged. */
  #jumped(report: FrameReport): void {
    this.#solved(report);
    if (this.jiggle.isHeavy) this.jiggle.wake(); // solves ignore gravity
    this.onChange();
    this.onReleased();
  }

  #solved(own: FrameReport): void {
    const report = this.pulled?.solve() ?? own;
    this.#show();
    this.onSolved(report);
    this.stage.draw();
  }

  /** Begins a transition, after which the shape is at rest. */
  #comeFrom(q: Float64Array): void {
    this.#transition = new ShapeTransition(q, this.pulled?.q ?? this.session.q);
  }

  /** Coordinates of the shape that is shown. */
  get #shown(): Float64Array {
    const q = this.pulled?.q ?? this.session.q;
    return this.#transition?.at(q) ?? q;
  }

  #show(): void {
    this.surface.show(this.#shown);
    this.surface.carry(this.session.carriedBy);
  }
}
