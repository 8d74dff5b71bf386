"""Where the default of DarkLuminance is from: contrast thresholds at low luminance and readings of
signs in smoke, against perceived contrast = deviation / (mean + DarkLuminance) = 0.2.
"""
import csv
import os
import sys

import claims
import numpy
from claims import AGREES, DISAGREES, Verdict

CLAIM = ("The observer's noise, DarkLuminance 0.1 cd/m2, against the literature "
         "(not the paper's claim)")
DEFAULT = 0.1
THRESHOLD = 0.2
DETAIL = 10.0  # minutes of arc, a bar of a 0.3 m plate at 10 m
BACKGROUNDS = numpy.logspace(-3, 0, 31)  # cd/m2
REFERENCES = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "References",
                          "fire_sign_visibility.csv")


def adrian(background, minutes):
    """Luminance difference [cd/m2] at which a disc is just detected (99.9 %) in 2 s by young eyes:
    W. Adrian, Visibility of targets: model for calculation, Lighting Res. Technol. 21 (1989) 181,
    who fitted Aulhorn's and Blackwell's (1946) thresholds."""
    log = numpy.log10(background)
    area = numpy.where(
        background >= 0.6,
        numpy.log10(4.1925 * background ** 0.1556) + 0.1684 * background ** 0.5867,
        numpy.where(background > 0.00418, 10 ** (-0.072 + 0.3372 * log + 0.0866 * log ** 2),
                    10 ** (0.028 + 0.173 * log)))
    weber = numpy.where(
        background >= 0.6, 0.05946 * background ** 0.466,
        numpy.where(background > 0.00418, 10 ** (-1.256 + 0.319 * log),
                    10 ** (-0.891 + 0.5275 * log + 0.0227 * log ** 2)))
    return 2.6 * (area / minutes + weber) ** 2


def cie(background):
    """The same for a disc of 4 minutes shown for 0.2 s: CIE 19/2 (1981), visibility reference
    function."""
    return 0.05936 * ((1.639 / background) ** 0.4 + 1.0) ** 2.5 * background


def ours(background, noise=DEFAULT):
    """Difference of two equal halves, the darker of which has the background's luminance, at which
    their perceived contrast, (d / 2) / (background + d / 2 + noise), is 0.2."""
    return 2.0 * THRESHOLD / (1.0 - THRESHOLD) * (background + noise)


def noise_of_reading(luminance, lit=5.0 / 9.0):
    """Noise [cd/m2] of an observer who loses a sign, a share of it lit, on a black ground at a
    luminance."""
    return luminance * (numpy.sqrt(lit * (1.0 - lit)) / THRESHOLD - lit)


def readings():
    """Luminance of the lit parts when signs were lost [cd/m2], (source, lowest, highest)."""
    with open(REFERENCES, encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    aircraft = next(row for row in rows if "AM-79/22" in row["source"])
    low, high = float(aircraft["KV_low"]), float(aircraft["KV_high"])
    # FAR 25.812 asks for 86 cd/m2 (25 foot-lamberts); 8 is FDS's constant, for signs like Jin's.
    return [("aircraft exit sign, DOT/FAA/AM-79/22",
             86.0 * numpy.exp(-high), 86.0 * numpy.exp(-low)),
            ("Jin, K V = 8, 100 to 500 cd/m2",
             100.0 * numpy.exp(-8.0), 500.0 * numpy.exp(-8.0))]


def compute(_=None):
    noises = numpy.logspace(-2.5, 0.5, 301)
    spread = {}
    for minutes in (5.0, DETAIL, 20.0):
        ratio = numpy.log(ours(BACKGROUNDS, noises[:, None]) / adrian(BACKGROUNDS, minutes))
        spread[minutes] = ratio.std(axis=1)
    best = {minutes: float(noises[values.argmin()]) for minutes, values in spread.items()}
    over = {minutes: (float((ours(BACKGROUNDS) / adrian(BACKGROUNDS, minutes)).min()),
                      float((ours(BACKGROUNDS) / adrian(BACKGROUNDS, minutes)).max()))
            for minutes in spread}
    implied = [(name, noise_of_reading(low), noise_of_reading(high))
               for name, low, high in readings()]
    return {"best": best, "over": over, "implied": implied}


def judge(numbers):
    implied = "; ".join(
        f"{name}: {low:.2f} to {high:.2f}" for name, low, high in numbers["implied"])
    best = ", ".join(f"{value:.2f} ({minutes:g}')" for minutes, value in numbers["best"].items())
    low, high = numbers["over"][DETAIL]
    inside = all(a <= DEFAULT <= b for _, a, b in numbers["implied"])
    return Verdict(
        f"DarkLuminance [cd/m2] that readings ask for: {implied}; that makes 0.2 run parallel to "
        f"Adrian's thresholds from 0.001 to 1 cd/m2: {best}", AGREES if inside else DISAGREES,
        "0.1 lies within what readings of signs in smoke ask for. With it the contrast 0.2 is "
        f"{low:.0f} to {high:.0f} times what Adrian finds just detectable for details of "
        f"{DETAIL:g}': to read takes more than to detect. The CIE reference task (4', 0.2 s) needs "
        f"{cie(1e-9):.3f} cd/m2 in the dark, twice the {ours(0.0):.3f} cd/m2 here, where eyes have "
        "time and bars are larger")


def draw(numbers, path):
    figure, plots = claims.axes(11.0, 4.4, 2)
    plot = plots[0][0]
    plot.loglog(BACKGROUNDS, ours(BACKGROUNDS), "k-", linewidth=2,
                label="perceived contrast 0.2, noise 0.1 cd/m2")
    plot.fill_between(BACKGROUNDS, ours(BACKGROUNDS, 0.03), ours(BACKGROUNDS, 0.3),
                      color="k", alpha=0.1,
                      label="the same, noise 0.03 to 0.3 cd/m2")
    for minutes, style in ((5.0, "--"), (10.0, "-"), (20.0, ":")):
        plot.loglog(BACKGROUNDS, adrian(BACKGROUNDS, minutes), style, color="#2060c0",
                    label=f"just detected, {minutes:g}' (Adrian 1989)")
    plot.loglog(BACKGROUNDS, cie(BACKGROUNDS), "-.", color="#d03020", label="4', 0.2 s (CIE 19/2)")
    plot.set_xlabel("luminance of the ground [cd/m2]")
    plot.set_ylabel("luminance difference at threshold [cd/m2]")
    plot.grid(alpha=0.3)
    plot.legend(fontsize=7)
    plot = plots[0][1]
    for row, (name, low, high) in enumerate(numbers["implied"]):
        plot.plot([low, high], [row, row], linewidth=8, solid_capstyle="butt", color="#e08000")
        plot.text(low, row + 0.15, name, fontsize=8)
    for row, (minutes, value) in enumerate(numbers["best"].items()):
        plot.plot([value], [row + 2], "o", color="#2060c0")
        plot.text(value * 1.08, row + 2, f"shape of Adrian's thresholds, {minutes:g}'",
                  fontsize=8, va="center")
    plot.axvline(DEFAULT, color="k", linewidth=1)
    plot.set_xscale("log")
    plot.set_xlim(0.01, 1.0)
    plot.set_ylim(-0.5, 4.7)
    plot.set_yticks([])
    plot.set_xlabel("DarkLuminance that they ask for [cd/m2]")
    claims.save(figure, path)


if __name__ == "__main__":
    claims.main(sys.modules[__name__])
