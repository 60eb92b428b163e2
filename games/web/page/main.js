// SPDX-License-Identifier: MIT
// The live page: loads the sample character, steps it each frame, and wires what is on the page.

import { load } from "fragmotion";
import WebGL from "three/addons/capabilities/WebGL.js";
import { Actor } from "./actor.js";
import { Buttons } from "./buttons.js";
import { Controls } from "./controls.js";
import { Crowd } from "./crowd.js";
import { receiveFiles } from "./files.js";
import { Overlay } from "./overlay.js";
import { DrawnPath } from "./path.js";
import { Scene } from "./scene.js";

const LONGEST = 0.1; // s that a frame plays on, after a pause of the page
const FARTHEST = 20; // m that it looks at
const message = document.getElementById("message");

function tell(text) {
  message.textContent = text;
}

async function bytesOf(address) {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${address} is not there: the server answers ${answer.status}`);
  return answer.arrayBuffer();
}

class Page {
  constructor(fragmotion, scene, canvas) {
    Object.assign(this, { fragmotion, scene });
    this.controls = new Controls(canvas);
    this.overlay = new Overlay(scene);
    this.path = new DrawnPath(scene, canvas, (points) => this.followPath(points));
    this.buttons = new Buttons({
      startMove: (move) => this.actor.player.startMove(move),
      releaseMove: (move) => this.actor.player.releaseMove(move),
      changeStyle: (style) => this.actor.player.changeStyle(style),
      drawPath: (on) => this.path.draw(on),
      lookAround: (on) => this.lookAround(on),
      showCrowd: (on) => this.showCrowd(on),
      crossFade: (on) => this.crossFade(on),
    });
    this.last = performance.now();
    canvas.addEventListener("wheel", (event) => scene.zoom(Math.exp(0.001 * event.deltaY)), { passive: true });
  }

  /** Shows a character from now on, with a mesh or as its bones; throws, and changes nothing, where they do not fit. */
  async show(policy, mesh) {
    const character = this.fragmotion.character(policy);
    const actor = await Actor.make(character, mesh, this.scene);
    this.buttons.showCrowd(false);
    this.actor?.remove();
    this.actor = actor;
    this.followsPath = false;
    this.path.clear();
    this.buttons.list(character);
    return actor.remark;
  }

  followPath(points) {
    this.actor.player.setPath(points);
    this.followsPath = true;
    this.buttons.showPath(false);
  }

  crossFade(on) {
    this.actor.crossFade(on);
    if (this.followsPath) this.actor.player.setPath(this.path.points);
  }

  lookAround(on) {
    this.looksAround = on;
    if (!on) this.actor.player.look("as captured");
  }

  showCrowd(on) {
    this.crowd?.remove();
    this.crowd = on ? new Crowd(this.actor, this.scene) : null;
  }

  input() {
    const input = this.controls.read(this.scene.facing());
    if (this.followsPath && !this.controls.isPushed()) return { steer: "path" };
    if (this.followsPath) this.path.clear();
    this.followsPath = false;
    return input;
  }

  frame(now) {
    const seconds = Math.min(LONGEST, (now - this.last) / 1000);
    this.last = now;
    this.buttons.readKeys(this.controls);
    this.scene.turn(this.controls.turnOfView(seconds), this.controls.tiltOfView(seconds));
    this.asked = this.input();
    if (this.looksAround) this.actor.player.look("at", this.scene.seenAt(...this.controls.pointer, FARTHEST).toArray());
    this.actor.step(this.asked, seconds);
    this.crowd?.step(seconds, this.actor.player.state);
    this.scene.follow(this.actor.player.state.position, seconds);
    this.crowd?.show();
    this.overlay.update(this.actor, this.asked, this.followsPath, now);
    this.buttons.light(this.actor.player.state);
    this.scene.suit(seconds);
    this.scene.render();
  }
}

async function begin() {
  if (!WebGL.isWebGL2Available()) {
    return tell("This browser shows no WebGL 2, which draws the character. Turn hardware acceleration on in its settings, " +
      "update it and the graphics driver, or try another browser.");
  }
  const canvas = document.getElementById("view"), wanted = new URLSearchParams(location.search);
  const fragmotion = await load();
  const page = new Page(fragmotion, new Scene(canvas), canvas);
  const policy = wanted.get("policy") ?? "sample.policy";
  const mesh = wanted.get("glb") ?? (wanted.has("policy") ? null : "sample.glb");
  tell((await page.show(await bytesOf(policy), mesh && (await bytesOf(mesh)))) ?? "");
  receiveFiles(document.body, (own, glb) => page.show(own, glb), tell);
  page.scene.renderer.setAnimationLoop((now) => page.frame(now));
  canvas.focus();
  window.page = page; // for who looks into it by the browser's console
}

begin().catch((error) => tell(`${error.message ?? error}`));
