# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
import ast
import inspect
import os
import pathlib
import re
import subprocess
import sys

import drawpoint
from drawpoint import _core

PACKAGE = pathlib.Path(drawpoint.__file__).parent


def public(of):
    return {name for name in dir(of) if not name.startswith("_")}


def test_every_public_name_says_what_it_is():
    undocumented = []
    for name in drawpoint.__all__:
        thing = getattr(drawpoint, name)
        if not inspect.isclass(thing) and not inspect.isfunction(thing):
            continue
        parts = [thing] + ([getattr(thing, part) for part in public(thing)] if inspect.isclass(thing) else [])
        for part in parts:
            own = getattr(part, "__module__", "").startswith("drawpoint")
            if own and (inspect.isfunction(part) or inspect.isclass(part)) and not inspect.getdoc(part):
                undocumented.append(f"{name}: {part}")
    assert undocumented == []


def test_the_stubs_name_what_the_compiled_part_has():
    stub = ast.parse((PACKAGE / "_core.pyi").read_text())
    functions = {node.name for node in stub.body if isinstance(node, ast.FunctionDef)}
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef) and node.name != "PointsParts"}
    assert functions | {name for name in classes if not name.startswith("_")} == public(_core)

    def members(node):
        own = {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
        own |= {part.target.id for part in node.body if isinstance(part, ast.AnnAssign)}
        return own.union(*(members(classes[base.id]) for base in node.bases))

    for name in public(_core) & set(classes):
        assert members(classes[name]) - {"__init__"} == public(getattr(_core, name)), name


def test_the_number_of_arguments_in_the_stubs_is_right():
    for node in ast.parse((PACKAGE / "_core.pyi").read_text()).body:
        if isinstance(node, ast.FunctionDef):
            signature = getattr(_core, node.name).__doc__.splitlines()[0]
            assert len(re.findall(r"\barg\d+:", signature)) == len(node.args.args), signature


def test_annotations_are_for_type_checkers():
    assert (PACKAGE / "py.typed").exists()


def test_the_page_prints_what_it_shows():
    page = (pathlib.Path(os.environ["DRAWPOINT_ROOT"]) / "docs/how-to/python.md").read_text()
    code, shown = (re.search(f"```{head}\n(.*?)```", page, re.S).group(1) for head in ("python", "text"))
    said = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert said.stdout == shown and said.stderr == ""
