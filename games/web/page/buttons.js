// SPDX-License-Identifier: MIT
// Moves and styles on buttons and keys, and what is switched on in the scene.

export class Buttons {
  constructor(does) {
    this.does = does;
    this.moves = document.getElementById("moves");
    this.styles = document.getElementById("styles");
    this.held = [];
    this.toggles = {};
    for (const [name, run] of [["path", does.drawPath], ["look", does.lookAround], ["crowd", does.showCrowd], ["fades", does.crossFade]]) {
      this.toggles[name] = new Toggle(document.getElementById(name), run);
    }
  }

  /** Those of a character. */
  list(character) {
    this.moves.replaceChildren(...character.moves.map(({ name }, move) => this.#moveButton(name, move)));
    const styles = character.styles.length > 1 ? character.styles : [];
    this.styles.replaceChildren(...styles.map(({ name }, style) => button(name, () => this.does.changeStyle(style))));
    this.held = character.moves.map(() => false);
    this.toggles.fades.set(false);
    this.toggles.path.set(false);
    this.toggles.look.set(false);
  }

  #moveButton(name, move) {
    const made = button(name);
    const key = document.createElement("kbd");
    key.textContent = move + 1;
    made.append(key);
    made.addEventListener("pointerdown", () => this.does.startMove(move));
    for (const end of ["pointerup", "pointerleave", "pointercancel"]) {
      made.addEventListener(end, () => this.does.releaseMove(move));
    }
    return made;
  }

  /** Starts and releases moves by their keys. */
  readKeys(controls) {
    controls.heldMoves(this.held.length).forEach((isHeld, move) => {
      if (isHeld && !this.held[move]) this.does.startMove(move);
      if (!isHeld && this.held[move]) this.does.releaseMove(move);
      this.held[move] = isHeld;
    });
  }

  /** Lights those up that play. */
  light(state) {
    [...this.moves.children].forEach((each, move) =>
      each.classList.toggle("on", state.wholeBodyMove === move || state.upperBodyMove === move));
    [...this.styles.children].forEach((each, style) => each.classList.toggle("on", state.style === style));
  }

  showCrowd(on) {
    this.toggles.crowd.set(on);
  }

  showPath(on) {
    this.toggles.path.set(on);
  }
}

class Toggle {
  constructor(element, run) {
    Object.assign(this, { element, run });
    element.addEventListener("click", () => this.set(!this.isOn()));
  }

  isOn() {
    return this.element.ariaPressed === "true";
  }

  set(on) {
    if (on === this.isOn()) return;
    this.element.ariaPressed = String(on);
    this.run(on);
    this.element.blur(); // so that Space jumps
  }
}

function button(text, run) {
  const made = document.createElement("button");
  made.textContent = text;
  made.addEventListener("click", () => {
    run?.();
    made.blur();
  });
  return made;
}
