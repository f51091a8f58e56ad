"""Temperature of belt and ice as an animation: a GIF, which every browser plays.

Seen from the rig: the block goes to and fro over the fixed springs' middle, and marks go by on the
belt, which an arrow says the direction of.
"""

import io
from typing import Any, NamedTuple

import matplotlib
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import QuadMesh
from matplotlib.colors import Normalize, to_rgb
from matplotlib.figure import Figure
from matplotlib.transforms import Affine2D
from PIL import Image

from cosim.report.columns import Array
from cosim.report.contents import Views
from cosim.report.palette import GREY, HEAT_MAP, INK, SKY, readable
from cosim.report.style import RC, plain_ticks
from thermal import RigView

#: s: how long an animation lasts, within what the eye follows (frames per second).
LASTS = 12.0
SLOWEST, FASTEST = 3, 25
DPI = 100
#: Ice above the height to which this part of the largest rise reaches is not shown.
FAINT = 0.01
LEAST_HEIGHT = 5e-3
SMALLEST_RISE = 1e-9


#: m between two marks on the belt, and of the arrow that shows where it goes.
MARKS = 0.1


class Moving(NamedTuple):
    """Where block and surface are: x and travel (times,) m at time (times,) s."""

    time: Array
    x: Array
    travel: Array

    def at(self, time: float) -> list[float]:
        """x and travel, m, at a time, s."""
        return [float(np.interp(time, self.time, each)) for each in (self.x, self.travel)]


STANDING = Moving(np.zeros(1), np.zeros(1), np.zeros(1))


def animation(views: Views, ambient: float, name: str, moving: Moving = STANDING) -> bytes:
    """A GIF file of at least one view (time in s, what is seen), one frame for each.

    ambient: degC of the air; name: of the case. moving: left out, neither block nor belt do.
    """
    palette = _palette()
    with matplotlib.rc_context(RC):
        picture = _Picture(views, ambient, name, moving)
        frames = [
            picture.frame(time, view).quantize(palette=palette, dither=Image.Dither.NONE)
            for time, view in views
        ]
    speed = np.clip(len(frames) / LASTS, SLOWEST, FASTEST)
    file, (first, *rest) = io.BytesIO(), frames
    how = {"save_all": True, "duration": round(1000.0 / speed), "loop": 0}
    first.save(file, format="GIF", append_images=rest, **how)
    return file.getvalue()


def _palette() -> Image.Image:
    """The same 256 colours for all frames, those of the map above all: no steps, no flicker."""
    map_ = matplotlib.colormaps[HEAT_MAP](np.linspace(0.0, 1.0, 239))[:, :3]
    greys = np.linspace(0.0, 1.0, 16)[:, None] * np.ones(3)
    colours = np.concatenate((map_, greys, [to_rgb(SKY)]))
    image = Image.new("P", (1, 1))
    image.putpalette(np.round(255.0 * colours).astype(np.uint8).tobytes())
    return image


