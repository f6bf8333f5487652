# SPDX-License-Identifier: MIT
"""Pictures with matplotlib: a body by one of its fields, and its motion."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Sequence

import numpy as np

if TYPE_CHECKING:
    from ._body import Body

# read by eyes of every kind, and in grey
COLOURS, SIGNED, CRACK = "cividis", "RdBu_r", "#d7191c"
TENSOR = {2: ("xx", "yy", "xy"), 3: ("xx", "yy", "zz", "xy", "yz", "xz")}


def values_of(body: Body, field: Any, component: Any = None) -> tuple[np.ndarray, str]:
    """One number a point, and what to call it: a component of a field, as "y" or "xy"; else the length of a vector, von Mises' number of a
    stress, and of other tensors the length. `field` may be an array with a number for each point."""
    if not isinstance(field, (str, int)):
        return np.asarray(field, float).reshape(body.point_count), ""
    values, name = body.field(field), str(field).lower().replace("_", " ")
    if values.ndim == 1:
        return values, "fragment" if field == 2017 else name
    names = ("x", "y", "z")[:body.dimension] if values.shape[1] == body.dimension else TENSOR[body.dimension]
    if component is not None:
        if component not in names:
            raise ValueError("component: %r is none of %s" % (component, ", ".join(names)))
        return values[:, names.index(component)], "%s %s" % (name, component)
    if len(names) == body.dimension:
        return np.hypot.reduce(values, axis=1), name
    if "stress" in name:
        normal, shear = values[:, :body.dimension], values[:, body.dimension:]
        if body.dimension == 2:
            normal = np.pad(normal, ((0, 0), (0, 1)))
        mises = 0.5 * sum((normal[:, i] - normal[:, j]) ** 2 for i, j in ((0, 1), (1, 2), (2, 0))) + 3 * (shear ** 2).sum(axis=1)
        return np.sqrt(mises), name + ", von Mises"
    return np.sqrt((values ** 2).sum(axis=1)), name


def scale_of(body: Body, deformed: Any) -> float:
    """How much displacements are enlarged: a number; True is 1; "auto" makes the largest a tenth of the body."""
    if deformed != "auto":
        return float(deformed)
    most, x = np.abs(body.displacement.copy()).max(), body.position.copy()
    return 0.1 * np.ptp(x, axis=0).max() / most if most > 0 else 0.0


class _Scene:
    """What one picture shows; taken from the body at once, drawn later."""

    def __init__(self, body: Body, field: Any, component: Any, deformed: Any, cracks: bool) -> None:
        self.dimension, self.time = body.dimension, body.time
        self.values, self.name = values_of(body, field, component)
        self.fragments = self.name == "fragment"
        scale = scale_of(body, deformed)
        self.title = "" if scale in (0, 1) else ", displacement x %.3g" % scale
        if body.dimension == 2:
            place = body.position.copy() + scale * body.displacement.copy()
            half = 0.5 * np.sqrt(body.field("volume"))[:, None]
            if scale:  # cells grow as they part, so that no slits show where there is no crack
                half = half * 1.03 * np.clip(1 + scale * body.field("strain")[:, :2], 0.7, 1.5)
            self.cells = np.stack([place - half, place + half], axis=1)  # two corners
            self.lines = []
            if cracks and scale in (0, 1):  # what is enlarged gapes
                with body.cracks(current=int(scale)) as found:
                    self.lines = found.lines()
            return
        vertices, faces, owners, _ = body.get_outline(-1)
        move = np.zeros_like(vertices)
        count = np.zeros(len(vertices))
        for corner in faces.T:
            np.add.at(move, corner, body.displacement.copy()[owners])
            np.add.at(count, corner, 1)
        vertices = vertices + (scale - 1) * move / np.maximum(count, 1)[:, None]
        self.cells, self.values, self.lines = vertices[faces], self.values[owners], []

    def draw(self, ax: Any, cmap: Any, limits: Any, legend: bool) -> Any:
        import matplotlib
        from matplotlib import cm, colors
        lo, hi = limits
        if self.fragments:
            number = int(hi) + 1
            table = np.array(matplotlib.colormaps["tab20"].colors)
            mapping = cm.ScalarMappable(colors.BoundaryNorm(np.arange(number + 1) - 0.5, max(number, 2)),
                                        colors.ListedColormap(table[np.arange(max(number, 2)) % 20]))
        else:
            mapping = cm.ScalarMappable(colors.Normalize(lo, hi), cmap or (SIGNED if lo < 0 < hi else COLOURS))
        rgba = mapping.to_rgba(self.values)
        if self.dimension == 2:
            from matplotlib.collections import LineCollection
            image, (at, end) = self.raster(rgba)
            ax.imshow(image, extent=(at[0], end[0], at[1], end[1]), origin="lower", interpolation="nearest", zorder=1)
            if self.lines:
                ax.add_collection(LineCollection(self.lines, colors=CRACK, linewidths=1.2))
        else:
            from mpl_toolkits.mplot3d.art3d import Poly3DCollection
            normal = np.cross(self.cells[:, 1] - self.cells[:, 0], self.cells[:, 2] - self.cells[:, 0])
            normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
            rgba[:, :3] *= (0.7 + 0.3 * np.abs(normal @ np.array([0.3, -0.5, 0.81])))[:, None]
            ax.add_collection3d(Poly3DCollection(self.cells, facecolors=np.clip(rgba, 0, 1), edgecolors="none"))
        if legend:
            ticks = np.arange(int(hi) + 1) if self.fragments and hi < 12 else None
            extend = ("min" if self.values.min() < lo else "") + ("max" if self.values.max() > hi else "")
            ax.figure.colorbar(mapping, ax=ax, label=self.name, shrink=0.8, ticks=ticks,
                               extend={"": "neither", "minmax": "both"}.get(extend, extend))
        return mapping

    def raster(self, rgba: np.ndarray) -> tuple[np.ndarray, tuple]:
        """The cells as an image: of tens of thousands, a hundred times as fast as polygons."""
        lo, hi = self.frame()
        side = (self.cells[:, 1] - self.cells[:, 0]).min()
        size = np.maximum(np.ceil((hi - lo) / max(side / 4, (hi - lo).max() / 2000) - 1e-6).astype(int), 1)
        pixel = (hi - lo) / size
        first, end = (np.ceil((self.cells[:, k] - lo) / pixel - 0.5 - 1e-6).astype(int) for k in (0, 1))
        image = np.zeros((size[1], size[0], 4))
        for i in range((end - first)[:, 0].max()):
            for j in range((end - first)[:, 1].max()):
                column, row = first[:, 0] + i, first[:, 1] + j
                inside = (column < end[:, 0]) & (row < end[:, 1]) & (column < size[0]) & (row < size[1])
                image[row[inside], column[inside]] = rgba[inside]
        return image, (lo, hi)

    def frame(self) -> tuple[np.ndarray, np.ndarray]:
        flat = self.cells.reshape(-1, self.dimension)
        return flat.min(axis=0), flat.max(axis=0)


def limits_of(scenes: Sequence[_Scene], limits: Any) -> tuple[float, float]:
    if limits is not None:
        return limits
    everything = np.concatenate([s.values for s in scenes])
    lo, hi = everything.min(), everything.max()
    if scenes[0].fragments:
        return 0, hi
    if scenes[0].name.startswith("damage"):
        return 0, max(hi, 0.5)
    lo, hi = np.percentile(everything, [0.5, 99.5])  # peaks at tips would leave no colour to the rest
    if lo < 0 < hi:  # a colour for 0
        hi = max(hi, -lo)
        lo = -hi
    return (lo, hi) if hi > lo else (lo, lo + (abs(lo) or 1))


def _prepared(ax: Any, dimension: int, box: tuple, axis_names: bool = True) -> None:
    lo, hi = box
    edge = 0.03 * (hi - lo).max() + 1e-300
    ax.set_xlim(lo[0] - edge, hi[0] + edge)
    ax.set_ylim(lo[1] - edge, hi[1] + edge)
    if dimension == 3:
        ax.set_zlim(lo[2] - edge, hi[2] + edge)
        ax.set_box_aspect(hi - lo + 2 * edge)
        ax.set_zlabel("z")
    else:
        ax.set_aspect("equal")
    ax.set_xlabel("x")
    ax.set_ylabel("y")


def _size(box: tuple) -> tuple[float, float]:
    wide, high = (box[1] - box[0])[:2]
    part = float(np.clip(high / max(wide, 1e-300), 0.25, 1.4))
    return 8.0, 8.0 * part + 1.0


def plot(body: Body, field: Any = "damage", *, component: str | None = None, deformed: Any = 0, cracks: bool = False, ax: Any = None,
         cmap: Any = None, limits: tuple[float, float] | None = None, title: str | None = None, colorbar: bool = True) -> Any:
    """Draws the body, each point as its cell, coloured by a field; returns the axes.

        field: a name, as "damage", "velocity", "stress", "fragment"; or an array with a number for each point
        component: "x", "y", "xy", ...; else a vector is shown by its length, a stress by von Mises' number
        deformed: 0: reference positions; True: where the body is; a number enlarges displacements; "auto"
        cracks: 2D, deformed 0 or True: draws the cracks as lines
        ax: axes to draw on (3D: of projection="3d"); else a new figure
        limits: (least, most) of the colours; else, of damage, from 0, and of other fields all but the outermost 1 %
    """
    scene = _Scene(body, field, component, deformed, cracks)
    if ax is None:
        import matplotlib.pyplot as plt
        figure = plt.figure(figsize=_size(scene.frame()), layout="constrained")
        ax = figure.add_subplot(projection="3d" if scene.dimension == 3 else None)
    scene.draw(ax, cmap, limits_of([scene], limits), colorbar)
    _prepared(ax, scene.dimension, scene.frame())
    ax.set_title(title if title is not None else "%s at time %.3g%s" % (scene.name, scene.time, scene.title))
    return ax


def animate(body: Body, path: str | os.PathLike[str] | None = None, *, field: Any = "damage", component: str | None = None, deformed: Any = 0,
            cracks: bool = False, frames: int = 50, fps: float = 20, dpi: float = 100, cmap: Any = None,
            limits: tuple[float, float] | None = None, title: str | None = None, **advance: Any) -> Any:
    """Advances the body, as body.advance(**advance) would (steps=... or duration=... is needed), and shows about `frames` pictures of it.

    path: .gif; .html, a page by itself; or what matplotlib finds a writer for, as .mp4. Returns the path. Without a path: an object that
    a notebook shows. Colours are the same in all frames. Other arguments: see peri.plotting.plot."""
    from matplotlib.animation import FuncAnimation, PillowWriter
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    step = advance.get("time_step") or advance.get("safety", 0.9) * body.stable_step
    steps = advance.get("steps") or int(np.ceil(advance.get("duration", 0) / step))
    scenes = [_Scene(body, field, component, deformed, cracks)]
    mine = advance.pop("on_frame", None)

    def on_frame(body: Body) -> Any:
        scenes.append(_Scene(body, field, component, deformed, cracks))
        return mine(body) if mine else 0
    options: dict[str, Any] = {"frame_steps": max(1, steps // max(frames, 1)), **advance}
    body.advance(**options, on_frame=on_frame)
    if len(scenes) > 2 and scenes[-1].time == scenes[-2].time:
        scenes.pop()
    boxes = [s.frame() for s in scenes]
    box = np.min([b[0] for b in boxes], axis=0), np.max([b[1] for b in boxes], axis=0)
    figure = Figure(figsize=_size(box), dpi=dpi, layout="constrained")
    FigureCanvasAgg(figure)
    ax = figure.add_subplot(projection="3d" if body.dimension == 3 else None)
    shown = limits_of(scenes, limits)

    def show(k: int, legend: bool = False) -> list:
        for old in list(ax.collections) + list(ax.images):
            old.remove()
        scenes[k].draw(ax, cmap, shown, legend)
        ax.set_title("%s at time %.3g%s" % (title or scenes[k].name, scenes[k].time, scenes[k].title))
        return []
    show(0, legend=True)
    _prepared(ax, body.dimension, box)
    figure.canvas.draw()  # arranges axes and legend, once
    figure.set_layout_engine(None)
    film = FuncAnimation(figure, show, frames=len(scenes), interval=1000 / fps, init_func=lambda: [])
    if path is None:
        text = film.to_jshtml(fps=fps)
        try:
            from IPython.display import HTML
            return HTML(text)
        except ImportError:
            return text
    path = os.fspath(path)
    if path.endswith(".html"):
        with open(path, "w") as f:
            f.write("<!DOCTYPE html><meta charset=utf-8><title>peri</title>" + film.to_jshtml(fps=fps))
    else:
        film.save(path, writer=PillowWriter(fps=fps) if path.endswith(".gif") else None, dpi=dpi)
    return path
