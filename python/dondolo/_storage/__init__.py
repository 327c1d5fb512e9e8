"""Tables as files and as data frames."""
