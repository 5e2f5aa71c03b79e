"""A software bill of materials: SPDX 2.3 as JSON (https://spdx.github.io/spdx-spec/v2.3/)."""

import datetime
import hashlib
import json
import re

RELATIONS = {"shared": "DYNAMIC_LINK", "system": "DYNAMIC_LINK", "static": "STATIC_LINK", "headers": "STATIC_LINK", "page": "CONTAINS"}


def identifier(text):
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", text)


def piece_identifier(piece):
    return identifier(f"{piece.how}-{piece.name}")


def checksums(path):
    data = path.read_bytes()
    return [{"algorithm": name.upper(), "checksumValue": hashlib.new(name, data).hexdigest()} for name in ("sha1", "sha256")]


def verification_code(files, left_out):
    """SPDX 2.3, 7.9: over the sums of all files of the package but the SBOM itself."""
    sums = sorted(entry["checksums"][0]["checksumValue"] for entry in files)
    return {"packageVerificationCodeValue": hashlib.sha1("".join(sums).encode()).hexdigest(),
            "packageVerificationCodeExcludedFiles": [left_out]}


def own_package(facts, name, files, left_out):
    return {"SPDXID": identifier(name), "name": name, "versionInfo": facts.version,
            "downloadLocation": "NOASSERTION", "filesAnalyzed": True, "packageVerificationCode": verification_code(files, left_out),
            "licenseConcluded": "MIT", "licenseDeclared": "MIT", "licenseInfoFromFiles": ["NOASSERTION"], "copyrightText": "NOASSERTION",
            "sourceInfo": f"built from commit {facts.commit}", "primaryPackagePurpose": "APPLICATION"}


def package(piece):
    entry = {"SPDXID": piece_identifier(piece), "name": piece.name, "versionInfo": piece.version,
             "downloadLocation": "NOASSERTION", "filesAnalyzed": False, "licenseConcluded": piece.licence,
             "licenseDeclared": piece.licence, "copyrightText": "NOASSERTION", "primaryPackagePurpose": "LIBRARY",
             "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": piece.purl}]}
    if piece.homepage:
        entry["homepage"] = piece.homepage
    if piece.source:
        entry["sourceInfo"] = f"source: {piece.source}"
    return entry


def file_entry(name, number, path):
    return {"SPDXID": identifier(f"file-{number}-{name}"), "fileName": f"./{name}", "checksums": checksums(path),
            "licenseConcluded": "NOASSERTION", "licenseInfoInFiles": ["NOASSERTION"], "copyrightText": "NOASSERTION"}


def relation(first, kind, second):
    return {"spdxElementId": first, "relationshipType": kind, "relatedSpdxElement": second}


def relations(own, pieces, files):
    yield relation("SPDXRef-DOCUMENT", "DESCRIBES", own)
    for entry in files:
        yield relation(own, "CONTAINS", entry["SPDXID"])
    names = {entry["fileName"]: entry["SPDXID"] for entry in files}
    for piece in pieces:
        yield relation(own, RELATIONS[piece.how], piece_identifier(piece))
        for name in piece.files:
            yield relation(names[f"./lib/{name}"], "GENERATED_FROM", piece_identifier(piece))


def document(facts, root, pieces, path, name="clusterbench", kind=""):
    """`root`: the folder that is packed, with all its files but the SBOM, `path`. `kind` tells apart packages of one commit."""
    title = f"{name}-{facts.version}-{facts.platform}{kind}"
    paths = sorted(file for file in root.rglob("*") if file.is_file() and file != path)
    files = [file_entry(file.relative_to(root), number, file) for number, file in enumerate(paths)]
    created = datetime.datetime.fromtimestamp(facts.seconds, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    made = {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": title,
            "creationInfo": {"created": created, "creators": ["Tool: clusterbench packaging/sbom.py"]},
            "packages": [own_package(facts, name, files, f"./{path.relative_to(root)}")] + [package(piece) for piece in pieces],
            "files": files, "relationships": list(relations(identifier(name), pieces, files))}
    # Of one commit and other libraries it is another document.
    contents = hashlib.sha256(json.dumps(made).encode()).hexdigest()[:16]
    return {**made, "documentNamespace": f"https://spdx.org/spdxdocs/{title}-{facts.commit}-{contents}"}


def write(facts, root, pieces, folder, name="clusterbench", kind=""):
    """To be called when all other files are there and complete."""
    path = folder / f"{name}-{facts.version}-{facts.platform}.spdx.json"
    path.write_text(json.dumps(document(facts, root, pieces, path, name, kind), indent=1) + "\n", encoding="utf-8")
