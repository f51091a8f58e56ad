"""Equations as MathML, which browsers draw by themselves: no script, nothing fetched."""

from docutils import nodes
from latex2mathml.converter import convert


def inline(writer, node):
    """An equation in a line of text."""
    writer.body.append(convert(node.astext()))
    raise nodes.SkipNode


def block(writer, node):
    """An equation of its own."""
    writer.body.append(writer.starttag(node, "div", CLASS="math"))
    writer.body.append(convert(node.astext().strip(), display="block"))
    writer.body.append("</div>\n")
    raise nodes.SkipNode


def setup(app):
    """Sphinx: `html_math_renderer = "mathml"`."""
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
