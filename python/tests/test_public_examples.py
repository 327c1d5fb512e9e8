"""Every public name is in an example that is run: in a docstring, or in docs/examples."""

import ast
import doctest
import importlib
import inspect
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

MODULES = ["dondolo", *(module.name for module in pkgutil.walk_packages(dd.__path__, "dondolo."))]
TESTS = [
    test for name in MODULES for test in doctest.DocTestFinder().find(importlib.import_module(name)) if test.examples
]
# What an example may take, imports apart [s]
SLOWEST = 1.0


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


def words_in(annotation):
    """Names in an annotation, which is a string."""
    return set(re.findall(r"\w+", str(annotation)))


def returned(used):
    """Names of the types that functions, methods and attributes return that examples use."""
    words = set()
    for thing in public_things().values():
        for name, one in [(getattr(thing, "__name__", ""), thing), *inspect.getmembers(thing)]:
            if name in used:
                words |= words_in(getattr(getattr(one, "fget", one), "__annotations__", {}).get("return", ""))
        for base in inspect.getmro(thing) if inspect.isclass(thing) else ():
            fields = inspect.get_annotations(base)
            words |= set().union(*(words_in(kind) for name, kind in fields.items() if name in used))
    return words


@pytest.fixture(scope="module")
def installed():
    """What examples take besides, imported before their time counts."""
    for name in ("pandas", "xlsxwriter", "scipy.stats", "scipy.optimize", "matplotlib.animation"):
        pytest.importorskip(name)
    plt.close(plt.figure())


@pytest.mark.parametrize("test", TESTS, ids=lambda test: test.name)
@pytest.mark.usefixtures("installed")
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning", "ignore:Animation was deleted")
def test_example(test, tmp_path, monkeypatch):
    """Each runs as a reader copies it: in an empty folder, with only the names that it imports, and soon."""
    spent = []
    # On a busy machine one turn may be slow.
    for turn in range(3):
        folder = tmp_path / str(turn)
        folder.mkdir()
        monkeypatch.chdir(folder)
        test.globs = {}
        start = time.process_time()
        done = doctest.DocTestRunner().run(test)
        spent.append(time.process_time() - start)
        plt.close("all")
        assert done.failed == 0
        if min(spent) < SLOWEST:
            return
    pytest.fail(f"CPU times of three turns, s: {spent}")


def test_every_public_name_has_an_example():
    """A method counts by its name: that of a base class, or of the same name in another class, is enough.

    Types of results count if something returns them that an example uses, base classes by the classes made of them.
    """
    folder = Path(__file__).resolve().parents[2] / "docs/examples"
    sources = [example.source for test in TESTS for example in test.examples if doctest.SKIP not in example.options] + [
        path.read_text() for path in folder.glob("*.py")
    ]
    used = set().union(*map(names_in, sources))
    used |= returned(used)
    things = public_things()
    for name, thing in things.items():
        if name in used and inspect.isclass(thing):
            used |= {base.__name__ for base in inspect.getmro(thing)}
    public = dict(public_names())
    assert len(TESTS) > 100
    assert len(public) > 270
    assert sorted(name for name, word in public.items() if word not in used) == []
