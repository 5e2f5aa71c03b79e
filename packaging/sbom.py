"""A software bill of materials: SPDX 2.3 as JSON (https://spdx.github.io/spdx-spec/v2.3/)."""

import datetime
import hashlib
import json
import re

RELATIONS = {"shared": "DYNAMIC_LINK", "static": "STATIC_LINK", "headers": "STATIC_LINK", "page": "CONTAINS"}


def identifier(text):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", text)


def checksums(path):
    data = path.read_bytes()
    return [{"algorithm": name.upper(), "checksumValue": hashlib.new(name, data).hexdigest()} for name in ("sha1", "sha256")]


def own_package(facts):
    return {"SPDXID": identifier("clusterbench"), "name": "clusterbench", "versionInfo": facts.version,
            "downloadLocation": "NOASSERTION", "filesAnalyzed": False, "licenseConcluded": "MIT", "licenseDeclared": "MIT",
            "copyrightText": "NOASSERTION", "sourceInfo": f"built from commit {facts.commit}", "primaryPackagePurpose": "APPLICATION"}


def package(piece):
    entry = {"SPDXID": identifier(f"{piece.how}-{piece.name}"), "name": piece.name, "versionInfo": piece.version,
             "downloadLocation": "NOASSERTION", "filesAnalyzed": False, "licenseConcluded": piece.licence,
             "licenseDeclared": piece.licence, "copyrightText": "NOASSERTION", "primaryPackagePurpose": "LIBRARY",
             "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": piece.purl}]}
    if piece.homepage:
        entry["homepage"] = piece.homepage
    return entry


def file_entry(root, path):
    return {"SPDXID": identifier(f"file-{path.relative_to(root)}"), "fileName": f"./{path.relative_to(root)}",
            "checksums": checksums(path), "licenseConcluded": "NOASSERTION", "copyrightText": "NOASSERTION"}


def relation(first, kind, second):
    return {"spdxElementId": first, "relationshipType": kind, "relatedSpdxElement": second}


def relations(root, pieces, program):
    own = identifier("clusterbench")
    yield relation("SPDXRef-DOCUMENT", "DESCRIBES", own)
    yield relation(own, "CONTAINS", identifier(f"file-{program.relative_to(root)}"))
    for piece in pieces:
        yield relation(own, RELATIONS[piece.how], identifier(f"{piece.how}-{piece.name}"))
        for name in piece.files:
            yield relation(identifier(f"{piece.how}-{piece.name}"), "CONTAINS", identifier(f"file-lib/{name}"))


def document(facts, root, pieces, program):
    """`root`: the folder that is packed. It holds `program`, and lib/ with the shared libraries of the pieces."""
    name = f"clusterbench-{facts.version}-{facts.platform}"
    files = [program] + [root / "lib" / file for piece in pieces for file in piece.files]
    created = datetime.datetime.fromtimestamp(facts.seconds, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": name,
            "documentNamespace": f"https://spdx.org/spdxdocs/{name}-{facts.commit}",
            "creationInfo": {"created": created, "creators": ["Tool: clusterbench packaging/sbom.py"]},
            "packages": [own_package(facts)] + [package(piece) for piece in pieces],
            "files": [file_entry(root, path) for path in files],
            "relationships": list(relations(root, pieces, program))}


def write(facts, root, pieces, program, path):
    path.write_text(json.dumps(document(facts, root, pieces, program), indent=1) + "\n", encoding="utf-8")
