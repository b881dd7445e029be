#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Lists what is hard to read on pages, in messages, in texts of programs, in comments of public headers, in docstrings,
in schemas and in notebooks: sentences of more than 30 words (28 in messages), paragraphs of more than 90 words, and
words that only this project used. CONTRIBUTING.md has the style guide.

usage: check_prose.py REPOSITORY     exit code 1 if there are any"""
import ast
import json
import pathlib
import re
import sys

MOST_WORDS, MOST_IN_MESSAGES, MOST_IN_PARAGRAPH = 30, 28, 90
PRIVATE = {
    r"\b(is|are|was|were) told\b|\btold (of|as|apart|by|no)\b|\btells? (of|the|a|which|what|how|its|whether|area|nothing)\b":
        "report, list, predict",
    r"\bwhat (lies|is left|they|it|the samples|no|comes|was weighed|looks|walls|is known) ": "name the thing",
    r"\b(stands?|stood) (in|at|before|beside|there|behind|for)\b|\bstand at every\b": "is in, represents",
    r"\bhold(s|ing)? (each|every|both|what|them) (count|against|to)\b|\bholds? .{3,40} against\b": "check against",
    r"\b(told|known|is) no better\b": "not more accurate than",
    r"\bg(oes|o) (without|with|by)\b(?! the)": "cannot be combined with, requires, is based on",
    r"\b(is|are) no (number|file|list|table|label|text|comparison|STL|vtkDataSet|web page|probabilit|whole numbers|slips|times"
    r"|clusters?|coordinates|steps|known|finite|manifold)\b|\b(is|are) (?-i:none)\b": "is not a",
    r"(?<!farther )\bfrom 0\b(?!\s*(to|\.|,?\d))": "non-negative, 0-based",
    r"\bsurer\b|\bsure of\b": "more certain, smaller standard error",
    r"\bstray(s|ing)?\b": "outlier",
    r"\bmend(s|ed|ing)?\b": "fix, correct",
    r"\bthe mere\b|\bmere points\b": "only the, plain",
    r"\bone'?s own\b|\bof (its|their) own\b": "separate, custom",
    r"\bfilms?\b": "animation, video",
    r"(?-i:\bfigures\b)(?! \d)": "numbers, measurements, results",  # Figures begins a title; a figure is a drawing
    r"\bways?\b(?=s? beside| of kilomet|,? too)|\bthe whole way\b": "path, pipeline",
    r"\bunasked\b|\bnot to be had\b|\bof no use\b": "by default, not available, invalid",
    r"\bsamples? (that (were|are) )?left out\b": "held-out samples",
    r"\bon which side\b.{0,40}\blie\b|\blie on the right side\b": "are classified correctly",
    r"\ba (wish|need|question) for\b": "I want",
    r"\bbox(es)? that repeats?\b": "periodic box",
    r"\balways (say(ing)? )?the same\b": "majority class",
    r"\bguess(es|ed)?\b": "not constrained by the samples",
    r"\bchildren? of the\b|\bstrangers?\b": "untrusted",
    r"\bslips? past\b|\bhangs? together\b": "passes between, is connected",
    r"\b(fewer|larger|others?|those|these) (of|than) (it|them) (is|are|stay|count)\b": "name the noun",
    r"\blooks? (away|to the)\b": "points, faces",
}


def plain(text):
    """Markdown as its words: links are their texts, code is one word."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", re.sub(r"`[^`]*`", "CODE", text))
    return re.sub(r"\s+", " ", text.replace("*", "").replace("_", " ")).strip()


def sentences(text):
    return re.split(r"(?<=[.!?])\s+(?=[\"'(A-Z0-9])|(?<=[:;])\s+", text)


def count_words(text):
    return len(re.findall(r"[A-Za-z0-9][\w'.-]*", text))


def list_blocks(page):
    """Line and text of every paragraph, item and row of a table; whether its length counts as that of a paragraph."""
    block, start, is_code, was_blank = [], 0, False, True
    page = re.sub(r"<!--.*?-->", lambda comment: "\n" * comment.group().count("\n"), page, flags=re.DOTALL)
    for number, line in enumerate(page.split("\n") + [""], 1):
        if not block and was_blank and line.startswith("    ") and not is_code:
            continue  # a block of code
        was_blank = not line.strip()
        if line.lstrip().startswith("```"):
            is_code = not is_code
            continue
        text = line.strip()
        begins = re.match(r"([-*+]|\d+\.)\s|\||#|>|<|===|!!!", text)
        if block and (not text or begins or is_code):
            yield start, plain(" ".join(block)), True
            block = []
        if is_code or not text or text.startswith("<") or re.fullmatch(r"[|:\- ]+", text):
            continue
        if text.startswith("|"):
            for cell in text.strip("|").split("|"):
                yield number, plain(cell), False
            continue
        if not block:
            start = number
        block.append(re.sub(r"^([-*+]|\d+\.)\s+", "", text))


def judge(text, most):
    found = [f"{count_words(sentence)} words: {sentence[:60]}..." for sentence in sentences(text)
             if count_words(sentence) > most]
    for pattern, instead in PRIVATE.items():
        match = re.search(pattern, text, re.IGNORECASE)
        if match:
            found.append(f"'{match.group(0)}': {instead}")
    return found


