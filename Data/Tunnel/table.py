"""All claims, one after the other, and the table of what became of them.

Usage: pvpython --force-offscreen-rendering table.py PLUGIN OUTPUT_FOLDER
"""
import csv
import os
import sys
import time

import claims

plugin, folder = sys.argv[1:3]
claims.load_plugin(plugin)

import ambient_over_colour  # noqa: E402
import barcode_bends  # noqa: E402
import burning_hall  # noqa: E402
import eye_noise  # noqa: E402
import forward_scattering  # noqa: E402
import jin  # noqa: E402
import lamp_near_camera  # noqa: E402
import lost_near_one  # noqa: E402
import photographs  # noqa: E402
import red_before_green  # noqa: E402
import square_falls_linearly  # noqa: E402

CLAIMS = (square_falls_linearly, barcode_bends, red_before_green, ambient_over_colour,
          lamp_near_camera, lost_near_one, forward_scattering, burning_hall, eye_noise, jin)

rows = []
for module in CLAIMS:
    start = time.perf_counter()
    verdict = claims.report(module, folder)
    print(f"  ({time.perf_counter() - start:.0f} s)\n", flush=True)
    rows.append((module.CLAIM, verdict.number, verdict.agrees, verdict.why))
photographs.take(folder)

HEADER = ("claim", "our number", "agrees", "why")
with open(os.path.join(folder, "claims.csv"), "w", encoding="utf-8", newline="") as file:
    csv.writer(file).writerows([HEADER, *rows])
with open(os.path.join(folder, "claims.md"), "w", encoding="utf-8") as file:
    for row in (HEADER, ("---",) * 4, *rows):
        file.write("| " + " | ".join(row) + " |\n")
print(f"Claims table in {os.path.join(folder, 'claims.md')}")
