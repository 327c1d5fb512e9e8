"""Documents: facts of results become blocks, which writers set as HTML, PDF or Word.

`page` chooses the chapters of a report, `relazione` has those of a calculation report. Chapters are functions that give
`blocks`, made of `content` (symbols, tables, sentences in pieces) and `numerals`; `columns` has the head and the digits
of each column by its name, and `run` what is known of a run. Only `writers` knows HTML or Word, and computes nothing.
"""
