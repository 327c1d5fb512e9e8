"""The recipes of conda-forge and Spack for a release: python recipes.py SDIST FOLDER

Writes them into the folder, as they are submitted, with the checksum of the sdist that PyPI will have.
"""

import hashlib
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
UNKNOWN = "0" * 64
RECIPES = {"conda-forge/recipe.yaml": "conda-forge-recipe.yaml", "spack/package.py": "spack-package.py"}


def write_recipes(sdist: Path, folder: Path) -> None:
    """Write the recipes with the checksum of an sdist in the place of zeros."""
    checksum = hashlib.sha256(sdist.read_bytes()).hexdigest()
    for recipe, name in RECIPES.items():
        text = (HERE / recipe).read_text()
        version = sdist.name.removeprefix("dondolo-").removesuffix(".tar.gz")
        if text.count(UNKNOWN) != 1 or f'"{version}"' not in text:
            sys.exit(f"{recipe}: must name version {version}, and have 64 zeros for the checksum")
        (folder / name).write_text(text.replace(UNKNOWN, checksum))


if __name__ == "__main__":
    write_recipes(Path(sys.argv[1]), Path(sys.argv[2]))
