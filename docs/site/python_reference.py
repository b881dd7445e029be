# SPDX-License-Identifier: BSD-3-Clause
"""The reference page of the Python module: signatures from its stub, docstrings from its sources. It is read as
text, so that nothing has to be built."""
import ast
import pathlib
import re
import sys
import textwrap

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "python/pcl_uvol"))
from _described import fill  # noqa: E402

INTRODUCTION = """# The Python module

Every public name of `pcl_uvol` with its signature and its docstring, as `help(pcl_uvol)` shows them. `...` stands for a
default that the docstring tells. [Python](../guide/python.md) explains how the names play together.
"""

SHOWN = ("__init__", "__call__", "__getitem__")  # of the names with underscores


HEADERS = {"describe_level_set": "levelset/level_set_parameters.h", "describe_normals": "surface/surface_normals.h"}


def read_members(folder, node):
    """Names, types and help of the parameters that a function takes by `described`: from the header that lists them, and
    the stub."""
    calls = [decorator.args[0].func.attr for decorator in node.decorator_list
             if isinstance(decorator, ast.Call) and getattr(decorator.func, "id", "") == "described" and decorator.args]
    if not calls:
        return []
    header = (folder.parent.parent / "include/pcl_uvol" / HEADERS[calls[0]]).read_text()
    stub = next(item for item in ast.parse((folder / "__init__.pyi").read_text()).body
                if getattr(item, "name", "") == node.name)
    types = {argument.arg: ast.unparse(argument.annotation) for argument in stub.args.kwonlyargs}
    texts = re.findall(r'Member\{\s*"(\w+)",\s*&Own::\w+,\s*\{((?:\s*"[^"]*")+)', header)
    return [{"name": name, "type": types[name], "help": "".join(re.findall(r'"([^"]*)"', text))}
            for name, text in texts if name in types]


def read_docstring(folder, node):
    return fill(ast.get_docstring(node), read_members(folder, node))


def read_docstrings(folder):
    """Docstrings by name, those of methods by Class.name, inherited ones as well."""
    found, classes = {}, {}
    for path in sorted(folder.glob("*.py")):
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.FunctionDef):
                found[node.name] = read_docstring(folder, node)
            if isinstance(node, ast.ClassDef):
                found[node.name] = ast.get_docstring(node)
                classes[node.name] = node
    for name, node in classes.items():
        bases = [classes[base.id] for base in node.bases if getattr(base, "id", None) in classes]
        for item in [item for owner in (*reversed(bases), node) for item in owner.body]:
            if isinstance(item, ast.FunctionDef):
                found[f"{name}.{item.name}"] = ast.get_docstring(item)
    return found


def write_signature(node, name):
    result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    text = textwrap.fill(f"{name}({ast.unparse(node.args)}){result}", 110, subsequent_indent="    ",
                         break_long_words=False, break_on_hyphens=False)
    return f"```python\n{text}\n```\n"


def write_docstring(text):
    """The first paragraph as prose, the rest, which is set in columns, as it stands."""
    summary, _, rest = (text or "").partition("\n\n")
    return (summary + "\n" if summary else "") + (f"\n```text\n{rest}\n```\n" if rest else "")


def write_function(node, docstrings, owner=""):
    level = "###" if owner else "##"
    name = owner + node.name
    return f"{level} {name}\n\n{write_signature(node, name)}\n{write_docstring(docstrings.get(name))}"


def write_class(node, docstrings):
    bases = [ast.unparse(base) for base in node.bases]
    parts = [f"## {node.name}\n\n{write_docstring(docstrings.get(node.name))}"]
    if bases:
        parts.append("It has all of " + ", ".join(f"`{base}`" for base in bases) + ".\n")
    attributes = [item for item in node.body if isinstance(item, ast.AnnAssign)]
    if attributes:
        parts.append("| attribute | type |\n|---|---|\n" + "".join(
            f"| `{ast.unparse(item.target)}` | `{ast.unparse(item.annotation)}` |\n".replace(" | None", " or None")
            for item in attributes))
    for item in node.body:
        if isinstance(item, ast.FunctionDef) and (item.name in SHOWN or not item.name.startswith("_")):
            parts.append(write_function(item, docstrings, node.name + "."))
    return "\n".join(parts)


def write_page(folder):
    """The page of the module whose sources and stub are in a folder. Classes that only others inherit from have an
    underscore in the stub and none in the sources."""
    docstrings = read_docstrings(folder)
    parts = [INTRODUCTION]
    for node in ast.parse(re.sub(r"\b_([A-Z])", r"\1", (folder / "__init__.pyi").read_text())).body:
        if isinstance(node, ast.FunctionDef):
            parts.append(write_function(node, docstrings))
        elif isinstance(node, ast.ClassDef):
            parts.append(write_class(node, docstrings))
    return "\n".join(parts)
