# SPDX-License-Identifier: MIT
"""Makes NAME.ipynb (results and pictures, too) of NAME.py (cells begin with '# %%').

python3 examples/notebooks/render.py FILE.py           runs it; needs nbformat and nbconvert of Jupyter, ipykernel,
                                                       and what the notebook imports
python3 examples/notebooks/render.py -check FILE.py    whether FILE.ipynb has the cells of FILE.py, and the output
                                                       that stands on the standard input; needs nothing
"""

import base64
import json
import shutil
import subprocess
import sys


def cells_of(source):
    """[("markdown" or "code", its text)]; what comes before the first mark is the header"""
    with open(source, encoding="utf-8") as file:
        text = file.read()
    cells = []
    for part in ("\n" + text).split("\n# %%")[1:]:
        mark, body = part.split("\n", 1)
        kind = "markdown" if "[markdown]" in mark else "code"
        if kind == "markdown":
            body = "\n".join(line[2:] for line in body.split("\n"))
        cells.append((kind, body.strip("\n")))
    return cells


def fewer_colours(picture):
    png = subprocess.run(["pngquant", "64", "-"], input=base64.b64decode(picture), stdout=subprocess.PIPE, check=True)
    return base64.b64encode(png.stdout).decode()


def render(source):
    import nbformat
    from nbconvert.preprocessors import ExecutePreprocessor

    new = {"markdown": nbformat.v4.new_markdown_cell, "code": nbformat.v4.new_code_cell}
    notebook = nbformat.v4.new_notebook(cells=[new[kind](body) for kind, body in cells_of(source)])
    notebook.metadata["kernelspec"] = {"display_name": "Python 3", "language": "python", "name": "python3"}
    ExecutePreprocessor(timeout=600).preprocess(notebook)
    for number, cell in enumerate(notebook.cells):  # the same file, if nothing has changed
        cell["id"] = "cell-%d" % number
        cell.metadata.pop("execution", None)
        for output in cell.get("outputs", []):
            if "image/png" in output.get("data", {}) and shutil.which("pngquant"):
                output.data["image/png"] = fewer_colours(output.data["image/png"])
    with open(source[:-3] + ".ipynb", "w", encoding="utf-8") as file:
        nbformat.write(notebook, file)


def check(source, said):
    """sentences on what is not as it should be"""
    with open(source[:-3] + ".ipynb", encoding="utf-8") as file:
        kept = json.load(file)["cells"]
    if [(cell["cell_type"], "".join(cell["source"])) for cell in kept] != cells_of(source):
        yield "its cells are not those of " + source
    outputs = [output for cell in kept for output in cell.get("outputs", [])]
    if "".join("".join(o["text"]) for o in outputs if o.get("name") == "stdout") != said:
        yield "what it printed is not what %s prints" % source
    if not any("image/png" in output.get("data", {}) for output in outputs):
        yield "it has no picture"


def main(arguments):
    if arguments[:1] == ["-check"] and len(arguments) == 2:
        wrong = list(check(arguments[1], sys.stdin.read()))
        for sentence in wrong:
            print("%s: %s; make it anew with render.py" % (arguments[1][:-3] + ".ipynb", sentence))
        return 1 if wrong else 0
    if len(arguments) == 1 and arguments[0].endswith(".py"):
        return render(arguments[0])
    print(__doc__, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
