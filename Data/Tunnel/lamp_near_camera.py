"""Claim: the light near the camera hurts more than the one near the sign."""
import sys

import claims
import numpy
import tunnel as scene
from claims import AGREES, DISAGREES, IN_PART, Verdict

CLAIM = "The light near the camera hurts more than the one near the sign"
# What the paper leaves open: how far the lamps are from the ends [m], and the walls' reflectance.
OPEN = ({}, {"lamp_from_end": 0.25}, {"lamp_from_end": 1.0}, {"reflectance": 0.05},
        {"reflectance": 0.5})
VARIED_AT = 0.4  # optical density per metre at which these are tried


def veils(tunnel, smoke, density, **open_choices):
    """Mean veil of each lamp over the plate [cd/m2]."""
    return [scene.LAMP_FLUX / (numpy.pi * tunnel.lamp_area()) *
            tunnel.lamp(smoke, density, which, **open_choices).picture.mean()
            for which in ("camera", "sign")]


def compute(tunnel, densities=scene.DENSITIES, pattern="square", choices=OPEN):
    result = {"densities": list(densities), "veils": {}, "contrasts": {}, "varied": {}}
    for smoke in scene.SMOKES:
        result["veils"][smoke] = [veils(tunnel, smoke, d) for d in densities]
        for lamps in ((), ("sign",), ("camera",)):
            result["contrasts"][smoke, lamps] = [
                scene.contrast(tunnel.picture(smoke, d, pattern, lamps=lamps), scene.DARK)
                for d in densities]
        for choice in choices:
            camera, sign = veils(tunnel, smoke, VARIED_AT, **choice)
            result["varied"][smoke, tuple(choice.items())] = camera / sign
    return result


def lost(numbers, smoke, which):
    """Contrast that a lamp takes, as the area between the curves [1/m]."""
    dark = numpy.trapz(numbers["contrasts"][smoke, ()], numbers["densities"])
    return dark - numpy.trapz(numbers["contrasts"][smoke, (which,)], numbers["densities"])


def judge(numbers):
    texts, good = [], []
    for smoke in scene.SMOKES:
        ratio = lost(numbers, smoke, "camera") / lost(numbers, smoke, "sign")
        veil = {d: v[0] / v[1] for d, v in zip(numbers["densities"], numbers["veils"][smoke])
                if 0.0 < d <= 1.0}
        texts.append(f"{smoke}: takes {ratio:.1f} times the contrast; "
                     f"its veil is {min(veil.values()):.1f} "
                     f"to {max(veil.values()):.0f} times as bright from 0.1 to 1/m")
        good.append(ratio > 1.0 and min(veil.values()) > 1.0)
    spread = numbers["varied"].values()
    return Verdict(
        "; ".join(texts), AGREES if all(good) else IN_PART if any(good) else DISAGREES,
        "the camera looks through the glow of the near lamp, and that of the far one is weakened "
        "on its way. Lamps 0.25 to 1 m from the ends and walls of 0.05 to 0.5 give veils "
        f"{min(spread):.1f} to {max(spread):.1f} times as bright at {VARIED_AT:g}/m")


def draw(numbers, path):
    figure, plots = claims.axes(11.0, 4.4, 2)
    for plot, smoke in zip(plots[0], scene.SMOKES):
        claims.threshold_band(plot)
        for lamps, label, style in (((), "no lamp", "-o"), (("sign",), "lamp near the sign", "--s"),
                                    (("camera",), "lamp near the camera", ":^")):
            plot.plot(numbers["densities"], numbers["contrasts"][smoke, lamps], style, markersize=4,
                      label=label)
        claims.density_axis(plot)
        plot.set_title(f"Red square, {smoke}, a lamp of {scene.LAMP_FLUX:g} lm", fontsize=10)
        plot.legend(fontsize=8)
    claims.save(figure, path)


if __name__ == "__main__":
    claims.main(sys.modules[__name__])
