// SPDX-License-Identifier: GPL-3.0-or-later
//
// A job type of Flamenco 3, Blender's render farm: bakes characters' recordings, or shots of a simulated player, a task
// each. Copy it into the folder `scripts` beside the Flamenco Manager; workers need the Fragmotion extension enabled.

const JOB_TYPE = {
    label: "Fragmotion Bake",
    settings: [
        {
            key: "characters", type: "string", required: true, eval: "bpy.data.filepath",
            description: "The .blend files with a character each, between semicolons; where there are takes, the one to make",
        },
        {
            key: "takes", type: "string", subtype: "dir_path",
            description: "A folder of motion capture of which the character is built at first; empty: it is there",
        },
        {
            key: "recordings", type: "string",
            eval: "'; '.join(dict.fromkeys(r.name for o in C.scene.objects for r in o.fragmotion.recordings))",
            description: "The recordings to bake, between semicolons; empty: shots of a simulated player",
        },
        { key: "player", type: "string", default: "walker", description: "Whose habits the simulated player has" },
        { key: "shots", type: "int32", default: 1, description: "How many shots the simulated player plays" },
        { key: "seconds", type: "float", default: 20, description: "How long each of its shots is" },
        { key: "seed", type: "int32", default: 1, description: "Of its first shot; the others count on" },
        {
            key: "into", type: "string", subtype: "dir_path", required: true,
            description: "The folder for the .blends, one for each recording or shot",
        },
        { key: "blender", type: "string", default: "{blender}", visible: "hidden" },
    ],
};

function compileJob(job) {
    const settings = job.settings;
    const characters = listed(settings.characters);
    if (characters.length == 0) throw new Error("No character is named: say which .blend holds one");
    if (settings.takes && characters.length > 1) {
        throw new Error("Takes make one character: name one .blend for it");
    }
    const built = settings.takes ? buildTask(settings, characters[0]) : null;
    if (built) job.addTask(built);
    const files = new Set();
    for (const character of characters) {
        for (const shot of shotsOf(settings)) {
            const file = fileOf(character, shot);
            if (files.has(file)) throw new Error("Two shots would be '" + file + "': rename one");
            files.add(file);
            const task = bakeTask(settings, character, shot, file);
            if (built) task.addDependency(built);
            job.addTask(task);
        }
    }
}

// What is between semicolons.
function listed(text) {
    return (text || "").split(";").map((name) => name.trim()).filter((name) => name.length > 0);
}

// Each recording or shot: its name, and the words that ask for it.
function shotsOf(settings) {
    const recordings = listed(settings.recordings);
    if (recordings.length > 0) {
        return recordings.map((name) => ({ name: name, words: ["--recording", name] }));
    }
    const shots = [];
    for (let shot = 0; shot < settings.shots; shot++) {
        const seed = settings.seed + shot;
        const words = ["--player", settings.player, "--seconds", String(settings.seconds), "--seed", String(seed)];
        shots.push({ name: settings.player + " " + seed, words: words });
    }
    return shots;
}

function buildTask(settings, character) {
    return fragmotionTask(settings, "build " + path.basename(character), ["build", settings.takes, "--blend", character]);
}

// What a shot is baked to.
function fileOf(character, shot) {
    return path.stem(character) + " " + shot.name.replace(/[^\w .-]/g, "_") + ".blend";
}

function bakeTask(settings, character, shot, file) {
    const words = ["bake", character].concat(shot.words, ["--blend", path.join(settings.into, file)]);
    return fragmotionTask(settings, "bake " + path.stem(character) + ": " + shot.name, words);
}

function fragmotionTask(settings, name, words) {
    const task = author.Task(name, "blender");
    task.addCommand(author.Command("exec", { exe: settings.blender, args: ["-c", "fragmotion"].concat(words) }));
    return task;
}
