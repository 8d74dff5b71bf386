"""Jin's constants: extinction times visibility at the threshold, over luminance, ambient light and
albedo.

A long corridor with a sign on its end wall and evenly spaced lamps under its ceiling. As in the
tunnel each source is solved alone, seen from many distances, and mixed.
"""
import hashlib
import json
import os
import sys

import claims
import numpy
import tunnel as scene
from claims import IN_PART, Verdict
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCellCenters

CLAIM = ("Jin: K V at threshold is 5 to 10 for signs that emit light and 2 to 4 for signs that "
         "reflect it (not the paper's claim)")
SIZE = (24.0, 2.5, 2.5)  # m
CELLS = (96, 10, 10)
WALLS = 0.5
SMOKE = 0.7  # 1/m, so that K V of 3.5 to 10.5 are the 5 to 15 m for which Jin gives his law
ALBEDOS = (0.3, 0.6, 0.9, 1.0)
DISTANCES = (1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 7.0, 8.0, 9.5, 11.0, 12.5, 14.0, 16.0,
             18.0, 20.0)  # m
LUMINANCES = (10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0)  # cd/m2
AMBIENTS = (0.0, 1.0, 10.0, 50.0, 200.0)  # lx on the floor of the clear corridor
PLATE = 0.6  # m
LAMPS = 12
WHITE, BLACK = 0.8, 0.05  # reflectance of the bars of a sign that reflects
# Of contrast: the paper's, and two of the order of Jin's delta, 0.01 of the surroundings' light.
THRESHOLDS = (0.2, 0.05, 0.02)
EMITTING, REFLECTING = (5.0, 10.0), (2.0, 4.0)
PIXELS = 36


def reflecting_sign():
    """A barcode without light of its own."""
    points, polys, reflectance = vtkPoints(), vtkCellArray(), []
    points.SetDataTypeToDouble()
    y0, z0 = 0.5 * (SIZE[1] + PLATE), 0.5 * (SIZE[2] - PLATE)
    width = PLATE / scene.BARS
    for bar in range(scene.BARS):
        polys.InsertNextCell(4)
        for y, z in ((0, 0), (1, 0), (1, 1), (0, 1)):
            polys.InsertCellPoint(
                points.InsertNextPoint(SIZE[0], y0 - (bar + y) * width, z0 + z * PLATE))
        reflectance.append(WHITE if bar % 2 == 0 else BLACK)
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(polys)
    scene.add_cells(data, "Reflectance", numpy.array(reflectance))
    scene.add_cells(data, "Luminance", numpy.zeros(scene.BARS))
    scene.add_cells(data, "SignId", numpy.zeros(scene.BARS, dtype=numpy.int32))
    return scene.producer(data)


def emitting_sign(luminance):
    return simple.ExitSign(
        Center=[SIZE[0], SIZE[1] / 2, SIZE[2] / 2], Normal=[-1, 0, 0], Width=PLATE, Height=PLATE,
        Bars=scene.BARS, Luminance=luminance)


def lamps():
    """Lamps of 1 cd/m2, evenly spaced under the ceiling."""
    step = SIZE[0] / LAMPS
    return simple.Luminaire(
        Center=[SIZE[0] / 2, SIZE[1] / 2, SIZE[2] - 0.001], Normal=[0, 0, -1], Up=[1, 0, 0],
        Width=0.3, Height=0.3, Luminance=1.0, Count=[1, LAMPS], Spacing=[step, step])


def light_field(extinction, albedo, emitters, tolerance, cells):
    smoke = scene.producer(scene.smoke_box(SIZE, cells, extinction))
    surfaces = scene.producer(scene.walls(SIZE, WALLS))
    return simple.SmokeLightField(Smoke=smoke, Surfaces=[surfaces], Emitters=emitters,
                                  Albedo=albedo, Tolerance=tolerance)


