"""Reports: facts are gathered in Python, and set by the Jinja templates in the folder ``templates``.

`page` chooses the chapters of a run. `run` gathers what is known of it; `typology`, `wall`, `risk` and `inputs` make
the facts of its chapters, of the pieces in `content` (symbols, tables, figures) and `numerals`. `columns` has the head
and the digits of each column by its name. No module writes HTML, and no template computes.
"""
