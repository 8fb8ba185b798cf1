# SPDX-License-Identifier: MIT
"""Pages of Markdown as lines, for Python: the counterpart of report/text.hpp and report/table.hpp in C++."""

import textwrap


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows] + [""]


def words(text):
    """`text` in lines of at most 120 characters."""
    return textwrap.wrap(text, 120, break_on_hyphens=False) + [""]


def bullets(sentences):
    """`sentences` as a list."""
    lines = []
    for sentence in sentences:
        lines += textwrap.wrap("- " + sentence, 120, subsequent_indent="  ", break_on_hyphens=False)
    return lines + [""]


def write(path, lines):
    path.write_text("\n".join(lines).rstrip() + "\n")
