"""The chapters of a calculation report, in their order: functions that give blocks of a document."""

from dondolo.reporting.relazione import annexes, checks, comparisons, materials, opening, outcome, ties

CHAPTERS = (
    opening.title_page,
    opening.description,
    opening.norms,
    opening.site,
    materials.materials,
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
    comparisons.comparisons,
    annexes.annexes,
)
