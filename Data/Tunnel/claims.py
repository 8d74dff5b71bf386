"""What the scripts of the claims share: fits, figures, and how a claim is run and judged.

A claim is a module with CLAIM (the paper's words), compute(tunnel) -> numbers, judge(numbers) ->
Verdict and draw(numbers, path).
"""
import os
import sys
from dataclasses import dataclass

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
import numpy  # noqa: E402

COLOURS = {"glycol": "#2060c0", "soot": "#303030", "red": "#d03020", "green": "#209040"}
AGREES, IN_PART, DISAGREES = "agrees", "agrees in part", "disagrees"


@dataclass
class Verdict:
    """Our number, whether it agrees with the paper, and why."""

    number: str
    agrees: str
    why: str


@dataclass
class Fit:
    """A polynomial through the first points of a curve."""

    end: float  # largest x that it reaches
    points: int
    coefficients: tuple  # highest power first
    residual: float  # largest distance from a point, over the curve's first value
    r2: float


def fit(x, y, degree):
    """A polynomial through all points."""
    coefficients = numpy.polyfit(x, y, degree)
    off = numpy.polyval(coefficients, x) - y
    spread = ((y - numpy.mean(y)) ** 2).sum()
    return Fit(float(x[-1]), len(x), tuple(float(c) for c in coefficients),
               float(abs(off).max() / y[0]),
               float(1.0 - (off ** 2).sum() / spread) if spread else 1.0)


def fit_range(x, y, degree, allowed=0.05):
    """The longest polynomial from the first point on that leaves at most a share of the first
    value."""
    x, y = numpy.asarray(x), numpy.asarray(y)
    end = len(x)
    while True:
        found = fit(x[:end], y[:end], degree)
        # A polynomial through degree + 1 points misses none.
        if found.residual <= allowed or end == degree + 1:
            return found
        end -= 1


def axes(width=7.0, height=4.6, columns=1, sharey=False):
    return plt.subplots(1, columns, figsize=(width, height), constrained_layout=True, sharey=sharey,
                        squeeze=False)


def density_axis(plot, label="perceived contrast of the sign's plate", top=1.0):
    plot.set_xlabel("optical density at 633 nm [1/m]")
    plot.set_ylabel(label)
    plot.set_xlim(0.0, None)
    plot.set_ylim(0.0, top)
    plot.grid(alpha=0.3)


def threshold_band(plot, level=0.2, band=0.04):
    plot.axhspan(level - band, level + band, color="#b0b0b0", alpha=0.4, linewidth=0)
    plot.axhline(level, color="#707070", linewidth=1)


def save(figure, path):
    figure.savefig(path, dpi=110)
    plt.close(figure)


def load_plugin(path):
    from paraview import simple
    simple.LoadPlugin(os.path.abspath(path), remote=False, ns=vars(simple))


def main(module):
    """Runs one claim: pvpython SCRIPT PLUGIN OUTPUT_FOLDER."""
    plugin, folder = sys.argv[1:3]
    load_plugin(plugin)
    report(module, folder)


def report(module, folder):
    """Computes, draws and prints a claim."""
    import tunnel
    numbers = module.compute(tunnel.Tunnel(os.path.join(folder, "solved")))
    verdict = module.judge(numbers)
    name = os.path.splitext(os.path.basename(module.__file__))[0]
    module.draw(numbers, os.path.join(folder, name + ".png"))
    print(f"{module.CLAIM}\n  {verdict.number}\n  {verdict.agrees}: {verdict.why}", flush=True)
    return verdict
