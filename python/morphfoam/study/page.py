# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Parts of HTML pages."""

import base64
import html
from pathlib import Path

STYLE = """
body { font: 15px/1.5 sans-serif; max-width: 70em; margin: 2em auto;
       padding: 0 1em; color: #222; }
h1, h2, h3 { line-height: 1.2; } h2 { margin-top: 2em; }
table { border-collapse: collapse; font-size: 13px; margin: 1em 0; }
th, td { padding: .2em .7em; text-align: right; border-bottom: 1px solid #ddd;
         font-variant-numeric: tabular-nums; }
th { border-bottom: 2px solid #888; position: sticky; top: 0;
     background: #fff; }
td.text { text-align: left; min-width: 18em; overflow-wrap: anywhere; }
.wide { overflow: auto; max-height: 80vh; } img { max-width: 100%; }
figure { display: inline-block; margin: 0 1em 1em 0; width: 20em;
         vertical-align: top; } figcaption { font-size: 13px; color: #555; }
tr.failed td { background: #fdecea; }
"""


# Columns of words
TEXTS = (
    "reason",
    "where",
    "expression",
    "class",
    "the first says",
    "note",
    "why",
    "which",
)


def text(value):
    """A value as a reader wants it."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        return html.escape("" if value is None else str(value))
    return f"{number:.5g}"


def table(rows, columns=None, links=None):
    """An HTML table of dictionaries. links: {design: its page}."""
    if not rows:
        return "<p>None.</p>"
    columns = columns or list(dict.fromkeys(k for row in rows for k in row))
    head = "".join(f"<th>{html.escape(c)}</th>" for c in columns)
    body = ""
    for row in rows:
        # A design's number is a name
        cells = "".join(
            f"<td>{linked(str(row[c]), links)}</td>"
            if c == "design"
            else "<td{}>{}</td>".format(
                ' class="text"' if c in TEXTS else "",
                text(row.get(c, "")),
            )
            for c in columns
        )
        failed = ' class="failed"' if row.get("status") == "failed" else ""
        body += f"<tr{failed}>{cells}</tr>\n"
    return f'<div class="wide"><table><tr>{head}</tr>\n{body}</table></div>'


def linked(name, links):
    """A design's name, with its page behind it."""
    target = (links or {}).get(name)
    name = html.escape(name)
    return (
        f'<a href="{html.escape(str(target))}">{name}</a>' if target else name
    )


def image(path, alt=""):
    data = base64.b64encode(Path(path).read_bytes()).decode()
    return f'<img alt="{html.escape(alt)}" src="data:image/png;base64,{data}">'


def document(title, parts, head=""):
    """A whole page."""
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f"{head}<title>{title}</title><style>{STYLE}</style></head><body>\n"
        + "\n".join(parts)
        + "\n</body></html>\n"
    )
