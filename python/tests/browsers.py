"""The browser of the tests of pages: Chromium, which ./run test installs."""

import os
import shutil

import pytest

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
# On the machines that decide about a change no test of a page may be left out in silence: there they fail.
needs_browser = pytest.mark.skipif(
    CHROMIUM is None and "GITHUB_ACTIONS" not in os.environ, reason="no browser here: apt-get install chromium"
)
