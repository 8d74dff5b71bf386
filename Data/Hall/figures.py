"""Pictures of the hall: maps and sign images with matplotlib, the 3-D view with ParaView."""
import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402
from matplotlib.colors import ListedColormap, LogNorm  # noqa: E402
from matplotlib.patches import Patch, Rectangle  # noqa: E402
from paraview import simple  # noqa: E402

import scene  # noqa: E402

THRESHOLD = 0.2
PLACES = (12, 8)
SIGN_COLOUR = "#00a050"
# One luminance scale for all sign images [cd/m2]: from well below what an eye sees to a lit bar.
DARKEST, BRIGHTEST = 1e-3, 300.0


def sign_table():
    """Centres and normals of the signs."""
    with open(scene.SIGNS, encoding="utf-8") as file:
        lines = [line.strip().split(",") for line in file if not line.startswith("#")]
    column = {name: lines[0].index(name) for name in ("cx", "cy", "nx", "ny")}
    return [{name: float(line[i]) for name, i in column.items()} for line in lines[1:]]


def draw_map(axes, visibility, small=False):
    """The map on matplotlib axes: grey scale 0 to 1, hatched where no sign is visible."""
    xmin, xmax, ymin, ymax = scene.HALL[:4]
    grid = visibility.reshape(PLACES[1], PLACES[0])
    picture = axes.imshow(numpy.ma.masked_less(grid, THRESHOLD), origin="lower",
                          extent=(xmin, xmax, ymin, ymax), cmap="gray", vmin=0.0, vmax=1.0,
                          interpolation="nearest", aspect="equal")
    width, depth = (xmax - xmin) / PLACES[0], (ymax - ymin) / PLACES[1]
    for row, column in zip(*numpy.nonzero(grid < THRESHOLD)):
        axes.add_patch(Rectangle((xmin + column * width, ymin + row * depth), width, depth,
                                 facecolor="white", edgecolor="#c04040", linewidth=0,
                                 hatch="///" if small else "//"))
    x0, x1, y0, y1 = scene.FIRE
    axes.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, facecolor="black", edgecolor="white",
                             linewidth=0.5))
    for sign in sign_table():
        # An arrow head outside the wall that points the way the sign looks.
        axes.plot(sign["cx"] - 0.9 * sign["nx"], sign["cy"] - 0.9 * sign["ny"], color=SIGN_COLOUR,
                  marker=(3, 0, numpy.degrees(numpy.arctan2(-sign["nx"], sign["ny"]))),
                  markersize=4 if small else 9, clip_on=False, linestyle="none")
    margin = 1.8
    axes.set_xlim(xmin - margin, xmax + margin)
    axes.set_ylim(ymin - margin, ymax + margin)
    axes.add_patch(Rectangle((xmin, ymin), xmax - xmin, ymax - ymin, fill=False, linewidth=1))
    axes.set_xticks(range(0, 56, 10))
    axes.set_yticks(range(0, 36, 10))
    if small:
        axes.tick_params(labelsize=6)
    return picture


def legend(figure, picture, axes, **where):
    bar = figure.colorbar(picture, ax=axes, **where)
    bar.set_label("perceived contrast of the best sign")
    bar.ax.axhline(THRESHOLD, color="#c04040", linewidth=2)


def key(place, **where):
    """Explains the map's marks."""
    place.legend(handles=[
        Patch(facecolor="white", edgecolor="#c04040", hatch="///", linewidth=0,
              label=f"no sign visible (below {THRESHOLD:g})"),
        Patch(facecolor="black", label="fire"),
        plt.Line2D([], [], color=SIGN_COLOUR, marker="^", linestyle="none",
                   label="exit sign, facing the way it points")], frameon=False, **where)


def map_figure(name, visibility, title):
    figure, axes = plt.subplots(figsize=(9.5, 6.2), constrained_layout=True)
    picture = draw_map(axes, visibility)
    axes.set_title(title, fontsize=11)
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    legend(figure, picture, axes, shrink=0.85)
    key(axes, loc="upper center", bbox_to_anchor=(0.5, -0.11), ncol=3)
    figure.savefig(name, dpi=110)
    plt.close(figure)


def strip_figure(name, strip):
    """The map at every time, side by side."""
    figure, grid = plt.subplots(2, 5, figsize=(15, 5), constrained_layout=True, sharex=True,
                                sharey=True)
    for axes, (when, visibility) in zip(grid.flat, strip.items()):
        picture = draw_map(axes, visibility, small=True)
        share = 100.0 * numpy.mean(visibility >= THRESHOLD)
        axes.set_title(f"{when:g} s: visible from {share:.0f} %", fontsize=9)
    legend(figure, picture, grid, shrink=0.9)
    figure.suptitle("Dark hall, signs only: x and y in m, hatched where no sign is visible")
    figure.savefig(name, dpi=110)
    plt.close(figure)


