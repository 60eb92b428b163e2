// SPDX-License-Identifier: MIT
// Plays with the live page: keys in; places, texts and pictures out. Arguments: the page's folder, one for pictures.
import { join } from "node:path";
import { Browser, serve } from "./browser.mjs";

const [folder, pictures] = process.argv.slice(2);
const server = await serve(folder);
const found = {};

async function withBrowser(name, options, run) {
  const browser = await Browser.start(960, 540, ...options);
  try {
    await run(browser);
    found[`${name}Errors`] = browser.said;
    await browser.picture(join(pictures, `${name}.png`));
  } finally {
    await browser.close();
  }
}

const STATE = `(({position, velocity, heading, style, inTheAir, wholeBodyMove, upperBodyMove, pathArrived}) => (
  {position: [...position], velocity: [...velocity], heading, style, inTheAir, wholeBodyMove, upperBodyMove, pathArrived}))(page.actor.player.state)`;

/** Holds keys until what is awaited is so. */
async function hold(browser, codes, awaited, seconds) {
  for (const code of codes) await browser.key(code, true);
  await browser.until(awaited, seconds);
  const state = await browser.tell(STATE);
  for (const code of codes) await browser.key(code, false);
  return state;
}

await withBrowser("walk", [], async (browser) => {
  await browser.open(server.address);
  await browser.until("window.page?.actor && !document.getElementById('message').textContent");
  found.start = await browser.tell(STATE);
  found.forward = await hold(browser, ["KeyW"], "page.actor.player.state.position[2] < -3.2");
  await browser.until("Math.hypot(...page.actor.player.state.velocity) < 0.2");
  found.right = await hold(browser, ["KeyD", "ShiftLeft"], "page.actor.player.state.position[0] > 3");
  await browser.until("Math.hypot(...page.actor.player.state.velocity) < 0.2");
  await browser.key("Space", true);
  await browser.until("page.actor.player.state.inTheAir");
  await browser.key("Space", false);
  await browser.picture(join(pictures, "jump.png"));
  await browser.until("!page.actor.player.state.inTheAir");
  found.moves = await browser.tell("page.actor.character.moves.map(({name}) => name)");
  found.waved = await hold(browser, ["Digit1"], "page.actor.player.state.upperBodyMove === 0 || page.actor.player.state.wholeBodyMove === 0");
  await browser.tell("document.getElementById('styles').children[1].click()");
  await browser.until("page.actor.player.state.style === 1");
  found.text = await browser.tell("document.getElementById('told').innerText");
});

await withBrowser("stairs", [], async (browser) => {
  await browser.open(server.address);
  await browser.until("window.page?.actor && !document.getElementById('message').textContent");
  await browser.tell("page.actor.player.reset({position: [3.5, 0, -5.2], heading: 0})");
  found.up = await hold(browser, ["KeyW"], "page.actor.player.state.position[2] < -8.2");
  await browser.tell("page.scene.turn(0.9, 0.1)");
  await browser.wait(0.7);
});

await withBrowser("look", [], async (browser) => {
  await browser.open(server.address);
  await browser.until("window.page?.actor && !document.getElementById('message').textContent");
  await browser.tell("page.scene.turn(Math.PI - 0.4, 0)");
  await browser.click("look");
  found.heads = [];
  for (const x of [150, 800]) {
    await browser.mouse("mouseMoved", [x, 450]);
    await browser.wait(2);
    found.heads.push(await browser.tell(`(({ player, character }) => {
      const [x, y, z, w] = player.pose(null, "model").subarray(7 * character.findBone("head") + 3);
      return Math.atan2(2 * (x * z + w * y), 1 - 2 * (x * x + y * y));
    })(page.actor)`));
  }
});

await withBrowser("path", [], async (browser) => {
  await browser.open(server.address);
  await browser.until("window.page?.actor && !document.getElementById('message').textContent");
  await browser.tell("page.scene.turn(0, 0.5); page.scene.zoom(2)");
  await browser.wait(1);
  await browser.click("path");
  const way = Array.from({ length: 30 }, (_, i) => [480 + 220 * Math.sin(i / 8), 330 - 4 * i]);
  await browser.mouse("mousePressed", way[0]);
  for (const at of way) await browser.mouse("mouseMoved", at);
  await browser.mouse("mouseReleased", way.at(-1));
  found.drawn = await browser.tell("page.path.points.length");
  await browser.until("page.actor.player.state.pathWay > 1");
  await browser.picture(join(pictures, "along-path.png"));
  await browser.until("page.actor.player.state.pathArrived", 90);
  found.end = await browser.tell("page.path.points.at(-1)");
  found.arrived = await browser.tell(STATE);
  await browser.click("fades");
  found.fades = await hold(browser, ["KeyW"], "page.actor.player.state.velocity[2] < -0.5");
});

