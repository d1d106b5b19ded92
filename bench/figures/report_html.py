"""Makes the HTML of parts of the report: images, tables, facts about a run."""

import base64
import io
from html import escape

from PIL import Image

from figures.files import read_json
from figures.rows import flip, label_of, median, number, rmse, samples_text, time_text

CROP_WIDTH = 176  # width of a crop on the page, px


# ---- pictures -------------------------------------------------------------------------------------------------------


def data_uri(image, kind="png", **options):
    data = io.BytesIO()
    image.save(data, kind, **options)
    return f"data:image/{kind};base64," + base64.b64encode(data.getvalue()).decode()


def crop_image(path, crop, alternative):
    """Returns a crop of an image as an HTML element, or a note that the file is missing."""
    try:
        with Image.open(path) as image:
            x, y = crop["x"], crop["y"]
            uri = data_uri(image.convert("RGB").crop((x, y, x + crop["width"], y + crop["height"])), optimize=True)
    except OSError:
        return '<div class="gone">no picture</div>'
    return f'<img src="{uri}" width="{CROP_WIDTH}" alt="{escape(alternative)}">'


def crop_strip(results, rows, folder, crop):
    """Returns the HTML of one crop: for the reference, and for each row with its FLIP map."""
    reference = results["reference"]
    image = crop_image(folder / reference["image"], crop, f"reference, {crop['title']}")
    cells = [f'<figure class="crop">{image}<figcaption><b>reference</b><br>{reference["samples"]} lens '
             'samples at full detail</figcaption></figure>']
    for row in rows:
        label = label_of(row)
        what = f"{label}, {samples_text(row)}"
        image = crop_image(folder / row["image"], crop, f"{what}, {crop['title']}")
        error = crop_image(folder / row["errorMap"], crop, f"FLIP error of {what}: mean {row['flip']:.4f}")
        cells.append(f'<figure class="crop">{image}{error}<figcaption><b>{escape(label)}</b><br>{samples_text(row)}, '
                     f'{time_text(median(row))}<br>RMSE {rmse(row):.4f}<br>FLIP {flip(row):.4f}</figcaption></figure>')
    title = escape(crop["title"][:1].upper() + crop["title"][1:])
    return f'<h3>{title}</h3><div class="strip">{"".join(cells)}</div>'


def overview(results, folder):
    """Returns the reference image as HTML, with a frame around each crop."""
    try:
        with Image.open(folder / results["reference"]["image"]) as image:
            uri = data_uri(image.convert("RGB"), "jpeg", quality=88)
    except OSError:
        return ""
    width, height = results["width"], results["height"]
    crops = list(enumerate(results["crops"], 1))
    frames = "".join(f'<rect x="{c["x"]}" y="{c["y"]}" width="{c["width"]}" height="{c["height"]}"/>' for _, c in crops)
    numbers = "".join(f'<text x="{c["x"] + 0.012 * width}" y="{c["y"] + 0.042 * width}">{i}</text>' for i, c in crops)
    names = escape("; ".join(f"{i}: {c['title']}" for i, c in crops))
    return (f'<figure class="overview"><svg viewBox="0 0 {width} {height}" role="img"><title>The reference; framed: '
            f'{names}</title><image href="{uri}" width="{width}" height="{height}"/>'
            f'<g fill="none" stroke="#fff" stroke-width="{width / 256}">{frames}</g>'
            f'<g fill="#fff" stroke="#000" stroke-width="{width / 128}" paint-order="stroke" font-size="{0.04 * width}">'
            f'{numbers}</g></svg><figcaption>The reference. Framed: {names}.</figcaption></figure>')


