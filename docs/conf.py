"""The documentation site: Sphinx reads the pages of this folder where they are. ./run docs builds it."""

import sys
from pathlib import Path

import dondolo as dd

sys.path.insert(0, str(Path(__file__).parent))
from site_pages import write_pages

project = "dondolo"
author = copyright = "the dondolo contributors"
version = release = dd.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.autosummary", "numpydoc"]
extensions += ["sphinx_copybutton", "sphinx_design", "site_math"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
exclude_patterns = ["verification/**", "site/**"]
templates_path = ["site/templates"]

# As GitHub shows the same pages
myst_enable_extensions = ["dollarmath", "colon_fence", "deflist"]
myst_heading_anchors = 4
myst_fence_as_directive = ["math"]
html_math_renderer = "mathml"

autosummary_generate = True
autodoc_typehints = "none"
autodoc_member_order = "bysource"
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False

html_theme = "pydata_sphinx_theme"
html_title = f"dondolo {version}"
html_show_sourcelink = False
html_theme_options = {"navigation_with_keys": False, "show_prev_next": True, "secondary_sidebar_items": ["page-toc"]}
# Pages without neighbours
html_sidebars = {"tutorial/first_wall": []}
# The curve of "In the browser" is drawn as the page of `dondolo serve` draws it.
page = "../python/dondolo/serve/page"
html_static_path = ["site/static", f"{page}/chart.js", f"{page}/words.js"]
html_css_files = ["site.css"]
html_favicon = "site/static/favicon.svg"
copybutton_prompt_text = "$ "


def setup(app):
    """Write the pages that follow from the program before Sphinx looks for them."""
    # Before the pages are looked for, so that autosummary finds the names
    app.connect("config-inited", lambda app, config: write_pages(Path(app.srcdir)))
