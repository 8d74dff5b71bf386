"""Claim: in the burning hall the contrast is below 0.1 by the fire and good near doors, and along
the long walls between doors it is dark."""
import importlib.util
import os
import sys

import claims
import numpy
from claims import AGREES, DISAGREES, IN_PART, Verdict

CLAIM = ("In the hall the contrast is below 0.1 by the fire, good near doors, and low along the "
         "long walls between doors")
HALL = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "Hall")
TIMES = (240.0, 360.0, 480.0, 600.0)  # s
# What shines beside the signs, and the reader's FlameModel. The paper has no light of the fire.
LIGHTS = {"signs alone": "None", "with the fire's light": "Heat Release"}
PLACES = (22, 14)  # 2.5 m squares
GOOD, BAD, DARK_AREA = 0.5, 0.1, 0.2
BY_FIRE, NEAR_DOOR, AT_WALL, BETWEEN = 2.5, 4.0, 2.5, 8.0  # m


def hall_scene():
    """Data/Hall/scene.py."""
    spec = importlib.util.spec_from_file_location("hall_scene", os.path.join(HALL, "scene.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def doors(hall):
    """Places of the signs and the directions that they look in."""
    with open(hall.SIGNS, encoding="utf-8") as file:
        rows = [line.strip().split(",") for line in file if not line.startswith("#")]
    column = {name: rows[0].index(name) for name in ("cx", "cy", "nx", "ny")}
    return numpy.array([[float(row[column[name]]) for name in column] for row in rows[1:]])


def regions(hall, places):
    """Which places lie by the fire, near doors, and along the long walls between doors."""
    x = (numpy.arange(places[0]) + 0.5) * (hall.HALL[1] - hall.HALL[0]) / places[0]
    y = (numpy.arange(places[1]) + 0.5) * (hall.HALL[3] - hall.HALL[2]) / places[1]
    x, y = [values.reshape(-1) for values in numpy.meshgrid(x, y)]
    x0, x1, y0, y1 = hall.FIRE
    fire = numpy.hypot(numpy.maximum(abs(x - (x0 + x1) / 2) - (x1 - x0) / 2, 0.0),
                       numpy.maximum(abs(y - (y0 + y1) / 2) - (y1 - y0) / 2, 0.0)) < BY_FIRE
    away = numpy.array([numpy.hypot(x - d[0], y - d[1]) for d in doors(hall)]).min(axis=0)
    wall = numpy.minimum(y - hall.HALL[2], hall.HALL[3] - y) <= AT_WALL
    return {"fire": fire, "doors": away < NEAR_DOOR, "walls": wall & (away > BETWEEN)}


def maps(hall, flames, times, places):
    """The map of each time, for a FlameModel of the reader."""
    from paraview import simple
    reader = hall.read(flames=flames)
    signs = hall.signs()
    field = hall.light_field("Light of the hall", reader, [signs], Tolerance=0.05)
    floor = hall.floor_map("Map of the hall", field)
    floor.Resolution = list(places)
    result = {}
    for when in times:
        floor.UpdatePipeline(when)
        result[when] = hall.values(floor, "Visibility")
    for proxy in (floor, field, signs, reader):
        simple.Delete(proxy)
    return result


def compute(_=None, times=TIMES, places=PLACES, lights=tuple(LIGHTS)):
    hall = hall_scene()
    where = regions(hall, places)
    found = {light: maps(hall, LIGHTS[light], times, places) for light in lights}
    return {"maps": found, "regions": where, "hall": hall.HALL, "places": places,
            "means": {light: {when: {name: float(values[mask].mean())
                                     for name, mask in where.items()}
                              for when, values in rows.items()} for light, rows in found.items()},
            "darkest": {light: {when: float(values[where["walls"]].min())
                                for when, values in rows.items()}
                        for light, rows in found.items()}}


def partly(numbers, light):
    """The time at which most of the three statements hold, the earliest of them."""
    found = {when: [means["fire"] < BAD, means["doors"] > GOOD,
                    numbers["darkest"][light][when] < DARK_AREA]
             for when, means in numbers["means"][light].items()}
    best = max(found, key=lambda when: (sum(found[when]), -when))
    return best, found[best]


def judge(numbers):
    texts, held, said = [], [], []
    for light, rows in numbers["means"].items():
        texts.append(light + ": " + ", ".join(
            f"{when:g} s: by the fire {m['fire']:.3f}, near doors {m['doors']:.2f}, along the long "
            f"walls between doors {m['walls']:.2f}, at the darkest "
            f"{numbers['darkest'][light][when]:.2f}" for when, m in rows.items()))
        when, found = partly(numbers, light)
        held += found
        fire, near, dark = ["yes" if good else "no" for good in found]
        said.append(f"{light}, at {when:g} s: below {BAD:g} by the fire {fire}, above {GOOD:g} "
                    f"near doors {near}, below {DARK_AREA:g} somewhere between doors {dark}")
    return Verdict(
        "; ".join(texts), AGREES if all(held) else IN_PART if any(held) else DISAGREES,
        "means of the perceived contrast of the best sign at eye level in the dark hall, signs of "
        f"300 cd/m2, {BY_FIRE:g} m around the fire, {NEAR_DOOR:g} m around doors, {AT_WALL:g} m "
        f"along the long walls and {BETWEEN:g} m from any door. {'; '.join(said)}. Earlier the "
        "smoke is thinner and signs carry along the walls. The fire is our own FDS run, not the "
        "paper's; its light, 0.05 lm/W of the heat released, is no part of the paper's claim")


def draw(numbers, path):
    lights, times = list(numbers["maps"]), list(next(iter(numbers["maps"].values())))
    figure, plots = claims.plt.subplots(
        len(times), len(lights), figsize=(5.5 * len(lights), 3.5 * len(times)),
        constrained_layout=True, squeeze=False)
    x0, x1, y0, y1 = numbers["hall"][:4]
    columns, rows = numbers["places"]
    for column, light in zip(plots.T, lights):
        for plot, (when, values) in zip(column, numbers["maps"][light].items()):
            picture = plot.imshow(values.reshape(rows, columns), origin="lower", cmap="viridis",
                                  extent=(x0, x1, y0, y1), vmin=0.0, vmax=0.9)
            levels = [level for level in (BAD, DARK_AREA) if values.min() < level < values.max()]
            if levels:
                plot.contour(numpy.linspace(x0, x1, 2 * columns + 1)[1::2],
                             numpy.linspace(y0, y1, 2 * rows + 1)[1::2],
                             values.reshape(rows, columns), levels=levels, linewidths=1,
                             colors=["red" if level == BAD else "orange" for level in levels])
            means = numbers["means"][light][when]
            plot.set_title(f"{when:g} s, {light}: fire {means['fire']:.2f}, doors "
                           f"{means['doors']:.2f}, walls between {means['walls']:.2f}", fontsize=9)
            plot.set_xlabel("x [m]")
            plot.set_ylabel("y [m]")
    figure.colorbar(picture, ax=plots,
                    label="perceived contrast of the best sign; red 0.1, orange 0.2")
    claims.save(figure, path)


if __name__ == "__main__":
    claims.main(sys.modules[__name__])