def artefact_strips(folder):
    """Returns the HTML of the images in strips.json, which `scripts/figures artefacts` writes."""
    if not (folder / "strips.json").exists():
        return ""
    parts = ["<h2>Known artefacts</h2>"]
    for strip in read_json(folder / "strips.json"):
        cells = []
        for entry in strip["images"]:
            with Image.open(folder / entry["file"]) as image:
                uri, size = data_uri(image, optimize=True), f'width="{image.width}" height="{image.height}"'
            label = escape(entry["label"])
            cells.append(f'<figure class="wide"><img src="{uri}" {size} alt="{escape(strip["title"])}: {label}">'
                         f"<figcaption>{label}</figcaption></figure>")
        parts.append(f'<h3>{escape(strip["title"])}</h3><p>{escape(strip["text"])}</p><div class="pictures">{"".join(cells)}</div>')
    return "".join(parts)


def plot_figure(plot, caption):
    return plot and f'<figure class="plot">{plot}<figcaption>{caption}</figcaption></figure>'


# ---- tables ---------------------------------------------------------------------------------------------------------


def table(header, rows, left=1):
    """Returns a sortable HTML table. The first `left` columns are text; empty columns are left out."""
    full = [i for i in range(len(header)) if any(str(row[i]) for row in rows)]
    classes = ["" if i >= left else " class=text" for i in range(len(full))]
    head = "".join(f'<th scope="col"{kind}>{header[i]}</th>' for i, kind in zip(full, classes))
    lines = []
    for row in rows:
        first, *others = (row[i] for i in full)
        cells = "".join(f"<td{kind}>{cell}</td>" for cell, kind in zip(others, classes[1:]))
        lines.append(f'<tr><th scope="row">{first}</th>{cells}</tr>')
    return f'<div class="scroll"><table><thead><tr>{head}</tr></thead><tbody>{"".join(lines)}</tbody></table></div>'


def facts(results, more=()):
    """Returns an HTML table with the program, machine and settings of a bench. more: additional [name, text] lines."""
    machine = results["machine"]
    lines = [
        ["scene", f"{results['scene']}, {results['width']} × {results['height']} px" if results.get("scene") else ""],
        ["runs", f"{results['runs']} of each; medians" if results.get("runs") else ""],
        ["held equal", results.get("heldEqual")], *more,
        ["program", f"{results['program']}, commit {results['commit'] or 'unknown'}"],
        ["device", f"{results['device']}; driver {results['driver']}"],
        ["machine", f"{machine['processor'] or 'unknown processor'}, {machine['threads']} threads, "
                    f"{machine['memoryBytes'] / 2**30:.1f} GiB; {machine['system']}"],
    ]
    rows = "".join(f'<tr><th scope="row">{name}</th><td class="text">{escape(text)}</td></tr>' for name, text in lines if text)
    commands = "".join(f"<pre>{escape(command)}</pre>" for command in results["commands"])
    return (f'<table class="facts"><tbody>{rows}<tr><th scope="row">commands</th><td class="text">{commands}</td></tr>'
            "</tbody></table>")


def subject(results):
    """Returns the HTML table with the facts about a run of bench convergence."""
    lens, reference = results["lens"], results["reference"]
    remaining = reference["remaining"]
    focus = f"{lens['focusDistance']:g} m" if lens["focusDistance"] else "infinity"
    return facts(results | {"scene": ""}, [
        ["scene", f"{results['scene']}; camera “{results['camera']}”, {lens['focalLength']:g} mm, f/{lens['fStop']:g}, focused at "
                  f"{focus}; {results['width']} × {results['height']} px"],
        ["reference", f"{reference['samples']} lens samples at full detail from number {reference['firstSample']} of their "
                      f"sequence on, 32-bit layers; hash {reference['hash']}; {reference['milliseconds'] / 1000:.1f} s"
                      f"{', kept from an earlier run' if reference['reused'] else ''}. Its own remaining error, from its two "
                      f"halves: RMSE {rmse(remaining):.5f}, PSNR {number(remaining['psnr'], 2)} dB, FLIP {remaining['flip']:.4f}"],
        ["errors", results["errorsMeasuredOn"]],
    ])
