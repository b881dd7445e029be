# SPDX-License-Identifier: BSD-3-Clause
"""The reference page of the Python module: signatures from its stub, docstrings from its sources. It is read as
text, so that nothing has to be built."""
import ast
import pathlib
import re
import sys
import textwrap

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "python/pcl_uvol"))
from _described import Docstrings, ending, fill  # noqa: E402

INTRODUCTION = """# The Python module

Every public name of `pcl_uvol` with its signature and its docstring, as `help(pcl_uvol)` shows them. `...` is a default,
which the docstring lists. [Python](../guide/python.md) explains how the names play together.
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
    texts = re.findall(r'Member\{\s*"(\w+)",\s*&Own::(\w+),\s*\{((?:\s*"[^"]*")+)', header)
    return [{"name": name, "type": types[name].removesuffix(" | None"), "default": read_default(header, member),
             "help": "".join(re.findall(r'"([^"]*)"', text))} for name, member, text in texts if name in types]


def read_default(header, member):
    """The default of a member of the struct of parameters, which is a number or a word; None without one."""
    value = re.search(rf"\s{member} = (?:\w+::)?(\w[\w.]*);", header.rpartition("Parameters {")[2])
    return value and (value[1].lower() if value[1].isalpha() else ast.literal_eval(value[1]))


def list_endings(node):
    """How the entries of the parameters of a function end, by the defaults of its signature."""
    places, names = node.args.args, node.args.kwonlyargs
    defaults = [None] * (len(places) - len(node.args.defaults)) + node.args.defaults + node.args.kw_defaults
    return {argument.arg: ending(ast.literal_eval(default)) if isinstance(default, (ast.Constant, ast.Tuple)) else ""
            for argument, default in zip(places + names, defaults)}


def read_docstrings(folder):
    """Docstrings by name, those of methods by Class.name, inherited ones as well."""
    nodes = [node for path in sorted(folder.glob("*.py")) for node in ast.parse(path.read_text()).body]
    pages, bases = {}, {}
    for node in nodes:
        text = (ast.get_docstring(node) or "") if isinstance(node, (ast.ClassDef, ast.FunctionDef)) else ""
        if isinstance(node, ast.FunctionDef):
            members = read_members(folder, node)
            pages[node.name] = (fill(text, members),
                                {**list_endings(node), **{each["name"]: ending(each["default"]) for each in members}})
        elif isinstance(node, ast.ClassDef):
            bases[node.name] = [base.id for base in node.bases if hasattr(base, "id")]
            fields = [item for item in node.body if isinstance(item, ast.AnnAssign) and item.value]
            pages[node.name] = text, {item.target.id: ending(ast.literal_eval(item.value)) for item in fields}
            for item in [item for item in node.body if isinstance(item, ast.FunctionDef)]:
                pages[f"{node.name}.{item.name}"] = ast.get_docstring(item) or "", list_endings(item)
                if item.name == "__init__":
                    pages[node.name][1].update(list_endings(item))
    pages["isosurface"][1].update(pages["Extractor.extract"][1])  # which takes its options
    whole = Docstrings({name: page for name, page in pages.items() if "Parameters\n" in page[0]})
    found = {name: whole.write(name) if "Parameters\n" in page[0] else page[0] for name, page in pages.items()}
    for owner, names in bases.items():
        for name in [name for base in names for name in list(found) if name.startswith(f"{base}.")]:
            found.setdefault(owner + name[name.index("."):], found[name])
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
