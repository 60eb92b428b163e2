// SPDX-License-Identifier: MIT
// A .policy and a .glb that are dropped on the page, together or one after the other.

/** Shows what is dropped on `place` by show(policy, glb), and tells what went wrong. */
export function receiveFiles(place, show, tell) {
  place.addEventListener("dragover", (event) => event.preventDefault());
  place.addEventListener("drop", async (event) => {
    event.preventDefault();
    tell("");
    try {
      const files = [...event.dataTransfer.files], ending = (end) => files.find(({ name }) => name.toLowerCase().endsWith(end));
      const policy = ending(".policy"), glb = ending(".glb");
      if (!policy) throw new Error(whyNot(files, glb));
      tell((await show(await policy.arrayBuffer(), await glb?.arrayBuffer())) ?? "");
    } catch (error) {
      tell(`${error.message ?? error}`);
    }
  });
  place.addEventListener("pointerdown", () => tell(""));
}

function whyNot(files, glb) {
  if (glb) return "Drop the .policy together with the .glb: both at once, from the folder of Export to Game.";
  const names = files.map(({ name }) => name).join(", ") || "nothing";
  return `That is ${names}. Drop a .policy (Save Policy in Blender) and the .glb of its mesh.`;
}