def judge_page(text):
    for line, block, is_paragraph in list_blocks(text):
        if is_paragraph and count_words(block) > MOST_IN_PARAGRAPH:
            yield line, f"paragraph of {count_words(block)} words"
        for found in judge(block, MOST_WORDS):
            yield line, found


def longest(text):
    """A message with the longer one of each pair of alternatives."""
    inner = re.compile(r"\{(\w+)\|([^{}|]*)\|([^{}|]*)\}")
    text = re.sub(r"\{-?([\w-]+)(:\d)?( [^{}|]*)?\}", "value", text)
    while inner.search(text):
        text = inner.sub(lambda match: max(match.group(2), match.group(3), key=count_words), text)
    return text


def judge_messages(text):
    for row in re.finditer(r'\{"(\w+)",\s*((?:"(?:[^"\\]|\\.)*"\s*)+)\}', text):
        message = "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', row.group(2)))
        for found in judge(longest(message), MOST_IN_MESSAGES):
            yield text.count("\n", 0, row.start()) + 1, f"{row.group(1)}: {found}"


def judge_header(text):
    """Of comments that Doxygen reads; each tag begins a text."""
    for comment in re.finditer(r"/\*\*(.*?)\*/|///<?((?:[^\n]|\n\s*///<?)*)", text, re.DOTALL):
        words = re.sub(r"\n\s*(\*|///<?)(?=\s)", "\n", comment.group(1) or comment.group(2) or "")
        for block in re.split(r"\n\s*\n|\n\s*(?=[\\-])|\\\w+", words):
            for found in judge(plain(block), MOST_WORDS):
                yield text.count("\n", 0, comment.start()) + 1, found


def judge_module(text):
    """Docstrings of modules, classes and functions without their examples, and texts of exceptions."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Raise):
            for string in ast.walk(node):
                if isinstance(string, ast.Constant) and isinstance(string.value, str) and count_words(string.value) > 3:
                    for found in judge(plain(string.value), MOST_IN_MESSAGES):
                        yield node.lineno, found
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)):
            words = re.sub(r"(?m)^\s*(>>>|\.\.\.).*\n(?:\s*[^\s>].*\n)*", "", (ast.get_docstring(node) or "") + "\n")
            for block in re.split(r"\n\s*\n|\n(?=\S)", words):
                for found in judge(plain(block), MOST_WORDS):
                    yield getattr(node, "lineno", 1), found


def judge_program(text):
    """Of string literals of several words. Lines with columns, as in lists of keys, are texts of their own."""
    for row in re.finditer(r'(?:"(?:[^"\\\n]|\\.)*"\s*)+', text):
        words = "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', row.group(0))).replace("\\n", "\n")
        for line in re.split(r"\n(?=[^\n]*\S  )", words):
            for found in judge(plain(line), MOST_IN_MESSAGES) if count_words(line) > 3 else ():
                yield text.count("\n", 0, row.start()) + 1, found


def judge_schema(text):
    """Descriptions of a JSON schema."""
    for row in re.finditer(r'"description": ("(?:[^"\\]|\\.)*")', text):
        for found in judge(plain(json.loads(row.group(1))), MOST_WORDS):
            yield text.count("\n", 0, row.start()) + 1, found


def judge_notebook(text):
    """Markdown cells, by the number of the cell."""
    for number, cell in enumerate(json.loads(text)["cells"], 1):
        if cell["cell_type"] == "markdown":
            yield from ((number, found) for _, found in judge_page("".join(cell["source"])))


def judge_public_header(text):
    """Comments that Doxygen reads, and strings, such as help texts."""
    yield from judge_header(text)
    yield from judge_program(text)


def list_sources(root):
    """Path and judge of each file."""
    tables = {root / "src/common" / name for name in ("warning_texts.cpp", "error_texts.cpp", "file_error_texts.cpp")}
    for name in ("README.md", "python/README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md", "examples/README.md",
                 "examples/data/README.md", "examples/ros2/README.md", "tests/benchmarks/README.md", "tests/fuzz/README.md",
                 "tools/recipes/README.md"):
        yield root / name, judge_page
    for folder, pattern, judge_file in (("docs", "*.md", judge_page), ("docs/reference", "*.schema.json", judge_schema),
                                        ("examples/notebooks", "*.ipynb", judge_notebook), ("include", "*.h", judge_public_header),
                                        ("python/pcl_uvol", "*.py", judge_module), ("python/src", "*.cpp", judge_program), ("tools", "*.cpp", judge_program),
                                        ("tools", "*.h", judge_program), ("src", "*.cpp", judge_program)):
        for path in sorted((root / folder).rglob(pattern)):
            if path not in tables:
                yield path, judge_file
    for path in sorted(tables):
        yield path, judge_messages


def main():
    root = pathlib.Path(sys.argv[1])
    findings = [f"{path.relative_to(root)}:{line}: {text}" for path, judge_file in list_sources(root)
                for line, text in judge_file(path.read_text())]
    sys.exit("\n".join(findings) or 0)


if __name__ == "__main__":
    main()
