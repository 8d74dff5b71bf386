"""What forward scattering would change, which the paper leaves open and the solver leaves out.

Droplets of glycol send most light on in nearly its old direction. By the similarity relation a
smoke with the mean cosine g of the scattering angle spreads light as an isotropic one with the
scattering coefficient (1 - g) sigma_s does (van de Hulst, Multiple Light Scattering, 1980, ch. 14).
That is solved. It says nothing of where the light that is sent on ends in the picture. What keeps
the sign's outline, its own light and the glow right before it, comes from the far end of the
tunnel; the share r = exp(-(K - K') s) of it comes straight. Three assumptions on the rest: all in
its place (the sharpest image that there can be), all spread evenly over the plate (the dullest),
or the sign's own light spread so wide that next to none falls on the plate. The last is nearest to
droplets: of a Henyey-Greenstein lobe of g = 0.75 one percent lies within the 2.1 degrees that half
the plate spans.
"""
import sys

import claims
import numpy
import tunnel as scene
from claims import AGREES, DISAGREES, IN_PART, Verdict

CLAIM = "Forward scattering of the glycol smoke (an assumption that the paper leaves open)"
# By Mie's theory droplets of refractive index 1.43 and median diameters of 0.3 to 2 um, with a
# geometric standard deviation of 1.5, have 0.71 to 0.76 at 550 nm.
COSINES = (0.0, 0.5, 0.75)
DENSITIES = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.7, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5)
CASES = {"dark": (), "both lamps": ("sign", "camera")}
WHERE = ("wide", "haze", "image")
NEAR = 0.2  # as in lost_near_one.py
LINE = 0.05  # what a line may miss, a share of the first value, as in square_falls_linearly.py
ALBEDO = scene.SMOKES["glycol"][0]
DISTANCE = scene.SIZE[0] - scene.CAMERA[0]


def similar(density, cosine):
    """Extinction coefficient [1/m] and albedo of the isotropic smoke."""
    extinction = scene.extinction(density, "glycol", "lamp")
    rest = 1.0 - cosine * ALBEDO
    return extinction * rest, ALBEDO * (1.0 - cosine) / rest


def pictures(tunnel, density, cosine, lamps=(), flux=scene.LAMP_FLUX):
    """The plate [cd/m2] by each assumption."""
    def plate(source, at=density):
        return tunnel.plate(*similar(at, cosine), source).picture
    image = scene.SIGN_LUMINANCE * plate("square")
    extinction = similar(density, cosine)[0]
    straight = numpy.exp((extinction - similar(density, 0.0)[0]) * DISTANCE)
    own = scene.SIGN_LUMINANCE * plate("square", 0.0).mean() * numpy.exp(-extinction * DISTANCE)
    haze = image.mean() + straight * (image - image.mean())
    veil = sum((tunnel.lamp_luminance(flux) * plate("lamp near " + which) for which in lamps), 0.0)
    return {"image": image + veil, "haze": haze + veil,
            "wide": haze - (1.0 - straight) * own + veil}


def compute(tunnel, densities=DENSITIES, cosines=COSINES, cases=tuple(CASES)):
    curves, lost, lines, ratios = {}, {}, {}, {}
    for cosine in cosines:
        for case in cases:
            rows = [pictures(tunnel, d, cosine, CASES[case]) for d in densities]
            for where in WHERE:
                key = cosine, case, where
                found = [scene.measures(row[where]) for row in rows]
                curves[key] = [values["perceived"] for values in found]
                lost[key] = scene.crossing(densities, curves[key], scene.THRESHOLD)
                lines[key] = claims.fit_range(
                    densities, [values["photograph"] for values in found], 1, LINE).end
        if "both lamps" in cases:
            near, far = [tunnel.plate(*similar(0.4, cosine), "lamp near " + which).picture.mean()
                         for which in ("camera", "sign")]
            ratios[cosine] = float(near / far)
    return {"densities": list(densities), "curves": curves, "lost": lost, "lines": lines,
            "ratios": ratios}


def said(value, last):
    return f"above {last:g}" if value is None else f"{value:.2f}"


def judge(numbers):
    last = numbers["densities"][-1]
    texts, good = [], []
    for cosine in sorted({key[0] for key in numbers["curves"]}):
        parts = []
        for case in sorted({key[1] for key in numbers["curves"]}, reverse=True):
            wide, haze, image = [said(numbers["lost"][cosine, case, where], last)
                                 for where in ("wide", "haze", "image")]
            parts.append(f"{case} {wide} 1/m" + (f" ({haze} to {image})" if cosine else ""))
        if cosine in numbers["ratios"]:
            parts.append(
                f"the lamp near the camera {numbers['ratios'][cosine]:.1f} times the other")
            good.append(numbers["ratios"][cosine] > 1.0)
        parts.append("photograph in the dark on a line to "
                     f"{numbers['lines'][cosine, 'dark', 'wide']:g} 1/m")
        lost = numbers["lost"][cosine, "dark", "wide"]
        good.append(lost is not None and abs(lost - 1.0) <= NEAR)
        texts.append(f"g = {cosine:g}: lost at " + ", ".join(parts))
    return Verdict(
        "; ".join(texts), AGREES if all(good) else IN_PART if any(good) else DISAGREES,
        "glycol, red square, by the similarity relation; g = 0 is what all other rows have, 0.75 "
        "what droplets of about 1 um have. The light that is sent on is taken to be spread wide of "
        "the plate, as such droplets do (in brackets: all of it as haze over the plate, all of it "
        "as image); the relation cannot tell more, and the brackets are wide. Agrees where the "
        "sign is lost in the dark near 1 per metre and the lamp near the camera is the worse one. "
        "Less light is turned back then: lamps veil less, and the one near the camera is less "
        "ahead, but the worse one still. More of the sign's own light comes as glow: in the dark "
        "the sign drowns in it before it is too faint, earlier than without")


def draw(numbers, path):
    cases = sorted({key[1] for key in numbers["curves"]}, reverse=True)
    cosines = sorted({key[0] for key in numbers["curves"]})
    figure, plots = claims.axes(5.5 * len(cases), 4.6, len(cases), sharey=True)
    shades = claims.plt.get_cmap("viridis")(numpy.linspace(0.0, 0.8, len(cosines)))
    for plot, case in zip(plots[0], cases):
        claims.threshold_band(plot)
        for cosine, shade in zip(cosines, shades):
            low, middle, high = [numbers["curves"][cosine, case, where]
                                 for where in ("haze", "wide", "image")]
            x = numbers["densities"]
            plot.plot(x, middle, "-o", markersize=3, color=shade, label=f"g = {cosine:g}")
            if cosine:
                plot.plot(x, high, "--", color=shade, linewidth=1)
                plot.plot(x, low, ":", color=shade, linewidth=1)
        claims.density_axis(plot)
        plot.set_title(f"Red square, glycol, {case}; light sent on:\nwide of the plate (full), "
                       "as image (dashed), as haze (dotted)", fontsize=9)
        plot.legend(fontsize=8)
    claims.save(figure, path)


if __name__ == "__main__":
    claims.main(sys.modules[__name__])
