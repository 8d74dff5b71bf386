"""Claim: without ambient light the sign is lost near an optical density of 1 per metre."""
import sys

import claims
import tunnel as scene
from claims import DISAGREES, IN_PART, Verdict

CLAIM = ("Without ambient light the sign is lost (contrast 0.2) near an optical density of 1 per "
         "metre")
LUMINANCES = (100.0, 500.0, 2000.0)  # cd/m2
NOISES = (0.03, 0.1, 0.3)  # cd/m2
SIGNS = (("square", "red"), ("barcode", "red"), ("square", "green"), ("barcode", "green"))
# "Near": 0.2/m over the four metres is a factor of 6 in the light that arrives.
NEAR = 0.2


def contrast_over(tunnel, densities, smoke, pattern, colour, luminance, noise, **open_choices):
    return [scene.contrast(
        tunnel.picture(smoke, d, pattern, colour, luminance, **open_choices), noise)
        for d in densities]


def compute(tunnel, densities=scene.DENSITIES, signs=SIGNS):
    curves, lost, varied = {}, {}, {}
    for smoke in scene.SMOKES:
        for pattern, colour in signs:
            key = smoke, pattern, colour
            curves[key] = contrast_over(tunnel, densities, *key, scene.SIGN_LUMINANCE, scene.DARK)
            lost[key] = [scene.crossing(densities, curves[key], level) for level in (
                scene.THRESHOLD - scene.BAND, scene.THRESHOLD, scene.THRESHOLD + scene.BAND)]
        pattern, colour = signs[0]
        for luminance in LUMINANCES:
            for noise in NOISES:
                varied[smoke, luminance, noise] = scene.crossing(densities, contrast_over(
                    tunnel, densities, smoke, pattern, colour, luminance, noise), scene.THRESHOLD)
        plain = contrast_over(tunnel, densities, smoke, pattern, colour, 1.0, 0.0)
        varied[smoke, "no noise"] = plain[-1], scene.crossing(densities, plain, scene.THRESHOLD)
    return {"densities": list(densities), "curves": curves, "lost": lost, "varied": varied}


def judge(numbers):
    texts = [f"{smoke}, {colour} {pattern}: {found[1]:.2f} ({found[2]:.2f} to {found[0]:.2f})"
             for (smoke, pattern, colour), found in numbers["lost"].items()]
    middle = [found[1] for found in numbers["lost"].values()]
    good = [abs(value - 1.0) <= NEAR for value in middle]
    spread = [value for key, value in numbers["varied"].items() if len(key) == 3 and value]
    plain = {key[0]: value[0] for key, value in numbers["varied"].items() if len(key) == 2}
    last = numbers["densities"][-1]
    # Luminance and noise, which decide it, are not the paper's, and its photograph has another
    # course: more than agreement in part cannot be said.
    return Verdict(
        "; ".join(texts), IN_PART if any(good) else DISAGREES,
        f"at {scene.SIGN_LUMINANCE:g} cd/m2 and a noise of {scene.DARK:g} cd/m2, both open in the "
        f"paper; for {LUMINANCES[0]:g} to {LUMINANCES[-1]:g} cd/m2 and {NOISES[0]:g} to "
        f"{NOISES[-1]:g} cd/m2 it is {min(spread):.2f} to {max(spread):.2f}. Green in soot is lost "
        "earlier, its extinction is 1.19 times that at 633 nm. The sign is lost for its faintness: "
        f"without noise of eye or camera the contrast at {last:g}/m is still "
        f"{plain['glycol']:.2f} (glycol) and {plain['soot']:.2f} (soot)")


def draw(numbers, path):
    figure, plots = claims.axes(11.0, 4.4, 2)
    for plot, smoke in zip(plots[0], scene.SMOKES):
        claims.threshold_band(plot)
        for (name, pattern, colour), values in numbers["curves"].items():
            if name == smoke:
                plot.plot(numbers["densities"], values, "-o" if pattern == "square" else "--s",
                          markersize=4, color=claims.COLOURS[colour], label=f"{colour} {pattern}")
        spread = [value for key, value in numbers["varied"].items()
                  if key[0] == smoke and len(key) == 3 and value]
        plot.hlines(0.2, min(spread), max(spread), color="#e0a000", linewidth=4, zorder=5,
                    label="threshold, 100 to 2000 cd/m2, noise 0.03 to 0.3 cd/m2")
        claims.density_axis(plot)
        plot.set_title(f"No ambient light, {smoke}, {scene.SIGN_LUMINANCE:g} cd/m2", fontsize=10)
        plot.legend(fontsize=8, loc="upper right")
    claims.save(figure, path)


if __name__ == "__main__":
    claims.main(sys.modules[__name__])
