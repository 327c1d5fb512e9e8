"""Every public name is in an example that is run: in a docstring, in docs/recipes.md, or in docs/examples."""

import ast
import doctest
import importlib
import inspect
import os
import pkgutil
import re
import time
from pathlib import Path

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
import pytest
from public import public_things

import dondolo as dd


def recipes(root):
    """The page as a doctest, without the fences of its blocks."""
    text = re.sub(r"(?m)^```.*$", "", (root / "docs/recipes.md").read_text())
    return doctest.DocTestParser().get_doctest(text, {}, "recipes", "docs/recipes.md", 0)


def docstrings():
    finder = doctest.DocTestFinder()
    modules = ["dondolo", *(module.name for module in pkgutil.walk_packages(dd.__path__, "dondolo."))]
    return [test for name in modules for test in finder.find(importlib.import_module(name))]


def names_in(source):
    """Names and attributes that a source uses."""
    nodes = list(ast.walk(ast.parse(source)))
    return {one.attr for one in nodes if isinstance(one, ast.Attribute)} | {
        one.id for one in nodes if isinstance(one, ast.Name)
    }


def public_names():
    """Names of the package, of its pulses, and of the methods of its classes, inherited ones too."""
    for name, thing in public_things().items():
        if name == "__version__":
            continue
        yield name, name
        if inspect.isclass(thing) and not issubclass(thing, BaseException):
            for method, one in inspect.getmembers(thing, lambda one: inspect.isfunction(one) or inspect.ismethod(one)):
                if not method.startswith("_") and one.__module__.startswith("dondolo"):
                    yield f"{name}.{method}", method
    for name in dd.pulses.__all__:
        yield f"pulses.{name}", name


def test_every_public_name_has_an_example(root):
    """A method counts by its name: that of a base class, or of the same name in another class, is enough."""
    tests = [*docstrings(), recipes(root)]
    sources = [example.source for test in tests for example in test.examples if doctest.SKIP not in example.options] + [
        path.read_text() for path in (root / "docs/examples").glob("*.py")
    ]
    used = set().union(*map(names_in, sources))
    public = dict(public_names())
    assert len(public) > 270
    assert sorted(name for name, word in public.items() if word not in used) == []


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_recipes(root, tmp_path, monkeypatch, executable):
    """The page runs as a reader copies it, quickly, and without what is not installed."""
    pytest.importorskip("pandas")
    pytest.importorskip("openpyxl")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", f"{Path(executable).parent}{os.pathsep}{os.environ['PATH']}")
    page, start = recipes(root), time.process_time()
    assert len(page.examples) > 100
    done = doctest.DocTestRunner().run(page)
    plt.close("all")
    assert done.failed == 0
    assert time.process_time() - start < 20.0
