# SPDX-License-Identifier: MIT
"""The stub says what the module has."""

from __future__ import annotations

import ast
import inspect
from pathlib import Path

import fragmotion_core as core

STUB = Path(__file__).resolve().parents[2] / "cpp" / "bindings" / "fragmotion_core.pyi"


def public_names(owner: object) -> set[str]:
    return {name for name in vars(owner) if not name.startswith("_")}


def stub_of_class(node: ast.ClassDef) -> dict[str, ast.AST]:
    members: dict[str, ast.AST] = {}
    for item in node.body:
        if isinstance(item, ast.FunctionDef):
            members[item.name] = item
        elif isinstance(item, ast.AnnAssign) and isinstance(item.target, ast.Name):
            members[item.target.id] = item
    return members


def arguments_of(node: ast.FunctionDef) -> list[str]:
    names = [argument.arg for argument in node.args.args]
    return names[1:] if names[:1] == ["self"] else names


def arguments_told(function: object) -> list[str]:
    """The names of the parameters as pybind11's docstring tells them, of overloads those of the last."""
    lines = (inspect.getdoc(function) or "").splitlines()
    signature = [lines[0], *(line for line in lines if line[:1].isdigit())][-1]
    inner = signature[signature.index("(") + 1 : signature.rindex(") ->")]
    parsed = ast.parse(f"def f({inner_names(inner)}): ...").body[0]
    assert isinstance(parsed, ast.FunctionDef)
    return arguments_of(parsed)


def inner_names(inner: str) -> str:
    """The parameters' names of 'a: T[x, y], b: U = 1', separated by commas."""
    names, depth, start = [], 0, 0
    for i, letter in enumerate(inner + ","):
        depth += (letter in "[({<") - (letter in "])}>")
        if letter == "," and depth == 0:
            names.append(inner[start:i].split(":")[0].split("=")[0].strip())
            start = i + 1
    return ", ".join(name for name in names if name)


def test_stub_names_what_the_module_has() -> None:
    body = ast.parse(STUB.read_text()).body
    classes = {node.name: node for node in body if isinstance(node, ast.ClassDef)}
    functions = {node.name: node for node in body if isinstance(node, ast.FunctionDef)}
    constants = {n.target.id for n in body if isinstance(n, ast.AnnAssign) and isinstance(n.target, ast.Name)}
    assert public_names(core) == set(classes) | set(functions) | {c for c in constants if not c.startswith("_")}
    for name, function in functions.items():
        assert arguments_told(getattr(core, name)) == arguments_of(function), name
    for name, node in classes.items():
        if name == "Cancelled":
            continue
        members = stub_of_class(node)
        assert public_names(getattr(core, name)) == {m for m in members if not m.startswith("_")}, name
        for member, item in members.items():
            if isinstance(item, ast.FunctionDef):
                told = arguments_told(getattr(getattr(core, name), member))
                assert told == arguments_of(item), f"{name}.{member}"


def test_stub_has_the_modules_defaults() -> None:
    player = inspect.getdoc(core.Player.__init__) or ""
    for node in ast.walk(ast.parse(STUB.read_text())):
        if isinstance(node, ast.ClassDef) and node.name == "Player":
            init = stub_of_class(node)["__init__"]
            assert isinstance(init, ast.FunctionDef)
            stitch = ast.literal_eval(init.args.defaults[1])
            assert f"stitch: float = {stitch}" in player or f"= {stitch}" in player