def variants_figure(name, variants):
    """A row a time, a column a variant of the lighting."""
    times = list(next(iter(variants.values())))
    figure, grid = plt.subplots(len(times), len(variants), figsize=(4.3 * len(variants), 6.2),
                                constrained_layout=True, sharex=True, sharey=True)
    for column, (label, maps) in enumerate(variants.items()):
        for row, when in enumerate(times):
            picture = draw_map(grid[row, column], maps[when], small=True)
            share = 100.0 * numpy.mean(maps[when] >= THRESHOLD)
            grid[row, column].set_title(f"{label}, {when:g} s: visible from {share:.0f} %",
                                        fontsize=9)
    legend(figure, picture, grid, shrink=0.9)
    figure.suptitle("The same smoke in different light: x and y in m, "
                    "hatched where no sign is visible")
    figure.savefig(name, dpi=110)
    plt.close(figure)


def mark_hall(axes):
    """Walls, fire and axes of a picture that fills the hall."""
    xmin, xmax, ymin, ymax = scene.HALL[:4]
    x0, x1, y0, y1 = scene.FIRE
    axes.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, facecolor="black", edgecolor="white", linewidth=0.5))
    axes.add_patch(Rectangle((xmin, ymin), xmax - xmin, ymax - ymin, fill=False, linewidth=1))
    axes.set_xticks(range(0, 56, 10))
    axes.set_yticks(range(0, 36, 10))


def time_figure(name, available, outcome, end):
    """When the places lose all signs; hatched where they do not until the end."""
    xmin, xmax, ymin, ymax = scene.HALL[:4]
    figure, axes = plt.subplots(figsize=(9.5, 6.0), constrained_layout=True)
    grid = numpy.ma.masked_invalid(available.reshape(PLACES[1], PLACES[0]))
    picture = axes.imshow(numpy.ma.masked_where(outcome.reshape(grid.shape) == 0, grid), origin="lower",
                          extent=(xmin, xmax, ymin, ymax), cmap="inferno", vmax=end, interpolation="nearest")
    width, depth = (xmax - xmin) / PLACES[0], (ymax - ymin) / PLACES[1]
    for row in range(PLACES[1]):
        for column in range(PLACES[0]):
            place = row * PLACES[0] + column
            if outcome[place] == 0:
                axes.add_patch(Rectangle((xmin + column * width, ymin + row * depth), width, depth,
                                         facecolor="white", edgecolor=SIGN_COLOUR, linewidth=0, hatch="//"))
            elif numpy.isfinite(available[place]):
                late = available[place] > 0.5 * (grid.min() + end)
                axes.text(xmin + (column + 0.5) * width, ymin + (row + 0.5) * depth, f"{available[place]:.0f}",
                          ha="center", va="center", fontsize=8, color="black" if late else "white")
    mark_hall(axes)
    axes.set_title("Dark hall: time at which no sign is visible any more [s]", fontsize=11)
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    figure.colorbar(picture, ax=axes, shrink=0.85, label="available time by visibility [s]")
    axes.legend(handles=[Patch(facecolor="white", edgecolor=SIGN_COLOUR, hatch="//", linewidth=0,
                               label=f"a sign is visible until the end of the run, {end:g} s"),
                         Patch(facecolor="black", label="fire")],
                frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.11), ncol=2)
    figure.savefig(name, dpi=110, bbox_inches="tight")
    plt.close(figure)


# Categories of JinVisibility.
DIFFERENCES = [("seen by both", "#d9d9d9"), ("seen by Jin's law only", "#c04040"),
               ("seen by the map only", "#3b6ea5"), ("seen by neither", "#404040"),
               ("no sign in view", "#ffffff"), ("inside a solid", "#806040")]


