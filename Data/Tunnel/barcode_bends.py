"""Claim: the barcode's contrast is higher than the square's and bends like a quadratic."""
import sys

import claims
import numpy
import square_falls_linearly as square
import tunnel as scene
from claims import AGREES, DISAGREES, IN_PART, Verdict

CLAIM = "The barcode's contrast is higher than the square's and bends like a quadratic"
# Side of the lit square over that of the plate: the paper does not give the part of the picture in
# which its contrast is taken, and the share of lit area in it decides which sign is ahead.
FRACTIONS = (0.5, scene.SQUARE, 0.9)


def compute(tunnel, densities=scene.DENSITIES, fractions=FRACTIONS):
    curves = square.curves(tunnel, "barcode", densities)
    other = square.curves(tunnel, "square", densities)
    fits = {key: claims.fit_range(densities, values, 2, square.ALLOWED)
            for key, values in curves.items()}
    straight = {key: claims.fit(numpy.array(densities)[:found.points],
                                numpy.array(curves[key])[:found.points], 1)
                for key, found in fits.items()}
    shares = {}
    for smoke in scene.SMOKES:
        for fraction in fractions:
            shares[smoke, fraction] = [
                scene.contrast(scene.SIGN_LUMINANCE * tunnel.sign(
                    smoke, d, "square", square=fraction).picture, scene.DARK) for d in (0.0, 0.4)]
        shares[smoke, "barcode"] = [
            scene.contrast(tunnel.picture(smoke, d, "barcode"), scene.DARK) for d in (0.0, 0.4)]
    return {"densities": list(densities), "curves": curves, "square": other, "fits": fits,
            "straight": straight, "shares": shares}


def ahead(numbers, key):
    """Largest and smallest lead of the barcode over the square of the same lit share."""
    lead = numpy.subtract(numbers["curves"][key], numbers["square"][key])
    return float(lead.min()), float(lead.max())


def judge(numbers):
    texts, better, bent = [], [], []
    for key, found in numbers["fits"].items():
        smoke, case, measure = key
        if measure != "perceived":
            continue
        low, high = ahead(numbers, key)
        gain = numbers["straight"][key].residual / max(found.residual, 1e-9)
        texts.append(f"{smoke}, {case}: lead {low:+.3f} to {high:+.3f}; "
                     f"quadratic to {found.end:.1f}/m "
                     f"(residual {100 * found.residual:.1f} %, a line's {gain:.1f} times that, "
                     f"bent {'down' if found.coefficients[0] < 0.0 else 'up'})")
        better.append(low > -0.005 and high > 0.005)
        bent.append(gain > 2.0)
    shares = numbers["shares"]
    clear = ", ".join(f"{shares['glycol', fraction][0]:.2f} (square of {fraction:g})"
                      for fraction in FRACTIONS if ("glycol", fraction) in shares)
    agrees = (AGREES if all(better + bent) else IN_PART if any(better + bent) else DISAGREES)
    return Verdict(
        "; ".join(texts), agrees,
        "which sign is ahead depends on the share of lit area in the part of the picture that is "
        f"measured: in clear air the barcode has {shares['glycol', 'barcode'][0]:.2f} and the "
        f"square {clear}, its side over the plate's. With equal shares the two differ by the blur "
        "of the smoke's glow alone, which costs narrow bars more than a large square. The curves "
        "do bend, the square's as well")


def draw(numbers, path):
    square.draw(numbers, path, "Red barcode")


if __name__ == "__main__":
    claims.main(sys.modules[__name__])
