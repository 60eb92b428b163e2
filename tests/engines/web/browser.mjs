// SPDX-License-Identifier: MIT
// Chromium without a window, by its own protocol over a pipe; and a plain static server.
import { spawn } from "node:child_process";
import { createReadStream, existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };
const TICKS = 100; // a second, of Linux' clock of processes
// A page that no other is beside has a fine clock.
const ALONE = { "cross-origin-opener-policy": "same-origin", "cross-origin-embedder-policy": "require-corp" };
const OPTIONS = ["--headless", "--no-sandbox", "--enable-unsafe-swiftshader", "--mute-audio",
  "--disable-dev-shm-usage", "--no-first-run", "--disable-background-networking", "--hide-scrollbars", "--remote-debugging-pipe"];

/** Serves a folder on this machine; its address. */
export async function serve(folder) {
  const server = createServer((request, answer) => {
    const path = normalize(join(folder, decodeURIComponent(new URL(request.url, "http://x").pathname)));
    const file = existsSync(path) && statSync(path).isDirectory() ? join(path, "index.html") : path;
    if (!file.startsWith(normalize(folder)) || !existsSync(file)) return answer.writeHead(404).end();
    answer.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream", ...ALONE });
    createReadStream(file).pipe(answer);
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  return { address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

/** Of /proc/PID/stat what follows the name; nothing where the process has ended. */
function statOf(pid) {
  try {
    return readFileSync(`/proc/${pid}/stat`, "utf8").split(") ").at(-1).split(" ");
  } catch {
    return [];
  }
}

export class Browser {
  #next = 1;
  #asked = new Map();
  #rest = "";
  said = [];

  static async start(width, height, ...options) {
    const browser = new Browser();
    browser.folder = mkdtempSync(join(tmpdir(), "chromium-"));
    const words = [...OPTIONS, `--user-data-dir=${browser.folder}`, `--window-size=${width},${height}`, ...options, "about:blank"];
    browser.process = spawn("chromium", words, { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    browser.process.stdio[4].setEncoding("utf8").on("data", (text) => browser.#hear(text));
    const { targetInfos } = await browser.ask("Target.getTargets", {}, null);
    const { targetId } = targetInfos.find(({ type }) => type === "page");
    browser.session = (await browser.ask("Target.attachToTarget", { targetId, flatten: true }, null)).sessionId;
    for (const domain of ["Page", "Runtime", "Log"]) await browser.ask(`${domain}.enable`);
    await browser.ask("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
    return browser;
  }

  #hear(text) {
    const parts = (this.#rest + text).split("\0");
    this.#rest = parts.pop();
    for (const part of parts) {
      const { id, result, error, method, params } = JSON.parse(part);
      if (id) error ? this.#asked.get(id).fail(new Error(error.message)) : this.#asked.get(id).done(result);
      if (method === "Runtime.exceptionThrown") this.said.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
      if (method === "Log.entryAdded" && params.entry.level === "error") this.said.push(params.entry.text);
      if (method === "Runtime.consoleAPICalled" && params.type === "error") this.said.push(params.args.map((each) => each.value ?? each.description).join(" "));
    }
  }

  ask(method, params = {}, sessionId = this.session) {
    const id = this.#next++;
    this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId: sessionId ?? undefined })}\0`);
    return new Promise((done, fail) => this.#asked.set(id, { done, fail }));
  }

  async open(address) {
    await this.ask("Page.navigate", { url: address });
  }

  /** The value of an expression in the page. */
  async tell(expression) {
    const { result, exceptionDetails } = await this.ask("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  /** Waits until an expression is true, by the page's own frames. */
  async until(expression, seconds = 60) {
    const end = Date.now() + 1000 * seconds;
    while (!(await this.tell(`!!(${expression})`).catch(() => false))) {
      if (Date.now() > end) throw new Error(`not within ${seconds} s: ${expression}; it says: ${this.said.join("; ")}; ${await this.text()}`);
      await this.wait(0.1);
    }
  }

  text() {
    return this.tell("document.getElementById('message')?.textContent");
  }

  wait(seconds) {
    return new Promise((done) => setTimeout(done, 1000 * seconds));
  }

  async key(code, down) {
    const key = code.startsWith("Key") ? code.slice(3).toLowerCase() : code === "Space" ? " " : code.replace(/^Digit|Left$/g, "");
    await this.ask("Input.dispatchKeyEvent", { type: down ? "keyDown" : "keyUp", code, key });
  }

  async mouse(type, [x, y]) {
    await this.ask("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: type === "mouseReleased" ? 0 : 1, clickCount: 1 });
  }

  async click(id) {
    const at = await this.tell(`(({left, top, width, height}) => [left + width / 2, top + height / 2])(document.getElementById("${id}").getBoundingClientRect())`);
    await this.mouse("mousePressed", at);
    await this.mouse("mouseReleased", at);
  }

  /** What all its processes have taken of the processors, ms. */
  processorTime() {
    const parents = new Map(), times = new Map();
    for (const pid of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
      const told = statOf(pid);
      parents.set(Number(pid), Number(told[1]));
      times.set(Number(pid), (1000 / TICKS) * (Number(told[11]) + Number(told[12])));
    }
    const isOurs = (pid) => pid === this.process.pid || (parents.has(pid) && isOurs(parents.get(pid)));
    return [...times].reduce((sum, [pid, time]) => (isOurs(pid) ? sum + time : sum), 0);
  }

  async picture(path) {
    const { data } = await this.ask("Page.captureScreenshot", { format: "png" });
    writeFileSync(path, Buffer.from(data, "base64"));
  }

  async close() {
    const ended = new Promise((done) => this.process.on("exit", done));
    await this.ask("Browser.close", {}, null).catch(() => {});
    await ended;
    rmSync(this.folder, { recursive: true, force: true, maxRetries: 5 });
  }
}
