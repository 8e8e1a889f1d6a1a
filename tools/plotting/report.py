# SPDX-License-Identifier: BSD-3-Clause
"""Writes one page about a run: pictures, expectations, warnings, what was decided, input, provenance.
Called by tools/report."""

import argparse
import base64
import html
import io
import pathlib
import tomllib

import numpy as np

import outside
import plot
import series
import style
from results import Results, reader
from runlog import Log

LOOKS = """
body { font: 16px/1.45 Georgia, "Times New Roman", serif; max-width: 62em; margin: 2em auto; padding: 0 1em; color: #222 }
h1 { font-size: 1.6em; margin-bottom: 0.2em } h2 { font-size: 1.2em; margin-top: 1.8em; border-bottom: 1px solid #ccc }
table { border-collapse: collapse; font-size: 0.92em } th { text-align: left }
td, th { padding: 0.15em 0.9em 0.15em 0; vertical-align: top } td.number { text-align: right; font-variant-numeric: tabular-nums }
pre, code { font: 0.82em/1.4 "DejaVu Sans Mono", monospace } pre { overflow-x: auto; background: #f6f6f4; padding: 0.8em }
figure { display: inline-block; margin: 0.6em 1em 0.6em 0; vertical-align: top; max-width: 100% }
figure img { max-width: 100%; height: auto } figcaption { font-size: 0.85em; color: #555 }
.met { color: #00734d } .missed { color: #a33c00; font-weight: bold } .warning { color: #a33c00 }
"""


def escaped(text):
    return html.escape(str(text))


def table(rows, heading=(), numbers=()):
    """Rows of texts; columns `numbers` are aligned to the right."""
    lines = ["<tr>" + "".join(f"<th>{escaped(h)}</th>" for h in heading) + "</tr>"] if heading else []
    for row in rows:
        cells = (
            f'<td class="number">{escaped(c)}</td>' if k in numbers else f"<td>{escaped(c)}</td>"
            for k, c in enumerate(row)
        )
        lines.append("<tr>" + "".join(cells) + "</tr>")
    return "<table>\n" + "\n".join(lines) + "\n</table>"


def items(texts, kind="info"):
    lines = "".join(f"<li>{escaped(text)}</li>" for text in texts)
    return f'<ul class="{kind}">{lines}</ul>'


def expectations(log):
    if not log.expected:
        return ""
    rows = []
    for name, obtained, expected, within, verdict in log.expected:
        kind = {"met": "met", "reported": "reported"}.get(verdict, "missed")
        cells = "".join(f'<td class="number">{escaped(c)}</td>' for c in (obtained, expected, within))
        rows.append(f'<tr><td>{escaped(name)}</td>{cells}<td class="{kind}">{escaped(verdict)}</td></tr>')
    head = "".join(f"<th>{h}</th>" for h in ("expectation", "obtained", "expected", "within", ""))
    return "<h2>Expectations</h2><table><tr>" + head + "</tr>" + "".join(rows) + "</table>"


def warnings(log):
    if not log.warnings and not log.errors:
        return ""
    texts = [text if n == 1 else f"{text} ({n} times)" for text, n in log.warnings.items()]
    return "<h2>Warnings</h2>" + items([f"error: {text}" for text in log.errors] + texts, "warning")


def bodies(run):
    rows = []
    for body in run.epochs[-1]:
        shape, law = body.settings["shape"], body.settings["material"]["type"]
        rows.append((body.name, shape, law, len(body), len(body.cells), f"{body.spacing:.4g}"))
    heading = ("body", "shape", "material", "particles", "cells", f"spacing ({run.length_unit})")
    return table(rows, heading, numbers=(3, 4, 5))


def columns(run):
    rows = []
    for name, values in run.history.items():
        if name != "time":
            numbers = (values[0], values[-1], values.min(), values.max())
            rows.append((name, style.pretty(run.units[name]), *(f"{x:.6g}" for x in numbers)))
    return table(rows, ("column", "unit", "first", "last", "least", "largest"), numbers=(2, 3, 4, 5))


def figures(pictures):
    shown = []
    for name, figure in pictures.items():
        picture = io.BytesIO()
        outside.save(figure, picture, format="png", dpi=130)
        text = base64.b64encode(picture.getvalue()).decode()
        width = int.from_bytes(picture.getvalue()[16:20], "big")  # two curves side by side
        shown.append(f'<figure><img alt="{escaped(name)}" width="{0.72 * width:.0f}" '
                     f'src="data:image/png;base64,{text}">'
                     f"<figcaption>{escaped(name.replace('_', ' '))}</figcaption></figure>")  # fmt: skip
    return "\n".join(shown)


def provenance(run):
    attributes = reader.item(run.files[-1], "meta").attrs
    texts = {}
    for name in sorted(attributes):
        value = attributes[name]
        texts[name] = value.decode() if isinstance(value, bytes) else value
    return table([(name, text) for name, text in texts.items() if np.ndim(text) == 0])


def page(run, log, args):
    title = run.input.get("title") or args.dir.resolve().name
    end, factor = run.times[-1], style.scale(run.time_unit, run.times)
    begun = f"{len(run.frames)} frames to t = {end * factor[0]:.6g} {factor[1]}, step {run.steps[-1]}"
    parts = [
        f"<h1>{escaped(title)}</h1>",
        f"<p>{escaped('. '.join([begun, *log.ends[-1:]]))}</p>",
        bodies(run),
        expectations(log),
        warnings(log),
        "<h2>Pictures</h2>",
        figures(plot.pictures_of_run(run, args.field, args.frames)),
        "<h2>History</h2>",
        columns(run),
        "<h2>What was decided</h2>",
        items(log.decided),
        "<h2>Input</h2><p>With all defaults; itself a scene.</p>",
        f"<pre>{escaped(reader.item(run.files[-1], 'meta/input')[()].decode())}</pre>",
        "<h2>Provenance</h2>",
        provenance(run),
        items(log.calls) if len(log.calls) > 1 else "",
    ]
    return document(title, parts)


def page_of_series(folder):
    title = tomllib.loads(reader.text_of(folder / "scene.toml")).get("title") or folder.resolve().name
    parts = [f"<h1>{escaped(title)}</h1>"]
    for name, (heading, *rows) in series.tables(folder):
        parts += [f"<h2>{escaped(name)}</h2>", table(rows, heading, numbers=range(1, len(heading)))]
    return document(title, [*parts, "<h2>Pictures</h2>", figures(series.draw(folder))])


def document(title, parts):
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f"<title>{escaped(title)}</title><style>{LOOKS}</style></head>\n<body>\n"
        + "\n".join(part for part in parts if part)
        + "\n</body></html>\n"
    )


def main():
    parser = argparse.ArgumentParser(
        prog=style.COMMAND, description="Writes DIR/report.html, one page about a run, a sweep or a convergence."
    )
    parser.add_argument("dir", metavar="DIR", type=pathlib.Path, help="directory of the run, sweep or convergence")
    parser.add_argument("--field", help="as of tools/plot")
    parser.add_argument("--frames", type=int, help="as of tools/plot")
    args = parser.parse_args()
    path = args.dir / "report.html"
    if series.is_series(args.dir):
        text = page_of_series(args.dir)
    else:
        text = page(Results(args.dir), Log(args.dir / "run.log"), args)
    with outside.new_file(path) as made:
        made.write_text(text, encoding="utf-8")
    outside.say(path)


if __name__ == "__main__":
    outside.call(main, style.COMMAND)
