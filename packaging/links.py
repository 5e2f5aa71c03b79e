"""Links of the packed documents: to what the package has, and no others. What is in the sources alone is named, not linked."""

import os
import re

LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\[\]]*\])*)\]\(([^()\s#]*)(#[^()\s]*)?\)")
ELSEWHERE = re.compile(r"^[a-z][a-z0-9+.-]*:")
NOTE = """*From a package of commit {commit}, which has the program: `clusterbench run` does what `scripts/run` does
in the sources. `scripts/`, `tests/`, `results/` and what else is not linked here are there alone.*

"""


def place(documents, data, target, moved):
    """Where the package has what the sources have as `target`, a path from their root; None where it does not."""
    target = moved.get(target, target)
    places = (documents / target, data / target)
    return next((path for path in places if path.exists()), None)


def settle_links(text, of, documents, data, moved):
    """`of`: the document, a path from the root of the sources."""
    def settled(link):
        picture, words, target, anchor = link.group(1), link.group(2), link.group(3), link.group(4) or ""
        if not target or ELSEWHERE.match(target):
            return link.group(0)
        source = os.path.normpath(os.path.join(os.path.dirname(of), target))
        found = place(documents, data, source, moved)
        if found:
            return f"{picture}[{words}]({os.path.relpath(found, (documents / of).parent)}{anchor})"
        if picture:
            return f"(In the sources a picture, `{source}`: {words})"
        return words if words.strip("`") in (source, target) else f"{words} (`{source}` in the sources)"

    parts = re.split(r"(^```.*?^```$)", text, flags=re.DOTALL | re.MULTILINE)
    return "".join(part if number % 2 else LINK.sub(settled, part) for number, part in enumerate(parts))


def settle(documents, data, commit, moved=None):
    """`documents`: the folder with README.md and docs/; `data`: the one with configs/ and scenes/; `moved`: documents under other names."""
    for path in [documents / "README.md", documents / "CHANGELOG.md", *sorted((documents / "docs").rglob("*.md"))]:
        if path.exists():
            text = settle_links(path.read_text(encoding="utf-8"), path.relative_to(documents).as_posix(), documents, data, moved or {})
            if path.name == "README.md" and path.parent == documents:
                title, _, rest = text.partition("\n\n")
                text = f"{title}\n\n{NOTE.format(commit=commit)}{rest}"
            path.write_text(text, encoding="utf-8")
