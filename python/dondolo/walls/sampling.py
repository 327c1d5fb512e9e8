"""Sampled populations: walls whose properties are drawn from distributions.

Samples are a Latin hypercube (McKay, Beckman and Conover 1979): the range of every property is cut into as many parts
of equal probability as there are walls, and each part holds one wall. Correlation is brought in, and taken out where
none is wanted, by changing the order of the samples of a property alone (Iman and Conover 1982), so that this stays so.
"""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, as_count, as_number, one_of
from dondolo._fortran.buildings import BUILDING_NAMES
from dondolo._fortran.library import as_text, constants
from dondolo._fortran.walls import INDEPENDENT, WALL_LISTS, WALL_NUMBERS, WALL_PROPERTIES, WALL_TEXTS, describe_walls
from dondolo.errors import InputError
from dondolo.walls.distributions import Distribution, no_distribution
from dondolo.walls.mechanisms import MECHANISMS
from dondolo.walls.population import Population
from dondolo.walls.wall_columns import WallColumns

Samples = Mapping[str, FloatArray]
Property = float | str | Distribution | Callable[[Samples], Any]

_TEXTS = tuple(what for what in WALL_TEXTS if what not in ("name", "mechanism"))
_OWNERS = {row.name: row.owners for row in WALL_PROPERTIES if row.owners and row.name not in BUILDING_NAMES}
_PROPERTIES = (*WALL_NUMBERS, *_TEXTS, "weight", "p_occ")
# After so many the order hardly changes any more
_PASSES = 5


def sample_population(
    mechanisms: str | Iterable[str] | Mapping[str, Mapping[str, Property]],
    n_walls: int,
    seed: int,
    *,
    variables: Mapping[str, Distribution] | None = None,
    correlation: Mapping[tuple[str, str], float] | None = None,
    group: str = "",
    name: str = "",
    gravity: float | None = None,
    occurrence: str = INDEPENDENT,
    **properties: Property,
) -> Population:
    """Walls with sampled properties: see `Population.sample`."""
    own = _as_mechanisms(mechanisms)
    n, seed = as_count("n_walls", n_walls, 1), as_count("seed", seed, 0)
    as_text("group", group)
    as_text("name", name)
    variables = {} if variables is None else _as_mapping("variables", variables, "distributions by their names")
    correlation = {} if correlation is None else _as_mapping("correlation", correlation, "numbers by pairs of names")
    _check_variables(variables)
    _check_properties(own, properties)
    sampled = draw(n, seed, _distributions(own, variables, properties), correlation)

    known = {what: sampled[what] for what in variables}
    common = _evaluate(properties, "", sampled, known, n)
    prefix = name or group or "wall"
    names = [f"{prefix} {i:0{max(4, len(str(n)))}d}" for i in range(1, n + 1)]
    walls, p_occ = [], []
    for mechanism, extra in own.items():
        values = common | _evaluate(extra, f"{mechanism}.", sampled, known | common, n)
        walls.append(make_walls(mechanism, names, values, gravity))
        p_occ.append(values.get("p_occ", np.ones(n)))
    return Population(
        # Wall by wall, the mechanisms of each in their order
        WallColumns.join(walls).take(np.arange(n * len(own)).reshape(len(own), n).T.ravel()),
        np.repeat(common.get("weight", np.ones(n)), len(own)),
        group_names=(group,) * (n * len(own)),
        p_occ=np.stack(p_occ, axis=1).ravel(),
        occurrence=(occurrence,) * (n * len(own)),
        origin=_origin(
            f"{prefix}: {n} walls, a Latin hypercube of the seed {seed}", own, variables, correlation, properties
        ),
    )


def _as_mechanisms(mechanisms: Any) -> dict[str, dict[str, Property]]:
    """Mechanisms and what each has of its own."""
    if isinstance(mechanisms, str):
        mechanisms = (mechanisms,)
    if not isinstance(mechanisms, Iterable):
        raise argument_error("not_a_word", "mechanisms", f" = {mechanisms!r}: must be names of mechanisms")
    own: dict[str, dict[str, Property]] = {}
    for mechanism in mechanisms:
        one_of("mechanism", mechanism, MECHANISMS)
        if mechanism in own:
            raise argument_error("not_together", "mechanisms", f": {mechanism!r} is given twice")
        extra = mechanisms[mechanism] if isinstance(mechanisms, Mapping) else {}
        own[mechanism] = _as_mapping(mechanism, extra, "properties by their names")
    if not own:
        raise argument_error("not_given", "mechanisms", ": must be given")
    return own


def _as_mapping(name: str, value: Any, what: str) -> dict[Any, Any]:
    """Turn what a user gives for a mapping into a dictionary of one's own."""
    if not isinstance(value, Mapping):
        raise argument_error("wrong_type", name, f" = {value!r}: must be a mapping, {what}")
    return dict(value)


