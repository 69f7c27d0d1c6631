"""pictures.md: pictures of `render` against path tracing."""

from __future__ import annotations

from tables import RemakeError, table_from_markdown
from page import Page

NOISE = 0.01  # of the reference's blocks
# File in scenes/pictures: what it is, and the bar.
SCENES = {
    "sphere": ("sphere, sigma_a 0.1, sigma_s 10, point light", "3 %"),
    "thin": ("the same, sigma_s 4", "3-5 %"),
    "dense": ("the same, sigma_s 40", "3-5 %"),
    "torus": ("torus", "3-5 %"),
    "plate": ("backlit plate 0.3 thick", "3-5 %"),
    "bunny": ("bunny, sigma_s 15", "3-5 %"),
    "g08": ("sphere, g = 0.8, sigma_s 50", "6 %"),
    "ior": ("sphere, index 1.4, even sky", "3 %"),
    "furnace": ("white furnace (even sky, index 1)", "2 %"),
}
WANTED = ("CPU s", "mean / truth", "rms of blocks", "noise in it", "without it", "for 1 % per pixel")


def make(page: Page) -> None:
    page.has_bunny()
    printed = page.benchmark("pictures/picture_bars", "-o", page.folder / "pictures",
                             *(["--only", "thin", "--noise", 0.1] if page.quick else ["--noise", NOISE]))
    table = table_from_markdown(printed)
    columns = [table.columns.index(name) for name in WANTED]
    measured = {row[0]: row for row in table.rows}
    unknown = [name for name in measured if name not in SCENES]
    if unknown:
        raise RemakeError(f"scene {unknown[0]} of scenes/pictures has no row in the table")
    page.table("scenes", "scene | bar | CPU s | mean / truth | rms of blocks | noise in it | without it | "
               "reference CPU s for 1 % per pixel", [
        [what + (", not trusted" if "not trusted" in measured[name] else ""), bar,
         *(measured[name][column] for column in columns)]
        for name, (what, bar) in SCENES.items() if name in measured])
