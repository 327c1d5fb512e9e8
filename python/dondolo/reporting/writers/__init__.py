"""Documents as files: `writing` chooses the writer, `web` writes pages, which `pdf` prints, `word` files of Word."""