class _Picture:
    """The figure of which each frame changes the colours and the time."""

    def __init__(self, views: Views, ambient: float, name: str, moving: Moving) -> None:
        self._ambient, self._name, self._moving = ambient, name, moving
        highest = [max(np.nanmax(view.belt), np.nanmax(view.ice)) for _, view in views]
        rises = np.array(highest) - ambient
        self._scaled = readable(rises, "K", SMALLEST_RISE)
        top = self._scaled.factor * max(float(rises.max()), SMALLEST_RISE)
        self._norm = Normalize(0.0, top)
        first = views[0][1]
        figure = Figure(figsize=(9.0, 5.6), dpi=DPI, layout="constrained")
        self._canvas = FigureCanvasAgg(figure)
        ice, belt = figure.subplots(2, 1, height_ratios=[1.6, 1.0])
        self._ice = self._mesh(ice, first.x, first.height, first.ice)
        self._belt = self._mesh(belt, first.offset, -first.depth, first.belt)
        self._ways: list[Affine2D] = []
        self._move(self._ice, ice)
        self._move(self._belt, belt)
        left, right = (1e3 * float(pick(moving.x, initial=0.0)) for pick in (np.nanmin, np.nanmax))
        ice.set_xlim(1e3 * first.x.min() + left, 1e3 * first.x.max() + right)
        # the loop's ends, which are one place, go to and fro with the block
        belt.set_xlim(1e3 * first.offset.min() + right, 1e3 * first.offset.max() + left)
        ice.set_ylim(0.0, 1e3 * _shown_height(views, ambient))
        _label(ice, "ice, section through its middle: the part at the contact", "above the contact")
        self._label_belt(belt, first.contact)
        figure.colorbar(self._ice, ax=[ice, belt], label=f"rise over the air [{self._scaled.unit}]")
        self._title = figure.suptitle("", x=0.008, ha="left", color=INK)

    def _mesh(self, axes: Axes, x: Array, z: Array, field: Array) -> QuadMesh:
        look: Any = {"cmap": HEAT_MAP, "norm": self._norm, "rasterized": True}
        look |= {"shading": "gouraud" if np.isfinite(field).all() else "nearest"}
        return axes.pcolormesh(1e3 * x, 1e3 * z, self._rise(field), **look)

    def _move(self, artist: Artist, axes: Axes) -> None:
        """Let a thing go with the block."""
        self._ways.append(Affine2D())
        artist.set_transform(self._ways[-1] + axes.transData)

    def _rise(self, field: Array) -> Array:
        return np.ma.masked_invalid(self._scaled(field.T - self._ambient))

    def _label_belt(self, axes: Axes, contact: float) -> None:
        half = 0.5e3 * contact
        look: Any = {"linewidth": 5.0, "clip_on": False, "solid_capstyle": "butt"}
        (stands,) = axes.plot([-half, half], [0.0, 0.0], color=SKY, **look)
        self._move(stands, axes)
        (self._marks,) = axes.plot([], [], "|", color="white", markersize=8.0)
        gone = float(self._moving.travel[-1] - self._moving.travel[0])
        arrow = {0.0: "", 1.0: "; it moves to the right →", -1.0: "; it moves to the left ←"}
        title = "belt, the whole loop; the ice stands on the blue line"
        _label(axes, f"{title}{arrow[float(np.sign(gone))]}", "depth")
        axes.yaxis.set_major_formatter(lambda depth, _: f"{abs(depth):g}")

    def frame(self, time: float, view: RigView) -> Image.Image:
        """The picture at a time (s)."""
        self._ice.set_array(self._rise(view.ice))
        self._belt.set_array(self._rise(view.belt))
        x, travel = self._moving.at(time)
        for way in self._ways:
            way.clear().translate(1e3 * x, 0.0)
        first, last = view.offset.min(), view.offset.max()
        marks = MARKS * np.arange(np.floor(first / MARKS), np.ceil(last / MARKS)) + travel % MARKS
        depth = -0.5e3 * float(view.depth.max())
        self._marks.set_data(1e3 * marks, np.full(marks.size, depth))
        self._title.set_text(f"Temperature of ice and belt: {self._name}, t = {time:.2f} s")
        self._canvas.draw()
        return Image.fromarray(np.asarray(self._canvas.buffer_rgba())).convert("RGB")


def _label(axes: Axes, title: str, upwards: str) -> None:
    axes.set(title=title, xlabel="along the belt, from the middle of the rig [mm]")
    axes.set_ylabel(f"{upwards} [mm]")
    plain_ticks(axes)
    axes.grid(visible=False)
    for spine in axes.spines.values():
        spine.set_color(GREY)


def _shown_height(views: Views, ambient: float) -> float:
    """Height (m) of the ice up to which there is something to see."""
    warm = np.nanmax([np.nanmax(view.ice, axis=0) for _, view in views], axis=0) - ambient
    height = views[0][1].height
    seen = height[warm > FAINT * max(float(np.nanmax(warm)), SMALLEST_RISE)]
    highest = 1.2 * float(seen.max()) if seen.size else 0.0
    return min(max(highest, LEAST_HEIGHT), float(height.max()))
