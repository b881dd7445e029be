# SPDX-License-Identifier: BSD-3-Clause
"""Keywords of functions that are the parameters of a stage, with what the library says of these."""

import functools
import inspect
import json
import textwrap


def described(description):
    """Let a function that takes **parameters take those of a stage by name: in its signature before `threads`, and in
    its docstring in the place of a line {parameters}.

    description : str
        JSON of names, types, defaults and help.
    """
    members = json.loads(description)

    def decorate(function):
        signature = inspect.signature(function)
        listed = [parameter for parameter in signature.parameters.values() if parameter.kind != parameter.VAR_KEYWORD]
        place = next(i for i, parameter in enumerate(listed) if parameter.name == "threads")
        listed[place:place] = [inspect.Parameter(member["name"], inspect.Parameter.KEYWORD_ONLY, default=member["default"])
                               for member in members]

        @functools.wraps(function)
        def call(*values, **options):
            return function(*values, **options)

        call.__signature__ = signature.replace(parameters=listed)
        call.__doc__ = fill(function.__doc__, members)
        return call

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
