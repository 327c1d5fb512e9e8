# ruff: noqa: F403, F405
"""Package file for Spack, with the checksum by packaging/recipes.py.

Not tried: Spack's mirrors could not be reached where it was written.
"""

from spack.package import *


class PyDondolo(PythonPackage):
    """Fragility of unreinforced masonry walls that rock and overturn in earthquakes."""

    pypi = "dondolo/dondolo-0.1.0.tar.gz"

    license("MIT")

    version("0.1.0", sha256="0000000000000000000000000000000000000000000000000000000000000000")

    depends_on("c", type="build")
    depends_on("fortran", type="build")
    depends_on("lapack")
    depends_on("pkgconfig", type="build")
    depends_on("python@3.11:", type=("build", "link", "run"))
    depends_on("py-meson-python@0.18:", type="build")
    depends_on("py-babel@2.14:", type="build")
    depends_on("meson@1.3:", type="build")
    depends_on("ninja", type="build")
    depends_on("py-numpy@2.0:", type=("build", "link", "run"))
    depends_on("py-scipy@1.15:", type="run")
    depends_on("py-matplotlib@3.9:", type="run")
    depends_on("py-tqdm@4.64:", type="run")
