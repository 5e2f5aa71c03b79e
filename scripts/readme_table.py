#!/usr/bin/env python3
"""Puts a measured table between the README's two table marks: scripts/readme_table.py FILE."""
import pathlib
import re
import sys

readme = pathlib.Path(__file__).resolve().parent.parent / "README.md"
lines = pathlib.Path(sys.argv[1]).read_text().splitlines()
table = "\n".join(line.rstrip() for line in lines if not re.match(r"^(\[\d+/\d+\]|Building|Installing)", line)).strip("\n")
begin, end = "<!-- table begin: scripts/regenerate -->", "<!-- table end -->"
text = readme.read_text()
head, rest = text.split(begin)
readme.write_text(head + begin + "\n\n```text\n" + table + "\n```\n\n" + end + rest.split(end)[1])