def _check_variables(variables: Mapping[str, Any]) -> None:
    """What is sampled for functions only must not look like a property."""
    for what, value in variables.items():
        as_text("variables", what)
        # A number of storeys may be one of the population that no wall has of a building, `free` a height
        if what in _PROPERTIES and what not in (*BUILDING_NAMES, "free"):
            raise argument_error(
                "not_together", "variables", f": {what!r} is a property of the walls, to be given as one"
            )
        if not isinstance(value, Distribution):
            raise no_distribution(what, value)


def _check_properties(own: Mapping[str, Mapping[str, Property]], properties: Mapping[str, Property]) -> None:
    """Every property must be one of the walls, and of the right kind."""
    for mechanism, extra in (("", properties), *own.items()):
        for what, value in extra.items():
            if what not in _PROPERTIES:
                raise InputError(f"{what!r}: no such property of walls; there are {', '.join(_PROPERTIES)}")
            if what == "weight" and mechanism:
                raise argument_error("not_together", "weight", ": belongs to the wall, not to one of its mechanisms")
            if what not in WALL_LISTS and isinstance(value, str) != (what in _TEXTS):
                raise argument_error(
                    "wrong_type", what, f" = {value!r}: must be a {'string' if what in _TEXTS else 'number'}"
                )
        for kind in [mechanism] if mechanism else own:
            for what in extra:
                # The weight of a wall among others, and not those of the bodies of a table
                if what != "weight" and kind not in _OWNERS.get(what, (kind,)):
                    raise argument_error(
                        "not_together", what, f": {kind} walls have none; give it to the mechanism that has it"
                    )


def _distributions(
    own: Mapping[str, Mapping[str, Property]], variables: Mapping[str, Any], properties: Mapping[str, Property]
) -> dict[str, Distribution]:
    """All that is sampled, by the names that a correlation has for them."""
    named = {**variables, **properties}
    named |= {f"{mechanism}.{what}": value for mechanism, extra in own.items() for what, value in extra.items()}
    return {what: value for what, value in named.items() if isinstance(value, Distribution)}


def draw(
    n: int, seed: int, distributions: Mapping[str, Distribution], correlation: Mapping[tuple[str, str], float]
) -> dict[str, FloatArray]:
    """Samples of all that is sampled."""
    from scipy.stats import qmc

    names = list(distributions)
    matrix = _matrix(names, correlation)
    if not names:
        return {}
    hypercube = qmc.LatinHypercube(len(names), seed=np.random.default_rng(seed))
    probabilities = hypercube.random(n)
    if n > len(names) > 1:
        # A few walls may come in orders of which one follows from the others
        while _is_singular(_correlation(_scores(probabilities))):
            probabilities = hypercube.random(n)
        probabilities = _reorder(probabilities, matrix)
    elif correlation:
        raise argument_error(
            "out_of_range",
            "n_walls",
            f" = {n}: must be at least {len(names) + 1} for correlations, more than are sampled: {', '.join(names)}",
        )
    return {what: _quantiles(what, distributions[what], probabilities[:, i]) for i, what in enumerate(names)}


def _quantiles(what: str, distribution: Distribution, probabilities: FloatArray) -> FloatArray:
    """Samples of one property or variable."""
    values = np.array(distribution.ppf(probabilities), dtype=np.float64)
    if values.shape != probabilities.shape or not np.isfinite(values).all():
        raise argument_error("wrong_type", what, f": its ppf must return {len(probabilities)} finite numbers")
    values.flags.writeable = False
    return values


def _matrix(names: Sequence[str], correlation: Mapping[tuple[str, str], float]) -> FloatArray:
    """Matrix of the correlations of all that is sampled."""
    matrix = np.eye(len(names))
    for pair, given in correlation.items():
        if not isinstance(pair, tuple) or len(pair) != 2 or pair[0] == pair[1]:
            raise argument_error("wrong_type", "correlation", f": {pair!r}: must be two names")
        for what in pair:
            if what not in names:
                known = ", ".join(map(repr, names)) or "none"
                raise argument_error("unknown_name", "correlation", f": {what!r} is not sampled; these are: {known}")
        value = as_number("correlation", given)
        if not -1.0 < value < 1.0:
            raise InputError(f"correlation of {pair[0]} and {pair[1]} = {value:g}: must lie between -1 and 1")
        if pair[::-1] in correlation:
            raise InputError(f"correlation of {pair[0]} and {pair[1]}: is given twice")
        i, k = names.index(pair[0]), names.index(pair[1])
        matrix[i, k] = matrix[k, i] = value
    if names and _is_singular(matrix):
        raise argument_error(
            "out_of_range",
            "correlation",
            ": no quantities can be correlated like this: the smallest eigenvalue of the matrix is "
            f"{np.linalg.eigvalsh(matrix).min():.3g}, must be positive",
        )
    return matrix


def _is_singular(matrix: FloatArray) -> bool:
    """Does one of some quantities follow from the others, by the matrix of their correlations?"""
    return bool(np.linalg.eigvalsh(matrix).min() < 1e-9)