def clear_floor(tolerance, cells):
    """Mean illuminance of the floor without smoke, but for the ends [lx]."""
    field = light_field(0.0, 0.0, [lamps()], tolerance, cells)
    walls = scene.output(field).GetPartitionedDataSet(1).GetPartition(0)
    centres = vtkCellCenters()
    centres.SetInputData(walls)
    centres.Update()
    x, _, z = vtk_to_numpy(centres.GetOutput().GetPoints().GetData()).T
    light = vtk_to_numpy(walls.GetCellData().GetArray("Illuminance"))
    return float(light[(abs(z) < 1e-6) & (x > 4.0) & (x < SIZE[0] - 4.0)].mean())


def pictures(albedo, source, distances, tolerance, cells, folder):
    """The plate from each distance, for a sign or lamps of 1 cd/m2; a row a distance."""
    key = json.dumps([SIZE, cells, WALLS, SMOKE, albedo, source, distances, PLATE, LAMPS, WHITE,
                      BLACK, tolerance, PIXELS])
    digest = hashlib.sha256(key.encode()).hexdigest()[:16]
    name = folder and os.path.join(folder, f"jin_{digest}.npy")
    if name and os.path.exists(name):
        return numpy.load(name)
    emitters = {"emitting": lambda: [emitting_sign(1.0)],
                "veil": lambda: [emitting_sign(0.0), lamps()],
                "reflecting": lambda: [reflecting_sign(), lamps()]}[source]()
    field = light_field(SMOKE, albedo, emitters, tolerance, cells)
    view = simple.VisibilityImage(LightField=field, TargetSign=0, ImageSize=[PIXELS, PIXELS])
    rows = []
    for distance in distances:
        view.CameraPosition = [SIZE[0] - distance, SIZE[1] / 2, SIZE[2] / 2]
        light = scene.output(view).GetPointData().GetArray("Luminance")
        rows.append(vtk_to_numpy(light).astype(float))
    rows = numpy.array(rows)
    simple.Delete(view)
    simple.Delete(field)
    if name:
        os.makedirs(folder, exist_ok=True)
        numpy.save(name, rows)
    return rows


def lost(distances, own, veil, threshold=scene.THRESHOLD):
    """K V at which the contrast of a sign's own light, its deviation over the mean of all light and
    the noise, falls to a threshold. The slope of the veil over the plate does not count as sign."""
    # Right at the plate there is no smoke before it.
    own = numpy.vstack([own[0] * numpy.exp(SMOKE * distances[0]), own])
    veil = numpy.vstack([0.0 * veil[0], veil])
    contrasts = own.std(axis=1) / ((own + veil).mean(axis=1) + scene.DARK)
    if contrasts[0] < threshold:
        return 0.0
    found = scene.crossing((0.0, *distances), contrasts, threshold)
    return numpy.inf if found is None else SMOKE * found


def compute(tunnel, albedos=ALBEDOS, distances=DISTANCES, cells=CELLS):
    tolerance, folder = tunnel.tolerance, tunnel.folder
    per_lux = 1.0 / clear_floor(tolerance, cells)
    emitting, reflecting = {}, {}
    for albedo in albedos:
        sign, veil, card = [pictures(albedo, source, distances, tolerance, cells, folder)
                            for source in ("emitting", "veil", "reflecting")]
        for threshold in THRESHOLDS:
            for ambient in AMBIENTS:
                lit = ambient * per_lux
                for luminance in LUMINANCES:
                    emitting[threshold, albedo, ambient, luminance] = lost(
                        distances, luminance * sign, lit * veil, threshold)
                if ambient > 0.0:
                    reflecting[threshold, albedo, ambient] = lost(
                        distances, lit * (card - veil), lit * veil, threshold)
    return {"emitting": emitting, "reflecting": reflecting, "albedos": list(albedos)}


def select(values, threshold, *tests):
    """Values of a threshold whose (albedo, ambient, luminance) pass all tests."""
    return [value for (level, *case), value in values.items()
            if level == threshold and all(test(*case) for test in tests)]


