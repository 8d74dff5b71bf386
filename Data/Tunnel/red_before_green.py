"""Claim: red is ahead of green in thin smoke, the difference shrinks as it thickens."""
import sys

import claims
import numpy
import tunnel as scene
from claims import AGREES, DISAGREES, IN_PART, Verdict

CLAIM = "Red is ahead of green in thin smoke, and the difference shrinks as it thickens"
CASES = {"dark": (), "both lamps": ("sign", "camera")}


def seen(tunnel, smoke, density, pattern, colour, lamps):
    """Perceived contrast and its standard error."""
    plate = tunnel.sign(smoke, density, pattern, colour)
    picture = tunnel.picture(smoke, density, pattern, colour, lamps=lamps)
    value = scene.contrast(picture, scene.DARK)
    # Errors of the sign's own contrast, and of its and the lamps' share of the mean.
    own = scene.SIGN_LUMINANCE * plate.picture.mean()
    lamp = tunnel.lamp_luminance(scene.LAMP_FLUX)
    means = [scene.SIGN_LUMINANCE * plate.mean_error] + [
        lamp * tunnel.lamp(smoke, density, which).mean_error for which in lamps]
    level = picture.mean() + scene.DARK
    return value, float(numpy.hypot(plate.error * own / level,
                                    value * numpy.linalg.norm(means) / level))


def compute(tunnel, densities=scene.DENSITIES, patterns=("square", "barcode"), cases=tuple(CASES)):
    differences = {}
    for smoke in scene.SMOKES:
        for pattern in patterns:
            for case in cases:
                rows = []
                for density in densities:
                    red, green = [seen(tunnel, smoke, density, pattern, colour, CASES[case])
                                  for colour in ("red", "green")]
                    # Two solutions with errors of their own; in glycol one and the same.
                    same = scene.SMOKES[smoke][1] == 0.0
                    error = 0.0 if same else float(numpy.hypot(red[1], green[1]))
                    rows.append((red[0] - green[0], error))
                differences[smoke, pattern, case] = rows
    return {"densities": list(densities), "differences": differences}


def peak(numbers, key):
    """Largest difference, its density and standard error, and the last difference over it."""
    rows = numbers["differences"][key]
    best = max(range(len(rows)), key=lambda i: rows[i][0])
    value, error = rows[best]
    return value, numbers["densities"][best], error, rows[-1][0] / value if value > 0.0 else 0.0


def judge(numbers):
    texts, good = [], []
    for key in numbers["differences"]:
        if key[0] == "soot":
            value, where, error, rest = peak(numbers, key)
            thin = dict(zip(numbers["densities"], numbers["differences"][key]))[0.3][0]
            texts.append(f"soot, {key[1]}, {key[2]}: {thin:+.3f} at 0.3/m, "
                         f"largest {value:+.2f} ({error:.1g}) at "
                         f"{where:g}/m, {100 * abs(rest):.0f} % of that at "
                         f"{numbers['densities'][-1]:g}/m")
            good.append(value > 3.0 * error and rest < 0.5)
    texts.append("glycol: 0, its droplets weaken all colours alike")
    return Verdict(
        "; ".join(texts), IN_PART if all(good) else DISAGREES,
        "errors in brackets; in soot, whose extinction falls as 1/wavelength, red is ahead "
        "everywhere and the difference vanishes where both are lost, but it first grows: in clear "
        "air the two are equal, and it is largest near the threshold. In a fog of droplets the "
        "physics gives no difference; one in clear air must come from the signs (unequal "
        "luminance) or from the camera's response to colour")


def draw(numbers, path):
    figure, plots = claims.axes(11.0, 4.4, 2, sharey=True)
    for (smoke, pattern, case), rows in numbers["differences"].items():
        plot = plots[0][list(CASES).index(case)]
        value, error = numpy.array(rows).T
        plot.errorbar(numbers["densities"], value, yerr=2.0 * error, capsize=3, markersize=4,
                      fmt="-o" if pattern == "square" else "--s", color=claims.COLOURS[smoke],
                      label=f"{smoke}, {pattern}")
        plot.set_title(f"Red (630 nm) minus green (532 nm), {case}; bars: 2 standard errors",
                       fontsize=9)
        plot.set_xlabel("optical density at 633 nm [1/m]")
        plot.grid(alpha=0.3)
    plots[0][0].set_ylabel("difference of perceived contrast")
    plots[0][0].legend()
    claims.save(figure, path)


if __name__ == "__main__":
    claims.main(sys.modules[__name__])
