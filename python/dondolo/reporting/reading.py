"""Chapters of a report on what its reader has to know: limits of the models, symbols and terms, and references."""

from __future__ import annotations

from dondolo._base.wording import decimal, say
from dondolo.exchange.citing import cite
from dondolo.figures import style
from dondolo.figures.style import mechanism_name
from dondolo.populations.typology import Typology
from dondolo.reporting.blocks import Block, Bullets, Facts, Listing
from dondolo.reporting.content import BETA, THETA, Pairs, Symbol, pieces
from dondolo.reporting.parts import paragraph
from dondolo.reporting.records import has_vertical
from dondolo.reporting.run import Run
from dondolo.reporting.tested import sentences


def limits(run: Run) -> list[Block]:
    """What the models leave out."""
    told = [
        _of_the_base(run),
        _of_rigid_walls(run),
        say("Each mechanism moves on its own, and walls do not interact."),
        say("Impacts are instantaneous and lose the same share of the speed at any speed."),
        say("Records that are scaled by large factors may not resemble earthquakes of that strength."),
        *_of_the_curves(run),
    ]
    mechanisms = (wall.mechanism for wall in run.population.walls)
    tested = (say(words, **values) for words, values in sentences(mechanisms, mechanism_name, decimal))
    return [Bullets((*told, *tested))]


def _of_the_base(run: Run) -> str:
    """What moves the walls: the ground, floors of buildings, or either."""
    grounded = {wall.building is None for wall in run.population.walls}
    if grounded == {False}:
        return say(
            "Each wall is moved by its floor and by what it leans on, which the records move through a linear building;"
            " the wall does not act back on it."
        )
    storeys = (
        say("A wall of an upper storey needs the motion of its floor.")
        if grounded == {True}
        else say("A wall of an upper storey needs the motion of its floor, which those with a building have.")
    )
    facades = say(
        "A facade without a building leans on transverse walls that are assumed not to move: its curve is"
        " unconservative if there is a building behind it."
    )
    return f"{say('The motion is that of the base of the wall.')} {storeys} {facades}"


def _of_rigid_walls(run: Run) -> str:
    """What rigid walls do not do, and whether the ground moves vertically, as far as it is known."""
    vertical = has_vertical(run)
    if vertical is False:
        return say(
            "Walls are rigid: no sliding, no crushing of the hinges, no vertical ground motion, no flexible floors."
        )
    words = say("Walls are rigid: no sliding, no crushing of the hinges, no flexible floors.")
    if vertical is None:
        words += " " + say("The ground moves vertically only if the records have vertical components.")
    return words


def _of_the_curves(run: Run) -> list[str]:
    """Which variability the curves include."""
    results = run.results
    if run.uncertain is not None:
        return [
            say("The curves include the variability of the records and of the uncertain properties, not the error of"
                " the model itself.")
        ]  # fmt: skip
    if not isinstance(results, Typology) or run.is_alike:
        return [say("The uncertainty of the properties of the wall is not included.")]
    told = [
        say("The curves include the variability of the records and of the walls in the table, not the errors of the"
            " models and their parameters.")
    ]  # fmt: skip
    if len(results.combined) < len(results.walls):
        told.append(
            say("Mechanisms of a wall that can occur together are assumed independent of each other, given the"
                " intensity; in fact the same record shakes them.")
        )  # fmt: skip
    return told


def symbols(run: Run) -> list[Block]:
    """Symbols and terms."""
    measure = style.im_label(getattr(run.results, "im", "pga"))
    pairs: Pairs = [
        ("IM, x", say("intensity measure of the ground motion: {measure}", measure=measure)),
        ("C", say("collapse: the rotation reaches the limit, unless another damage state is stated")),
        ("EDP", say("engineering demand parameter: largest rotation / capacity, without a unit")),
        (THETA, say("median of a fragility curve, in the unit of IM")),
        (BETA, say("dispersion of a fragility curve: standard deviation of ln IM at collapse")),
    ]
    if not run.is_alike:
        between = pieces("dispersion between walls: weighted standard deviation of ln {theta}", theta=THETA)
        of_records = pieces("dispersion between records: weighted root mean square of {beta} of the walls", beta=BETA)
        pairs += [(Symbol("β", "walls"), between), (Symbol("β", "records"), of_records)]
    pairs += [
        (Symbol("a", "0"), say("trigger: ground acceleration at which the wall begins to rock")),
        (say("capacity"), say("rotation at which the wall overturns without further shaking [rad]")),
        (Symbol("p"), say("frequency parameter of the rocking wall [rad/s]: the smaller, the slower")),
        ((say("restitution"), " ", Symbol("e")), say("speed of rotation after an impact over that before it")),
        (Symbol("p", "occ"), say("probability that a mechanism can occur in a wall")),
    ]
    if not run.is_alike:
        pairs.append((say("weight"), say("number of walls, or share of the centre, that a wall represents")))
    dash = say("A dash marks a value that does not exist, for example because no curve was fitted.")
    return [Facts(tuple(pairs)), paragraph(dash)]


def references(run: Run) -> list[Block]:
    """What to cite."""
    known = run.file is not None and run.file.references
    cited = [run.file] if known else [run.results, run.curve, run.check, run.uncertain, *run.records]
    words = say("BibTeX of dondolo and of the sources of the methods that this run used.")
    return [paragraph(words), Listing(cite(*(one for one in cited if one is not None)))]