def difference_figure(name, pictures, when):
    """Where the map and Jin's law agree, and where not."""
    columns = 2
    rows = -(-len(pictures) // columns)
    figure, grid = plt.subplots(rows, columns, figsize=(10, 3.7 * rows), constrained_layout=True, sharex=True,
                                sharey=True, squeeze=False)
    colours = ListedColormap([colour for _, colour in DIFFERENCES])
    for axes, (title, categories) in zip(grid.flat, pictures.items()):
        axes.imshow(categories.reshape(PLACES[1], PLACES[0]), origin="lower", extent=scene.HALL[:4], cmap=colours,
                    vmin=-0.5, vmax=len(DIFFERENCES) - 0.5, interpolation="nearest")
        mark_hall(axes)
        axes.set_title(title, fontsize=10)
    used = sorted(set(numpy.concatenate(list(pictures.values()))))
    figure.legend(handles=[Patch(facecolor=DIFFERENCES[i][1], edgecolor="black", linewidth=0.5,
                                 label=DIFFERENCES[i][0]) for i in used],
                  loc="lower center", bbox_to_anchor=(0.5, -0.05), ncol=len(used), frameon=False)
    figure.suptitle(f"Is a sign visible? The map against V = C/K, {when}; x and y in m", fontsize=11)
    figure.savefig(name, dpi=110, bbox_inches="tight")
    plt.close(figure)


def route_figure(name, walks):
    """Contrast of the best sign and walking speed along a way, a line a start."""
    figure, (contrast, speed) = plt.subplots(2, 1, figsize=(8, 6), constrained_layout=True, sharex=True)
    for start, (distance, visibility, walking) in walks.items():
        contrast.plot(distance, visibility, label=f"from {start:g} s on")
        speed.step(distance, walking, where="post")
    contrast.axhline(THRESHOLD, color="#c04040", linewidth=1)
    contrast.text(1.0, THRESHOLD - 0.06, "point of disappearance", color="#c04040", fontsize=8,
                  transform=contrast.get_yaxis_transform(), ha="right")
    contrast.set_ylabel("perceived contrast of the best sign")
    contrast.set_ylim(0.0, 1.0)
    contrast.legend(frameon=False)
    speed.set_ylabel("walking speed [m/s]")
    speed.set_xlabel("way from the middle of the hall to the door [m]")
    speed.set_ylim(0.0, 1.3)
    figure.savefig(name, dpi=110)
    plt.close(figure)


def sign_figure(name, luminance, caption):
    """A sign as the eye gets it, on the logarithmic luminance scale that all of them share."""
    figure, axes = plt.subplots(figsize=(7.2, 3.6), constrained_layout=True)
    picture = axes.imshow(numpy.clip(luminance, DARKEST, BRIGHTEST), origin="lower", cmap="gray",
                          norm=LogNorm(DARKEST, BRIGHTEST), interpolation="nearest")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.set_title(caption, fontsize=9)
    figure.colorbar(picture, ax=axes, label="luminance [cd/m2]", shrink=0.85)
    figure.savefig(name, dpi=110)
    plt.close(figure)


def hall_view(name, reader, signs, hall_map, when):
    """The hall from above the south-east corner, cut open, with the map at eye level."""
    xmin, xmax, ymin, ymax, bottom, top = scene.HALL
    view = simple.CreateRenderView(registrationName="Hall", ViewSize=[1200, 720])
    view.ViewTime = when
    view.Background = [1.0, 1.0, 1.0]
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesVisibility = 0

    # Cut open above the signs.
    cut = simple.Clip(registrationName="Walls below 2.6 m", Input=simple.OutputPort(reader, 1),
                      ClipType="Plane", Invert=1)
    cut.ClipType.Origin = [xmin, ymin, bottom + 2.6]
    cut.ClipType.Normal = [0.0, 0.0, 1.0]
    walls = simple.Show(cut, view)
    walls.ColorArrayName = [None, ""]
    walls.DiffuseColor = walls.AmbientColor = [0.82, 0.80, 0.76]
    walls.Ambient, walls.Diffuse = 0.5, 0.5

    x0, x1, y0, y1 = scene.FIRE
    fire = simple.Show(simple.Box(
        registrationName="Fire", Center=[(x0 + x1) / 2, (y0 + y1) / 2, 1.0], XLength=x1 - x0,
        YLength=y1 - y0, ZLength=2.0), view)
    fire.ColorArrayName = [None, ""]
    fire.DiffuseColor = [0.0, 0.0, 0.0]

    plates = simple.Show(signs, view)
    plates.ColorArrayName = [None, ""]
    plates.DiffuseColor = plates.AmbientColor = [0.0, 0.7, 0.3]
    plates.LineWidth = 4
    plates.Representation = "Surface With Edges"
    plates.EdgeColor = [0.0, 0.7, 0.3]

    # A tile a standing place, its grey as in the figure, red where no sign is visible.
    tiles = simple.Glyph(
        registrationName="Standing places", Input=hall_map, GlyphType="Box",
        OrientationArray=["POINTS", "No orientation array"],
        ScaleArray=["POINTS", "No scale array"], GlyphMode="All Points")
    tiles.ScaleFactor = 1.0
    tiles.GlyphType.XLength = 0.96 * (xmax - xmin) / PLACES[0]
    tiles.GlyphType.YLength = 0.96 * (ymax - ymin) / PLACES[1]
    tiles.GlyphType.ZLength = 0.02
    shown = simple.Show(tiles, view)
    simple.ColorBy(shown, ("POINTS", "Visibility"))
    table = simple.GetColorTransferFunction("Visibility")
    red, grey = [0.6, 0.1, 0.1], [THRESHOLD] * 3
    table.RGBPoints = [0.0, *red, THRESHOLD - 1e-4, *red, THRESHOLD, *grey, 1.0, 1.0, 1.0, 1.0]
    table.ColorSpace = "RGB"
    table.AutomaticRescaleRangeMode = "Never"
    shown.SetScalarBarVisibility(view, True)
    shown.Ambient, shown.Diffuse = 1.0, 0.0
    bar = simple.GetScalarBar(table, view)
    bar.Title = "Perceived contrast, red: no sign visible"
    bar.ComponentTitle = ""
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    bar.Orientation = "Horizontal"
    bar.WindowLocation = "Lower Center"
    bar.ScalarBarLength = 0.4
    bar.RangeLabelFormat = bar.LabelFormat = "%.1f"

    view.CameraFocalPoint = [27.5, 15.0, 0.0]
    view.CameraPosition = [38.0, -32.0, 52.0]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    view.CameraViewAngle = 40
    simple.SaveScreenshot(name, view, ImageResolution=[1200, 720])
