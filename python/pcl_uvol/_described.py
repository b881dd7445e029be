# SPDX-License-Identifier: BSD-3-Clause
"""Docstrings in full. An entry that several functions need is written once, in the docstring of one of them. Others have a
line {points, fields} for entries of `isosurface`, {threads of Interpolator.evaluate} for one of another function, or
{others of measure} for those of all parameters that they do not describe otherwise. Defaults are from the signatures."""

import inspect
import json
import re
import textwrap


def described(description):
    """Let a function that takes **parameters take those of a stage by name: in its signature before `threads`, and in
    its docstring in the place of a line {parameters}. Those that it takes itself, by their names or as options of tools
    are called, are left to it. The description is JSON of names, options, types, defaults and help."""

    def decorate(function):
        signature = inspect.signature(function)
        listed = [parameter for parameter in signature.parameters.values() if parameter.kind != parameter.VAR_KEYWORD]
        members = [member for member in json.loads(description)
                   if not {member["name"], member["option"]} & set(signature.parameters)]
        place = next(i for i, parameter in enumerate(listed) if parameter.name == "threads")
        listed[place:place] = [inspect.Parameter(member["name"], inspect.Parameter.KEYWORD_ONLY, default=member["default"])
                               for member in members]

        function.__signature__ = signature.replace(parameters=listed)
        function.__doc__ = fill(function.__doc__, members)
        return function

    return decorate


def fill(text, members):
    """A docstring with an entry for each member; that of Python -OO stays None."""
    if text is None:
        return None
    entries = []
    for member in members:
        help = member["help"][0].upper() + member["help"][1:] + "."
        entries += [f"{member['name']} : {member['type']}",
                    *textwrap.wrap(help, 88, initial_indent=" " * 4, subsequent_indent=" " * 4)]
    return inspect.cleandoc(text).replace("{parameters}", "\n".join(entries))


def complete(things):
    """Write the docstrings of functions, and of classes and their methods, in full."""
    functions = {name: function for name, function in _list_functions(things) if "Parameters\n" in (function.__doc__ or "")}
    pages = Docstrings({name: (function.__doc__, {parameter.name: ending(parameter.default)
                                                  for parameter in inspect.signature(function).parameters.values()})
                        for name, function in functions.items()})
    for name, function in functions.items():
        function.__doc__ = pages.write(name)


def _list_functions(things):
    for thing in things:
        yield thing.__qualname__, thing
        for owner in getattr(thing, "__mro__", ()):
            for member in vars(owner).values() if owner.__module__.startswith(__package__) else ():
                member = getattr(member, "__func__", member)  # of a class method
                if inspect.isfunction(member):
                    yield member.__qualname__, member


def ending(default):
    """How the first line of an entry ends: with the default; "" for a parameter that must be given."""
    if default is inspect.Parameter.empty:
        return ""
    return ", optional" if default is None else f", default {json.dumps(default) if isinstance(default, str) else default}"


class Docstrings:
    """Docstrings by the name of the function; each with the endings of its parameters by name."""

    def __init__(self, pages):
        self._pages = {name: (*_cut(text), endings) for name, (text, endings) in pages.items()}
        self._found = {}

    def write(self, name):
        before, _, after, endings = self._pages[name]
        return before + "\n".join(_end(entry, endings) for entry in self._list_entries(name)) + after

    def _list_entries(self, name):
        if name not in self._found:
            found = self._found[name] = []
            _, entries, _, endings = self._pages[name]
            for entry in entries:
                if not entry.startswith("{"):
                    found.append(entry)
                    continue
                names, _, source = entry.strip("{}").partition(" of ")
                wanted = set(endings).difference(*map(_names, entries)) if names == "others" else set(names.split(", "))
                found += [each for each in self._list_entries(source or "isosurface") if wanted.intersection(_names(each))]
        return self._found[name]


def _cut(text):
    """What is before the entries of the parameters, these, and what follows, all without the margin."""
    before, heading, rest = text.partition("Parameters\n")
    margin = before.rpartition("\n")[2]
    section, blank, after = rest.replace("\n" + margin, "\n").rstrip().partition("\n\n")
    return before.replace("\n" + margin, "\n") + heading + "----------\n", re.split(r"\n(?=\S)", section)[1:], blank + after


def _names(entry):
    head = entry.partition("\n")[0]
    return head.strip("{}").partition(" of " if head.startswith("{") else " : ")[0].split(", ")


def _end(entry, endings):
    head, line, body = entry.partition("\n")
    known = {endings.get(name, "") for name in _names(entry)}
    is_open = len(known) == 1 and ", optional" not in head and ", default" not in head
    return head + (known.pop() if is_open else "") + line + body
