// SPDX-License-Identifier: MIT
// Keys, a gamepad, a stick under the thumb, and the mouse that turns the view: all at once.

const TURNING = 1.9; // rad/s
const BY_MOUSE = 0.006; // rad a pixel
const DEAD = 0.12, WALK = 0.5; // of a stick's way
const KEYS = { KeyW: [0, 1], ArrowUp: [0, 1], KeyS: [0, -1], ArrowDown: [0, -1], KeyA: [-1, 0], ArrowLeft: [-1, 0], KeyD: [1, 0], ArrowRight: [1, 0] };
const JUMP_BUTTON = 0, FIRST_MOVE_BUTTON = 1; // of a gamepad

export class Controls {
  constructor(canvas) {
    this.held = new Set();
    this.thumb = [0, 0];
    this.isJumpTouched = false;
    this.dragged = [0, 0];
    this.pointer = [0, 0]; // in the window
    this.#hearKeys();
    this.#hearThumb(document.getElementById("stick"), document.getElementById("jump"));
    this.#hearMouse(canvas);
  }

  #hearKeys() {
    addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      this.held.add(event.code);
      if (event.code === "Space" || event.code.startsWith("Arrow")) event.preventDefault();
    });
    addEventListener("keyup", (event) => this.held.delete(event.code));
    addEventListener("blur", () => this.held.clear());
  }

  #hearThumb(stick, jump) {
    const knob = stick.firstElementChild;
    const put = (x, y) => {
      const length = Math.max(1, Math.hypot(x, y));
      this.thumb = [x / length, -y / length];
      knob.style.transform = `translate(${this.thumb[0] * 40}px, ${-this.thumb[1] * 40}px)`;
    };
    stick.addEventListener("pointerdown", (event) => stick.setPointerCapture(event.pointerId));
    stick.addEventListener("pointermove", (event) => {
      if (!stick.hasPointerCapture(event.pointerId)) return;
      const { left, top, width } = stick.getBoundingClientRect(), half = width / 2;
      put((event.clientX - left - half) / half, (event.clientY - top - half) / half);
    });
    for (const end of ["pointerup", "pointercancel"]) stick.addEventListener(end, () => put(0, 0));
    jump.addEventListener("pointerdown", () => (this.isJumpTouched = true));
    for (const end of ["pointerup", "pointercancel", "pointerleave"]) jump.addEventListener(end, () => (this.isJumpTouched = false));
  }

  #hearMouse(canvas) {
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      this.pointer = [event.clientX, event.clientY];
      if (!canvas.hasPointerCapture(event.pointerId) || document.body.classList.contains("drawing")) return;
      this.dragged[0] += event.movementX;
      this.dragged[1] += event.movementY;
    });
  }

  #pad() {
    return navigator.getGamepads?.().find((pad) => pad?.connected && pad.mapping === "standard");
  }

  #keys() {
    let x = 0, y = 0;
    for (const code of this.held) {
      x += KEYS[code]?.[0] ?? 0;
      y += KEYS[code]?.[1] ?? 0;
    }
    const reach = this.held.has("ShiftLeft") || this.held.has("ShiftRight") ? 1 : WALK;
    const length = Math.hypot(x, y) || 1;
    return [(reach * x) / length, (reach * y) / length];
  }

  /** To the right and up, within the unit circle. */
  stick() {
    const pad = this.#pad(), given = [this.#keys(), this.thumb, pad ? [pad.axes[0], -pad.axes[1]] : [0, 0]];
    const [x, y] = given.reduce((far, each) => (Math.hypot(...each) > Math.hypot(...far) ? each : far));
    const length = Math.hypot(x, y);
    return length < DEAD ? [0, 0] : [x / Math.max(1, length), y / Math.max(1, length)];
  }

  isPushed() {
    return Math.hypot(...this.stick()) > 0;
  }

  /** What a player is told: the stick, as the camera sees it. */
  read(facing) {
    const jump = this.held.has("Space") || this.isJumpTouched || !!this.#pad()?.buttons[JUMP_BUTTON]?.pressed;
    return { steer: "camera", move: this.stick(), facing, jump };
  }

  /** The moves whose key or gamepad's button is held. */
  heldMoves(count) {
    const pad = this.#pad();
    return Array.from({ length: count }, (_, i) =>
      this.held.has(`Digit${i + 1}`) || !!pad?.buttons[FIRST_MOVE_BUTTON + i]?.pressed);
  }

  turnOfView(seconds) {
    const keys = (this.held.has("KeyQ") ? 1 : 0) - (this.held.has("KeyE") ? 1 : 0), pad = this.#pad()?.axes[2] ?? 0;
    const turn = TURNING * seconds * (keys - (Math.abs(pad) > DEAD ? pad : 0)) - BY_MOUSE * this.dragged[0];
    this.dragged[0] = 0;
    return turn;
  }

  tiltOfView(seconds) {
    const pad = this.#pad()?.axes[3] ?? 0;
    const tilt = TURNING * seconds * (Math.abs(pad) > DEAD ? pad : 0) + BY_MOUSE * this.dragged[1];
    this.dragged[1] = 0;
    return tilt;
  }
}
