#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the structure of include/hmps, examples and benchmarks: which folder may include or use which, no circles,
nothing too long.

Folders of include/hmps are layers: a header includes headers of its own folder and of those before it in LAYERS. No
header includes itself by way of others. A folder of benchmarks includes itself and what SHARED says, by its path from
there. A header with nothing but hmps::detail is in a folder detail. Of benchmarks only the folders INNER use
hmps::detail and these headers; examples do not. Loops of the library are guarded(execute)(n, body). A file has at most
MOST_LINES lines, a function at most MOST_FUNCTION_LINES.
"""

import pathlib
import re
import sys

LAYERS = ["core", "lanes", "search", "bonds", "laws", "terms", "force", "contact", "motion", "shapes", "particles",
          "time", "analysis", "diagnostics", "output", "executors"]
# What a folder of benchmarks may include of others: a study the first two, a component's benchmark the last.
SHARED = {"report": [], "scenes": [], "components": [], "hmps": ["components"]}
STUDY = ["report", "scenes"]
INNER = ["components", "hmps"]
# Headers in detail that define a class of the interface, which contact.hpp includes together.
PARTS_OF_CONTACT = "hmps/contact/detail/contact_"
# The headers that may call an executor as it is.
LOOPS = ["hmps/core/executor.hpp"]
MOST_LINES = 300
MOST_FUNCTION_LINES = 60

QUOTED = re.compile(r'^#include "([^"]+)"', re.M)
INCLUDE = re.compile(r'^#include [<"](hmps/[\w/]+\.hpp)[>"]', re.M)
# What opens a block that is no function.
SCOPE = re.compile(r"\b(namespace|struct|class|union|enum|concept)\b[^;(]*$|=\s*$|\brequires\b[^)]*$|extern \"C\"")


def without_comments(text):
    """The text with comments, strings and characters blanked, line breaks kept."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group(0))
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])\'', blank, text, flags=re.S)


def functions(text):
    """(first line, number of lines) of each outermost block that belongs to a function."""
    text = without_comments(text)
    text = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", lambda m: re.sub(r"[^\n]", " ", m.group(0)), text, flags=re.M)
    found, scopes, begin = [], [], 0  # scopes: True for a block within a function
    for k, character in enumerate(text):
        if character == "{":
            head = text[begin:k].strip()
            inside = bool(scopes) and scopes[-1] is not None
            if inside:
                scopes.append(0)
            elif SCOPE.search(head) and not head.endswith(")"):
                scopes.append(None)
            else:
                scopes.append(text.count("\n", 0, k) + 1)
            begin = k + 1
        elif character == "}":
            first = scopes.pop() if scopes else None
            if first:
                found.append((first, text.count("\n", 0, k) + 2 - first))
            begin = k + 1
        elif character == ";":
            begin = k + 1
    return found


def circle(graph):
    """A list of headers, each of which includes the next, that ends where it begins; empty if there is none."""
    done, path = set(), []

    def visit(node):
        if node in path:
            return path[path.index(node):] + [node]
        if node in done:
            return []
        path.append(node)
        for other in graph.get(node, []):
            found = visit(other)
            if found:
                return found
        path.pop()
        done.add(node)
        return []

    for start in graph:
        found = visit(start)
        if found:
            return found
    return []


def lengths(name, text):
    """What is too long in a file."""
    lines = text.count("\n")
    if lines > MOST_LINES and name != "include/hmps/hmps.hpp":
        yield f"{name} has {lines} lines; {MOST_LINES} are allowed"
    for line, length in functions(text):
        if length > MOST_FUNCTION_LINES:
            yield f"{name}:{line}: a function of {length} lines; {MOST_FUNCTION_LINES} are allowed"


