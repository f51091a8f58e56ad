"""The tutorials as a code host shows them: Markdown with what the cells computed, pictures beside.

`python tests/docs/rendered.py` writes them into tests/docs/tutorials, for the README. What
`build_site.py` has executed in results/site is not executed again.
"""

import base64
import io
import re
from pathlib import Path

from build_site import ROOT, environment
from nbformat import NotebookNode
from notebooks import PAGES, Executed, is_notebook
from PIL import Image

FOLDER = Path(__file__).resolve().parent / "tutorials"
HEAD = "<!-- made by tests/docs/rendered.py from tests/docs/site/tutorials/{} -->\n\n"
LANGUAGES = {".toml": "toml", ".py": "python", ".c": "c", ".xml": "xml"}
#: Colours of a picture: lines on white paper have few.
COLOURS = 64


def rendered(page: Path, notebook: NotebookNode) -> tuple[str, dict[str, bytes]]:
    """Text of a page whose cells were executed; name -> content of the pictures that it shows."""
    parts, pictures = [], dict[str, bytes]()
    for cell in notebook.cells:
        if "remove-cell" in cell.metadata.get("tags", []):
            continue
        if cell.cell_type != "code":
            parts.append(_prose(cell.source))
            continue
        parts.append(_code(cell.source))
        for output in cell.outputs:
            data = output.get("data", {})
            if "image/png" in data:
                name = f"{page.stem}_{len(pictures) + 1}.png"
                pictures[name] = _small(base64.b64decode(data["image/png"]))
                parts.append(f"![what the cell above draws]({name})")
            elif said := output.get("text") or data.get("text/plain"):
                parts.append(f"```text\n{said.rstrip()}\n```")
    return HEAD.format(page.name) + "\n\n".join(parts) + "\n", pictures


def _prose(text: str) -> str:
    """Markdown with links from where it is, without what only the site has."""
    text = re.sub(r"\{nb-download\}`[^`]+`\s+is\s+this\s+page\s+as\s+a\s+notebook\.", "", text)
    text = re.sub(r"<!--\n```\{toctree\}.*?-->\n?", "", text, flags=re.S)
    text = re.sub(r"\n{3,}", "\n\n", text)
    return re.sub(r"\]\(\.\./(?!\.\.)", "](../site/", text).strip()


def _code(source: str) -> str:
    """A cell, in the words of where it is typed: a terminal, a file, Python."""
    magic, _, rest = source.partition("\n")
    if magic == "%%bash":
        return f"```sh\n{rest}\n```"
    if magic.startswith("%%writefile "):
        name = magic.removeprefix("%%writefile ").strip()
        return f"`{name}`:\n\n```{LANGUAGES.get(Path(name).suffix, 'text')}\n{rest}\n```"
    return f"```python\n{source}\n```"


def _small(png: bytes) -> bytes:
    image = Image.open(io.BytesIO(png)).convert("RGB")
    file = io.BytesIO()
    image.quantize(COLOURS, dither=Image.Dither.NONE).save(file, "png", optimize=True)
    return file.getvalue()


def main() -> None:
    """Write all pages and their pictures, in place of those that were there."""
    folder = ROOT / "results" / "site"
    executed = Executed(folder / "cache", environment(folder))
    FOLDER.mkdir(exist_ok=True)
    for old in FOLDER.iterdir():
        old.unlink()
    for page in filter(is_notebook, sorted(PAGES.glob("*.md"))):
        text, pictures = rendered(page, executed(page))
        (FOLDER / page.name).write_text(text, encoding="utf-8")
        for name, content in pictures.items():
            (FOLDER / name).write_bytes(content)


if __name__ == "__main__":
    main()
