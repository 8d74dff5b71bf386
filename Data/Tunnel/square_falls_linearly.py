"""Claim: the contrast of the red square sign falls almost linearly with optical density."""
import sys

import claims
import numpy
import tunnel as scene
from claims import AGREES, DISAGREES, IN_PART, Verdict

CLAIM = "The contrast of the red square sign falls almost linearly with optical density"
PATTERN, DEGREE = "square", 1
# A straight line is "almost" the curve where it leaves no more than this share of the first value.
ALLOWED = 0.05
CASES = (("dark", ()), ("both lamps", ("sign", "camera")))
MEASURES = ("luminance", "perceived", "photograph")


def curves(tunnel, pattern, densities):
    """Contrast over density for each smoke, lighting and way to measure."""
    result = {}
    for smoke in scene.SMOKES:
        for case, lamps in CASES:
            found = [scene.measures(tunnel.picture(smoke, d, pattern, lamps=lamps))
                     for d in densities]
            for measure in MEASURES:
                result[smoke, case, measure] = [values[measure] for values in found]
    return result


def compute(tunnel, densities=scene.DENSITIES):
    found = curves(tunnel, PATTERN, densities)
    return {"densities": list(densities), "curves": found,
            "fits": {key: claims.fit_range(densities, values, DEGREE, ALLOWED)
                     for key, values in found.items()}}


def reach(numbers, key):
    """Density that the line reaches to, and the share of the whole fall from there on up."""
    found = numbers["fits"][key]
    values = numbers["curves"][key]
    return found.end, 1.0 - values[found.points - 1] / values[0]


def judge(numbers):
    texts, whole = [], {}
    for key, found in numbers["fits"].items():
        end, fall = reach(numbers, key)
        # The line is to hold for most of the fall, or for as far as we looked.
        whole[key] = found.points > 3 and found.r2 > 0.98 and (
            fall >= 0.5 or end == numbers["densities"][-1])
        if key[1] == "dark" or key[2] == "photograph":
            texts.append(f"{', '.join(key)}: line to {end:.1f}/m (falls by {100 * fall:.0f} %, R2 "
                         f"{found.r2:.3f})")
    slopes = {smoke: -numbers["fits"][smoke, "dark", "luminance"].coefficients[0]
              for smoke in scene.SMOKES}
    return Verdict(
        "; ".join(texts),
        AGREES if all(whole.values()) else IN_PART if any(whole.values()) else DISAGREES,
        "the photograph, 8-bit values of a film-like response metered each time, comes nearest to "
        "what the paper measured; with lamps or in glycol it falls along a line for most of its "
        "way. The luminance does not: smoke dims lit and unlit parts alike and only its glow "
        "lowers their ratio, slowly at first in glycol "
        f"(by {slopes['glycol']:.2f} a 1/m) and hardly at all in soot ({slopes['soot']:.2f} a "
        "1/m). What an eye perceives is no line either: it stays high until the sign is as faint "
        "as the eye's noise and then falls steeply. The line is a property of the camera's "
        "response")


def draw(numbers, path, title="Red square sign"):
    figure, grid = claims.plt.subplots(2, 2, figsize=(11.0, 7.6), constrained_layout=True,
                                       sharex=True, sharey=True)
    for row, (case, _) in zip(grid, CASES):
        for plot, smoke in zip(row, scene.SMOKES):
            for measure, style in zip(MEASURES, ("-o", "-s", "--^")):
                values = numbers["curves"][smoke, case, measure]
                plot.plot(numbers["densities"], values, style, markersize=4, label=measure)
                found = numbers["fits"][smoke, case, measure]
                x = numpy.linspace(0.0, found.end, 50)
                plot.plot(x, numpy.polyval(found.coefficients, x), color="#c0c000",
                          linewidth=1, zorder=0)
            claims.threshold_band(plot)
            claims.density_axis(plot, "contrast")
            plot.set_title(f"{title}, {smoke}, {case}", fontsize=10)
    grid[0][0].legend(fontsize=8)
    claims.save(figure, path)


if __name__ == "__main__":
    claims.main(sys.modules[__name__])
