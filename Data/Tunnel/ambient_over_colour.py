"""Claim: ambient light lowers contrast much more than colour does."""
import sys

import claims
import numpy
import tunnel as scene
from claims import AGREES, DISAGREES, IN_PART, Verdict

CLAIM = "Ambient light lowers the contrast much more than colour does"
FLUXES = (20.0, 200.0, 2000.0)  # lm a lamp
BOTH = ("sign", "camera")
MUCH = 3.0


def compute(tunnel, densities=scene.DENSITIES, pattern="square"):
    effects = {}
    for smoke in scene.SMOKES:
        red = [scene.contrast(tunnel.picture(smoke, d, pattern), scene.DARK) for d in densities]
        green = [scene.contrast(tunnel.picture(smoke, d, pattern, "green"), scene.DARK)
                 for d in densities]
        lit = {flux: [scene.contrast(tunnel.picture(smoke, d, pattern, lamps=BOTH, flux=flux),
                                     scene.DARK) for d in densities] for flux in FLUXES}
        effects[smoke] = {"red": red, "green": green, "lit": lit}
    return {"densities": list(densities), "effects": effects}


def areas(numbers, smoke):
    """Contrast lost over the whole range: to green instead of red, and to each lamp flux."""
    found = numbers["effects"][smoke]
    x = numbers["densities"]
    red = numpy.trapz(found["red"], x)
    return red - numpy.trapz(found["green"], x), {
        flux: red - numpy.trapz(values, x) for flux, values in found["lit"].items()}


def ratios(numbers, smoke):
    colour, ambient = areas(numbers, smoke)
    return {flux: value / colour if colour > 1e-6 else numpy.inf for flux, value in ambient.items()}


def judge(numbers):
    soot = ratios(numbers, "soot")
    colour, ambient = areas(numbers, "glycol")
    text = "soot, ambient over colour: " + ", ".join(
        f"{value:.1f} ({flux:g} lm)" for flux, value in soot.items())
    text += f"; glycol: colour has no effect, ambient takes {ambient[scene.LAMP_FLUX]:.2f} of 1/m"
    good = [value >= MUCH for value in soot.values()]
    return Verdict(
        text, AGREES if all(good) else IN_PART if any(good) else DISAGREES,
        "areas between the curves of contrast over density, red square, two lamps of 20, 200 and "
        f"2000 lm (2000 lm is a bright room); 'much' is taken as {MUCH:g} times. In glycol the "
        "statement holds for any lamp; in soot, which scatters little and tells colours apart, "
        "only for lamps that are bright against the sign")


def draw(numbers, path):
    figure, plots = claims.axes(11.0, 4.4, 2)
    for plot, smoke in zip(plots[0], scene.SMOKES):
        found = numbers["effects"][smoke]
        claims.threshold_band(plot)
        for colour in ("red", "green"):
            plot.plot(numbers["densities"], found[colour], "-o", markersize=4,
                      color=claims.COLOURS[colour], label=f"{colour}, dark")
        for flux, style in zip(FLUXES, (":", "--", "-.")):
            plot.plot(numbers["densities"], found["lit"][flux], style, color="#e08000",
                      label=f"red, two lamps of {flux:g} lm")
        claims.density_axis(plot)
        plot.set_title(f"Square sign, {smoke}", fontsize=10)
        plot.legend(fontsize=8)
    claims.save(figure, path)


if __name__ == "__main__":
    claims.main(sys.modules[__name__])
