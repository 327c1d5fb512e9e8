"""The chapters of a calculation report, in their order: functions that give blocks of a document."""

from dondolo.reporting.relazione import checks, opening, outcome, ties

CHAPTERS = (
    opening.title_page,
    opening.description,
    opening.norms,
    opening.site,
    opening.materials,
    opening.modelling,
    opening.actions,
    opening.analysis,
    opening.code,
    checks.mechanism,
    checks.checks,
    ties.ties,
    outcome.histories,
    outcome.fragility,
    outcome.summary,
    outcome.run,
    outcome.comparisons,
    outcome.annexes,
)
