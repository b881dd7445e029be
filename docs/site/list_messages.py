#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the warnings and errors of docs/reference/errors.md, in alphabetical order, from src/common/warning_texts.cpp,
error_texts.cpp and file_error_texts.cpp. Each has a heading that you can link to, its text, and what to do, which is kept from the page. Lists codes that the sources use but no table has, and codes that no source uses.

usage: list_messages.py REPOSITORY [--check]     --check: list what would change, with exit code 1; write nothing
"""
import pathlib
import re
import sys

FILES = "Errors of files A-Z"
TABLES = {"Warnings A-Z": "src/common/warning_texts.cpp", "Errors A-Z": "src/common/error_texts.cpp",
          FILES: "src/common/file_error_texts.cpp"}
PAGE = "docs/reference/errors.md"
BEGIN, END = "<!-- messages: made by docs/site/list_messages.py -->\n", "<!-- end of messages -->\n"
LITERALS = r'((?:"(?:[^"\\\n]|\\.)*"\s*)+)'
ROW = re.compile(r'\{"([a-z0-9_]+)",\s*' + LITERALS + r"\}")
USED = re.compile(r'(?:\b(?:warn|Message|throw (?:\w+::)*\w+)\(|push_back\(\{)\s*"([a-z0-9_]+)",\s*[{v]')
ADVICE = re.compile(r"^### `([a-z0-9_]+)`\n\n> .*\n\n([^#\n].*)$", re.MULTILINE)
PLURALS = {"are": "is", "were": "was", "have": "has", "they": "it", "their": "its", "do": "does"}
TEXT = "text"  # the code of texts that are in no table
QUOTED = re.compile(r'"((?:[^"\\\n]|\\.)*)"')


def read_rows(path):
    source = path.read_text()
    return {code: "".join(QUOTED.findall(literals)).replace('\\"', '"') for code, literals in ROW.findall(source)}


def read_sources(root):
    paths = [p for folder in ("src", "include", "tools", "python") for p in sorted((root / folder).rglob("*"))]
    return "\n".join(p.read_text() for p in paths if p.suffix in (".cpp", ".h", ".py") and str(p.relative_to(root)) not in TABLES.values())


def inner_end(text, start):
    """The index of the brace that closes the one before start."""
    depth = 1
    for i in range(start, len(text)):
        depth += {"{": 1, "}": -1}.get(text[i], 0)
        if depth == 0:
            return i
    raise ValueError(text)


def split_choice(inner):
    """The name and the two texts of "name|one|other"."""
    parts, depth = [""], 0
    for letter in inner:
        depth += {"{": 1, "}": -1}.get(letter, 0)
        if letter == "|" and depth == 0 and len(parts) < 3:
            parts.append("")
        else:
            parts[-1] += letter
    return parts


def singular(words):
    """The words of a clause without what tells one thing from several."""
    return {PLURALS.get(word.lower(), word.lower()).rstrip("s") for word in words.split()}


def readable(text):
    """A text as a page shows it: values as "...", parameters as options."""
    shown, i = "", 0
    while i < len(text):
        if text[i] != "{":
            shown += text[i]
            i += 1
            continue
        end = inner_end(text, i + 1)
        inner = text[i + 1:end]
        parts = split_choice(inner)
        if inner.startswith("-"):
            shown += f"`{readable(inner)}`"
        elif len(parts) == 1:
            shown += "..."
        else:
            one, other = (readable(part) for part in (parts[1:] + [""])[:2])
            # Of singular and plural the second is shown, of others both.
            is_plural = singular(one) == singular(other) or not one or not other or other[0] == ";"
            shown += (other or one) if is_plural else (" " if other[:1] == " " else "") + f"{other.strip()} / {one.strip()}"
        i = end + 1
    return shown.replace("|", "\\|").replace("\\n...", "")  # the marked lines of an expression


def escaped(text):
    """Text outside of `code` without characters that Markdown or HTML would take."""
    return "".join(part if i % 2 else part.replace("*", "\\*").replace("<", "&lt;") for i, part in enumerate(re.split("(`[^`]*`)", text)))


def count_values(call):
    """The values behind the code in `{"code", a, b(c, d)}`, of which `call` begins behind the code."""
    depth, values, quoted = 0, 0, False
    for i, letter in enumerate(call):
        quoted ^= letter == '"' and call[i - 1] != "\\"
        depth += 0 if quoted else {**dict.fromkeys("({[", 1), **dict.fromkeys(")}]", -1)}.get(letter, 0)
        values += letter == "," and depth == 0 and not quoted
        if depth < 0:
            return values
    raise ValueError(call)


def check_reasons(rows, sources):
    """Reasons of files are named by their place: as many values as the text has, or fewer where it has alternatives."""
    for code, text in rows.items():
        names = len(set(re.findall(r"\{([a-z_]+)", text)))
        for match in re.finditer(rf'\{{"{code}"(?=[,}}])', sources):
            given = count_values(sources[match.end():match.end() + 1000])
            if given != names and not (given < names and "|" in text):
                yield f"The reason '{code}' has {names} values, but {given} are given."


def make_headings(rows, advice):
    sections = []
    for code, text in sorted(rows.items()):
        shown = escaped(readable(text)).replace("\\|", "|")
        sections.append(f"### `{code}`\n\n> {shown}\n" + (f"\n{advice[code]}\n" if advice.get(code) else ""))
    return "\n".join(sections)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1])
    tables, sources = {title: read_rows(root / path) for title, path in TABLES.items()}, read_sources(root)
    codes = [code for path in TABLES.values() for code, _ in ROW.findall((root / path).read_text())]
    wrong = [f"No table has the code '{code}'." for code in sorted(set(USED.findall(sources)) - {*codes, TEXT})]
    wrong += [f"No source uses the code '{code}'." for code in codes if f'"{code}"' not in sources]
    wrong += [f"The code '{code}' has two rows." for code in set(codes) if codes.count(code) > 1]
    wrong += check_reasons(tables[FILES], sources)
    page = (root / PAGE).read_text()
    if BEGIN not in page or END not in page:
        sys.exit(f"{PAGE} lacks the markers of the table: {BEGIN}{END}")
    before, rest = page.split(BEGIN)
    old, after = rest.split(END)
    advice = dict(ADVICE.findall(old))
    made = before + BEGIN + "\n".join(f"## {title}\n\n{make_headings(rows, advice)}" for title, rows in tables.items()) + END + after
    if made != page:
        if "--check" in sys.argv:
            wrong.append(f"{PAGE} is out of date. Try: python3 docs/site/list_messages.py .")
        else:
            (root / PAGE).write_text(made)
    sys.exit("\n".join(wrong) or 0)


if __name__ == "__main__":
    main()