def outside_detail(text):
    """What a header declares outside of namespace detail."""
    text = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", "", without_comments(text), flags=re.M)
    kept, scopes, begin = [], [], 0  # scopes: True for the namespace detail
    for k, character in enumerate(text):
        if character == "{":
            head = text[begin:k].strip()
            is_namespace = head.startswith("namespace")
            if not is_namespace and not any(scopes):
                kept.append(head)
            scopes.append(is_namespace and "detail" in head)
            begin = k + 1
        elif character in "};":
            if not any(scopes):
                kept.append(text[begin:k].strip())
            if character == "}" and scopes:
                scopes.pop()
            begin = k + 1
    return "".join(kept)


def check_benchmarks(root):
    folders = {path.name for path in (root / "benchmarks").iterdir() if path.is_dir()}
    for path in sorted((root / "benchmarks").rglob("*.[hc]pp")):
        name, text = str(path.relative_to(root)), path.read_text(encoding="utf-8")
        yield from lengths(name, text)
        folder = name.split("/")[1]
        for other in QUOTED.findall(text):
            target = other.split("/")[0]
            if target == "..":
                yield f"{name} includes {other}: write the path from benchmarks or examples"
            elif target in folders - {"hmps", folder, *SHARED.get(folder, STUDY)}:
                yield f"{name} includes {other}: what folders share belongs to {' or '.join(STUDY)}"


def check_inner(root):
    """Uses of hmps::detail in programs that users read as models."""
    for path in sorted([*(root / "examples").rglob("*.[hc]pp"), *(root / "benchmarks").rglob("*.[hc]pp")]):
        name = str(path.relative_to(root))
        if name.split("/")[1] in INNER:
            continue
        for number, line in enumerate(without_comments(path.read_text(encoding="utf-8")).splitlines(), 1):
            if re.search(r"\bhmps::detail\b", line):
                yield f"{name}:{number} uses hmps::detail, which is for the library alone"
        for header in re.findall(r"hmps/[\w/]*detail/[\w/]+\.hpp", path.read_text(encoding="utf-8")):
            yield f"{name} includes {header}, which is for the library alone"


def unguarded(name, text):
    """Loops whose exceptions would reach an executor of the user's, which need not handle them."""
    if name in LOOPS:
        return
    for number, line in enumerate(without_comments(text).splitlines(), 1):
        if re.search(r"(?<![\w:.])execute_?\((?!execute\))", line):
            yield f"include/{name}:{number} calls execute: call detail::guarded(execute), which handles exceptions"


def check(root):
    problems, graph = [*check_benchmarks(root), *check_inner(root)], {}
    for path in sorted((root / "include").rglob("*.hpp")):
        name = str(path.relative_to(root / "include"))
        text = path.read_text(encoding="utf-8")
        graph[name] = INCLUDE.findall(text)
        problems += lengths(f"include/{name}", text)
        problems += unguarded(name, text)
        folder = name.split("/")[1]
        if name == "hmps/hmps.hpp":
            continue
        if folder not in LAYERS:
            problems.append(f"include/{name}: the folder {folder} has no place in LAYERS")
            continue
        declares, inner = outside_detail(text), name.split("/")[2] == "detail"
        if re.search(r"^namespace ", text, flags=re.M) and not declares and not inner:
            problems.append(f"include/{name} has nothing but hmps::detail: it belongs into hmps/{folder}/detail")
        if declares and inner and not name.startswith(PARTS_OF_CONTACT):
            problems.append(f"include/{name} declares something outside hmps::detail: it belongs into hmps/{folder}")
        for other in graph[name]:
            target = other.split("/")[1]
            if target in LAYERS and LAYERS.index(target) > LAYERS.index(folder):
                problems.append(f"include/{name} includes {other}: {folder} is below {target}")
    found = circle(graph)
    if found:
        problems.append("headers that include each other: " + " -> ".join(found))
    return problems


if __name__ == "__main__":
    problems = check(pathlib.Path(__file__).resolve().parents[2])
    print("\n".join(problems) if problems else "include/hmps, examples and benchmarks: layers, circles and lengths are as they should be")
    sys.exit(1 if problems else 0)