await withBrowser("crowd", [], async (browser) => {
  await browser.open(server.address);
  await browser.until("window.page?.actor && !document.getElementById('message').textContent");
  await hold(browser, ["KeyW"], "page.actor.player.state.position[2] < -2");
  found.cost = await browser.tell(`(() => {
    const input = { steer: "camera", move: [0.5, 0.5], facing: [0, 0, -1] }, times = [];
    for (let round = 0; round < 500; ++round) { // each too short for other programs to come between
      const start = performance.now();
      for (let i = 0; i < 20; ++i) page.actor.step(input, 1 / 60);
      times.push((1000 * (performance.now() - start)) / 20);
    }
    page.actor.player.reset();
    return Math.min(...times);
  })()`);
  await browser.click("crowd");
  await browser.until("page.crowd && page.crowd.people.length === 500", 120);
  await browser.tell("page.scene.turn(0.5, 0.05)");
  await browser.tell(`(() => { // a sixtieth of a second each, however long they take
    page.scene.renderer.setAnimationLoop(() => page.frame(page.last + 1000 / 60));
    Object.assign(page.scene, { share: 0.35, suit() {} });
    dispatchEvent(new Event("resize"));
  })()`);
  await browser.wait(2);
  const taken = browser.processorTime();
  found.crowdRate = await browser.tell(`new Promise((done) => {
    const times = [];
    const next = (now) => { times.push(now); times.length > 240 ? done(240000 / (times.at(-1) - times[0])) : requestAnimationFrame(next); };
    requestAnimationFrame(next);
  })`);
  found.crowdTakes = (browser.processorTime() - taken) / 240;
  found.isPlain = await browser.tell("page.scene.isPlain");
  found.seen = await browser.tell("page.crowd.people.filter(({ isSeen }) => isSeen).length");
});

// As a graphics processor shows it.
await withBrowser("play", [], async (browser) => {
  await browser.open(server.address);
  await browser.until("window.page?.actor && !document.getElementById('message').textContent");
  await browser.tell(`(({ scene }) => {
    Object.assign(scene, { isPlain: false, share: 2, suit() {} });
    scene.sun.castShadow = true;
    dispatchEvent(new Event("resize"));
    for (const id of ["cost", "rate"]) { // which are not a graphics processor's
      const told = document.getElementById(id);
      told.previousElementSibling.remove();
      told.style.display = "none";
    }
  })(page)`);
  await hold(browser, ["KeyW"], "page.actor.player.state.position[2] < -2");
  await browser.click("crowd");
  await browser.tell("page.scene.turn(0.5, 0.05)");
  await browser.key("ShiftLeft", true);
  await browser.key("KeyD", true);
  await browser.until("Math.hypot(...page.actor.player.state.velocity) > 2.5");
});

const DROP = `async (names) => {
  const files = await Promise.all(names.map(async (name) => new File([await (await fetch(name)).arrayBuffer()], name)));
  const data = new DataTransfer();
  files.forEach((file) => data.items.add(file));
  document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
}`;

await withBrowser("dropped", [], async (browser) => {
  await browser.open(`${server.address}?policy=sample.policy`);
  await browser.until("window.page?.actor?.skins.length === 0");
  await browser.wait(0.5);
  await browser.picture(join(pictures, "bones.png"));
  found.dropped = {};
  for (const [name, files] of Object.entries({ nothing: ["page.css"], mesh: ["sample.glb"], broken: ["broken.policy"] })) {
    await browser.tell("document.getElementById('message').textContent = ''");
    await browser.tell(`(${DROP})(${JSON.stringify(files)})`);
    await browser.until("document.getElementById('message').textContent");
    found.dropped[name] = await browser.text();
  }
  await browser.tell(`(${DROP})(["sample.policy", "sample.glb"])`);
  await browser.until("page.actor.skins.length");
  found.dropped.both = await browser.text();
  await browser.wait(0.5);
});

await withBrowser("no-webgl", ["--disable-3d-apis"], async (browser) => {
  await browser.open(server.address);
  await browser.until("!/^Loading/.test(document.getElementById('message').textContent)");
  found.noWebGL = await browser.text();
});

await withBrowser("no-wasm", [], async (browser) => {
  await browser.ask("Page.addScriptToEvaluateOnNewDocument", { source: "delete globalThis.WebAssembly" });
  await browser.open(server.address);
  await browser.until("!/^Loading/.test(document.getElementById('message').textContent)");
  found.noWasm = await browser.text();
});

server.close();
console.log(JSON.stringify(found));
