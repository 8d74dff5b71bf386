"""Log-log plots of the benchmark's CSV files: python3 plot.py FOLDER. Files that are missing are left out."""
import csv
import os
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402


def read(folder, name):
    """Rows of a CSV file as dictionaries; empty where there is no file."""
    path = os.path.join(folder, name + ".csv")
    if not os.path.exists(path):
        return []
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def numbers(rows, column):
    return [float(row[column]) if row[column] else float("nan") for row in rows]


def plot_tunnel(folder):
    """Error of the tunnel's image against time, all pixels and dark bars, solver and integrator."""
    rows = read(folder, "tunnel")
    if not rows:
        return
    figure, axes = pyplot.subplots(1, 2, figsize=(10, 4), sharey=True)
    for axis, column, title in zip(
            axes, ("pixel_error", "veil_error"), ("all pixels", "dark bars (veil)")):
        for method, marker in (("solver", "o"), ("reference integrator", "s")):
            chosen = [row for row in rows if row["method"] == method]
            axis.loglog(numbers(chosen, "processor_s"), numbers(chosen, column), marker + "-",
                        label=method)
        axis.set(title="Tunnel, 64 x 64, " + title, xlabel="processor seconds",
                 ylabel="relative error (rms)")
        axis.grid(True, which="both", alpha=0.3)
        axis.legend()
    save(figure, folder, "tunnel")


def plot_maps(folder):
    """Error of contrast against time for the maps."""
    titles = {"hall12": "hall, 12 x 8 places", "fire12": "burning hall, 12 x 8 places",
              "hall110": "hall, 110 x 70 places",
              "hall10m": "hall, 12 x 8 places, 10 million cells",
              "office": "office, 10 x 8 places"}
    maps = {name: read(folder, name) for name in titles}
    if not any(maps.values()):
        return
    figure, axis = pyplot.subplots(figsize=(7, 6))
    for index, (name, rows) in enumerate(maps.items()):
        for method, style in (("solver", "o-"), ("reference integrator", "s--")):
            chosen = [row for row in rows if row["method"] == method]
            if chosen:
                axis.loglog(numbers(chosen, "processor_s"), numbers(chosen, "contrast_error"),
                            style, color=f"C{index}", label=f"{titles[name]}, {method}")
    axis.set(title="Floor maps", xlabel="processor seconds (light field and map)",
             ylabel="error of contrast (rms)")
    axis.grid(True, which="both", alpha=0.3)
    axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=2, fontsize="small")
    save(figure, folder, "maps")


def plot_growth(folder):
    """Time over the size of a scene, a panel a quantity."""
    rows = read(folder, "growth")
    names = list(dict.fromkeys(row["curve"] for row in rows))
    if not names:
        return
    figure, axes = pyplot.subplots(2, 3, figsize=(12, 7))
    for axis, name in zip(axes.flat, names):
        chosen = [row for row in rows if row["curve"] == name]
        values = numbers(chosen, "value")
        if name != "views":
            axis.plot(values, numbers(chosen, "field_processor_s"), "o-", label="light field")
            axis.plot(values, numbers(chosen, "setup_s"), "^-", label="set-up")
        axis.plot(values, numbers(chosen, "view_s"), "s-",
                  label="all views" if name == "views" else "a view of the sign")
        if name != "albedo":
            axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set(xlabel=name, ylabel="seconds")
        axis.grid(True, which="both", alpha=0.3)
        axis.legend()
    save(figure, folder, "growth")


def save(figure, folder, name):
    figure.tight_layout()
    figure.savefig(os.path.join(folder, name + ".png"), dpi=100)
    pyplot.close(figure)


if __name__ == "__main__":
    plot_tunnel(sys.argv[1])
    plot_maps(sys.argv[1])
    plot_growth(sys.argv[1])