def _reorder(probabilities: FloatArray, matrix: FloatArray) -> FloatArray:
    """Change the order in each column so that the normal scores of the ranks have the given correlations.

    Scores without correlation, L^-1 z with the Cholesky factor L of their own correlation, get the one wanted; their
    ranks are taken over (Iman and Conover 1982). The scores of these ranks are not quite those: again from there.
    By hand, since SciPy's copulas and samplers give no correlation to a Latin hypercube.
    """
    from scipy import linalg

    factor, ordered = np.linalg.cholesky(matrix), np.sort(probabilities, axis=0)
    for _ in range(_PASSES):
        scores = _scores(probabilities)
        own = _correlation(scores)
        if _is_singular(own):
            # So few walls that two columns have got one order
            break
        wanted = factor @ linalg.solve_triangular(np.linalg.cholesky(own), scores.T, lower=True)
        probabilities = np.take_along_axis(ordered, _ranks(wanted.T), axis=0)
    return probabilities


def _correlation(scores: FloatArray) -> FloatArray:
    """Correlation of the columns, shape (columns, columns)."""
    return np.atleast_2d(np.corrcoef(scores, rowvar=False))


def _scores(values: FloatArray) -> FloatArray:
    """Normal scores of each column: what the normal distribution has at the ranks."""
    from scipy import stats

    scores: FloatArray = stats.norm.ppf((_ranks(values) + 1.0) / (len(values) + 1.0))
    return scores


def _ranks(values: FloatArray) -> Any:
    """Ranks in each column, from 0."""
    return np.argsort(np.argsort(values, axis=0), axis=0)


class _Known(dict[str, FloatArray]):
    """What the function of a property gets: the samples by name."""

    def __init__(self, reader: str, samples: Samples) -> None:
        super().__init__(samples)
        self._reader = reader

    def __missing__(self, what: object) -> FloatArray:
        known = ", ".join(map(repr, self)) or "none"
        raise InputError(f"{self._reader}: its function asks for {what!r}; known before it are: {known}")


def _evaluate(
    properties: Mapping[str, Property], prefix: str, sampled: Samples, known: Samples, n: int
) -> dict[str, Any]:
    """Values of all walls; functions come last, in their order, and see what is known before."""
    values: dict[str, Any] = {}
    for what, value in properties.items():
        if isinstance(value, Distribution):
            values[what] = sampled[prefix + what]
        elif isinstance(value, str):
            values[what] = value
        elif what in WALL_LISTS and isinstance(value, Iterable):
            values[what] = tuple(value)
        elif not callable(value):
            values[what] = np.broadcast_to(as_number(what, value), n)
    for what, value in properties.items():
        if callable(value):
            answer = np.asarray(value(_Known(what, {**known, **values})))
            if answer.dtype.kind not in "biuf" or answer.shape not in ((), (n,)):
                raise argument_error("wrong_type", what, f": its function must return {n} numbers or one")
            values[what] = np.broadcast_to(answer.astype(np.float64), n)
    return values


def make_walls(mechanism: str, names: Sequence[str], values: Mapping[str, Any], gravity: float | None) -> WallColumns:
    """Walls of one mechanism."""
    pull = constants().gravity if gravity is None else as_number("gravity", gravity)
    n = len(names)
    # The weight of a wall among others is none of its properties
    said = {
        what: value if isinstance(value, np.ndarray) else [value] * n
        for what, value in values.items()
        if what != "weight"
    }
    given = {**said, "name": names, "mechanism": [mechanism] * n}
    return WallColumns.of_data(describe_walls(n, given, np.full(n, pull)))


def in_words(value: Property) -> str:
    """A property; a frozen distribution of SciPy by its name and arguments, since its repr is an address."""
    dist = getattr(value, "dist", None)
    if dist is None:
        return repr(value)
    named = (f"{name}={one!r}" for name, one in getattr(value, "kwds", {}).items())
    return f"{dist.name}({', '.join([*map(repr, getattr(value, 'args', ())), *named])})"


def _origin(
    title: str,
    own: Mapping[str, Mapping[str, Property]],
    variables: Mapping[str, Property],
    correlation: Mapping[tuple[str, str], float],
    properties: Mapping[str, Property],
) -> tuple[str, ...]:
    """What was sampled, in lines."""
    given: dict[str, Property] = {**variables, **properties}
    given |= {f"{mechanism}.{what}": value for mechanism, extra in own.items() for what, value in extra.items()}
    said = [title]
    for what, value in given.items():
        if callable(value):
            name = getattr(value, "__name__", "<lambda>")
            said.append(f"{what} computed" if name == "<lambda>" else f"{what} computed by {name}")
        else:
            said.append(f"{what} = {in_words(value)}")
    said += [f"correlation of {pair[0]} and {pair[1]} = {value!r}" for pair, value in correlation.items()]
    return tuple(textwrap.wrap("; ".join(said), 110, break_long_words=False, break_on_hyphens=False))