def share(values, band):
    return 100.0 * sum(band[0] <= value <= band[1] for value in values) / len(values)


def span(values):
    return f"{min(values):.1f} to {max(values):.1f}"


def judge(numbers):
    emitting, reflecting = numbers["emitting"], numbers["reflecting"]
    texts = []
    for threshold in THRESHOLDS:
        dark = select(emitting, threshold, lambda albedo, ambient, luminance: ambient == 0.0)
        lit = select(emitting, threshold, lambda albedo, ambient, luminance: ambient == 200.0)
        cards = select(reflecting, threshold, lambda albedo, ambient: ambient >= 10.0)
        texts.append(
            f"at contrast {threshold:g}: emitting, dark {span(dark)} ({share(dark, EMITTING):.0f} "
            f"% within 5 to 10), 200 lx {span(lit)} ({share(lit, EMITTING):.0f} %); reflecting, 10 "
            f"to 200 lx {span(cards)} ({share(cards, REFLECTING):.0f} % within 2 to 4)")
    return Verdict(
        "; ".join(texts), IN_PART,
        "in the dark an emitting sign is lost to the eye's noise; K V grows with the logarithm of "
        "the luminance, as in Jin's formula, and lies in his range at 0.2. Under lamps the veil "
        "takes the sign, the more the whiter the smoke, and 5 to 10 misleads for all but bright "
        "signs. A reflecting sign is never much brighter than the glow of the smoke that its light "
        "comes through: at 0.2 it is lost below 2. Jin's 2 to 4 are for a threshold of 0.01 to "
        "0.02 in bright surroundings, which is what eyes can do there; 0.2 is on the safe side "
        "then")


def draw(numbers, path):
    albedos = numbers["albedos"]
    count = len(albedos) + 1
    figure, plots = claims.plt.subplots(1, count, figsize=(3.3 * count, 4.4), sharey=True,
                                        constrained_layout=True)
    shades = claims.plt.get_cmap("plasma")(numpy.linspace(0.0, 0.85, len(AMBIENTS)))
    for plot, albedo in zip(plots, albedos):
        plot.axhspan(*EMITTING, color="#90c090", alpha=0.4, linewidth=0, label="Jin, 5 to 10")
        for ambient, shade in zip(AMBIENTS, shades):
            found = [numbers["emitting"][0.2, albedo, ambient, v] for v in LUMINANCES]
            plot.semilogx(LUMINANCES, found, "-o", color=shade, markersize=3,
                          label=f"{ambient:g} lx")
        plot.plot([86.0, 86.0], [6.91, 8.17], color="k", linewidth=3,
                  label="aircraft sign, AM-79/22, dark")
        plot.set_title(f"emitting, albedo {albedo:g}, contrast 0.2", fontsize=10)
        plot.set_xlabel("luminance of the sign [cd/m2]")
        plot.grid(alpha=0.3)
    plots[0].set_ylabel("K V where the sign is lost")
    plots[0].set_ylim(0.0, 13.0)
    plots[0].legend(fontsize=7)
    plot = plots[-1]
    plot.axhspan(*REFLECTING, color="#90c090", alpha=0.4, linewidth=0, label="Jin, 2 to 4")
    for threshold, colour in zip(THRESHOLDS, ("k", "#2060c0", "#80b0f0")):
        for albedo, style in zip(albedos, ("-o", "--s", "-.^", ":v")):
            found = [numbers["reflecting"][threshold, albedo, v] for v in AMBIENTS[1:]]
            plot.semilogx(AMBIENTS[1:], found, style, markersize=4, color=colour,
                          label=f"contrast {threshold:g}, albedo {albedo:g}")
    plot.set_title("reflecting, white on black", fontsize=10)
    plot.set_xlabel("illuminance of the clear floor [lx]")
    plot.grid(alpha=0.3)
    plot.legend(fontsize=6, loc="upper left")
    claims.save(figure, path)


if __name__ == "__main__":
    claims.main(sys.modules[__name__])
