// SPDX-License-Identifier: MIT
// What Flamenco's manager makes of jobs by a job type's script: node compile.mjs SCRIPT JOBS.json prints, for each job,
// its tasks or what the script threw. It gives the script what the manager gives it.
import { readFileSync } from "node:fs";
import { posix } from "node:path";
import { runInNewContext } from "node:vm";

class Task {
  constructor(name, type) {
    Object.assign(this, { name, type, commands: [], dependencies: [] });
  }
  addCommand(command) {
    this.commands.push(command);
  }
  addDependency(task) {
    this.dependencies.push(task.name);
  }
}

const given = {
  author: { Task: (name, type) => new Task(name, type), Command: (name, parameters) => ({ name, parameters }) },
  path: { basename: posix.basename, join: posix.join, dirname: posix.dirname, stem: (path) => posix.parse(path).name },
  print: () => {},
};

const [script, jobs] = process.argv.slice(2);
const told = JSON.parse(readFileSync(jobs)).map(({ settings }) => {
  const context = { ...given };
  runInNewContext(readFileSync(script, "utf8") + "\nglobalThis.JOB_TYPE = JOB_TYPE;", context);
  const defaults = context.JOB_TYPE.settings.filter((each) => "default" in each);
  const all = { ...Object.fromEntries(defaults.map((each) => [each.key, each.default])), ...settings };
  const tasks = [];
  try {
    context.compileJob({ settings: all, addTask: (task) => tasks.push(task) });
  } catch (error) {
    return { error: error.message };
  }
  return { tasks };
});
console.log(JSON.stringify(told));
