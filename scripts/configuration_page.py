#!/usr/bin/env python3
"""Puts the tables of keys into docs/configuration.md, from the schema: scripts/configuration_page.py CLUSTERBENCH [--check].
With --check nothing is written; exits 1 if the page is not what it would write, or if a key is missing."""
import json
import pathlib
import re
import subprocess
import sys
import textwrap

PAGE = pathlib.Path(__file__).resolve().parent.parent / "docs" / "configuration.md"
HEAD = "| key | value | unit | default | example | meaning |\n|---|---|---|---|---|---|\n"
HEAD_OF_METHODS = HEAD.replace("unit", "of")
LONG = 125  # a longer meaning continues below the table

# Table -> objects of the schema, each with what stands before its keys.
TABLES = {
    "file": [("", "")],
    "scene": [("", "/definitions/scene"), ("frames.", "/definitions/scene/properties/frames/anyOf/2"),
              ("range_rule.", "/definitions/scene/properties/range_rule")],
    "rig": [("", "/definitions/rig")],
    "tiled": [("", "/definitions/frustum"), ("tiles.", "/definitions/tiles"), ("slices.", "/definitions/slices"),
              ("slices.fit.", "/definitions/slices/properties/fit/anyOf/0"),
              ("react.", "/definitions/react")],
    "cascades": [("", "/definitions/cascades")],
    "world": [("", "/definitions/world"), ("bounds.", "/definitions/world/properties/bounds/anyOf/1")],
    "precision": [("", "/definitions/precision")],
    "pre_cull": [("", "/definitions/pre_cull_step"), ("visible_set.", "/definitions/pre_cull_step/properties/visible_set"),
                 ("most.", "/definitions/pre_cull_step/properties/most")],
    "measuring": [(key + ".", f"/properties/{key}") for key in ("accuracy", "shading")]
                 + [("samples.", "/properties/samples")]
                 + [(f"samples.{name}.", f"/properties/samples/properties/{name}")
                    for name in ("opaque", "transparent", "fog", "mirror", "anywhere")]
                 + [(key + ".", f"/properties/{key}/anyOf/1") for key in ("reading", "lookup", "stability", "details")]
                 + [(key + ".", f"/properties/{key}") for key in ("shadow_cull", "shadow_frusta")]
                 + [("jitter.", "/properties/jitter/anyOf/2")]
                 + [(key + ".", f"/properties/{key}") for key in ("timing", "limits", "allocation", "cost")]
                 + [("cost.weights.", "/properties/cost/properties/weights")],
}
SAME_AS_FRUSTUM = "/definitions/distance"


def at(schema, pointer):
    for step in pointer.split("/")[1:]:
        schema = schema[int(step)] if isinstance(schema, list) else schema[step]
    return schema


def figure(number):
    if number == 2**53 - 1:
        return "2^53 - 1"
    return str(int(number)) if number == int(number) and number <= 1e7 else f"{number:g}".replace("e+0", "e")


def number_range(schema):
    low, above, high = (schema.get(key) for key in ("minimum", "exclusiveMinimum", "maximum"))
    text = f" from {figure(low)}" if low is not None else f" above {figure(above)}" if above is not None else ""
    return text + (f" to {figure(high)}" if high is not None else "")


def words_of(schema):
    """The words of today; x-former has those of earlier versions."""
    return [word for word in schema["enum"] if word not in schema.get("x-former", {})]


def value_text(root, schema):
    """What can stand there."""
    if "$ref" in schema:
        return value_text(root, at(root, schema["$ref"][1:]))
    if schema.get("x-axis"):
        return value_text(root, schema["anyOf"][0]) + "; axis"
    if "const" in schema:
        return f"`{json.dumps(schema['const'])}`"
    if "enum" in schema:
        return ", ".join(f"`{json.dumps(word)}`" for word in words_of(schema))
    if "type" not in schema:
        return " or ".join(dict.fromkeys(value_text(root, one) for one in schema.get("anyOf") or schema["oneOf"]))
    if isinstance(schema["type"], list):
        return " or ".join(value_text(root, dict(schema, type=one)) for one in schema["type"])
    kind = schema["type"]
    if kind == "array":
        items = value_text(root, schema.get("items", {"type": "object"}))
        fixed = schema.get("maxItems") if schema.get("maxItems") == schema.get("minItems") else None
        return f"{fixed} × {items}" if fixed else f"list of {items}"
    if kind in ("integer", "number"):
        return kind + number_range(schema)
    return {"boolean": "`true` or `false`", "string": "text", "object": "object", "null": "`null`"}[kind]


def described(root, schema):
    """A key's schema with what it lacks from where it points to."""
    return dict(at(root, schema["$ref"][1:]), **schema) if "$ref" in schema else schema


def code(value):
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    return f"`{json.dumps(value, ensure_ascii=False)}`"


def row(name, value, unit, default, example, meaning, of=""):
    """A row of a table, and what has no room in it."""
    first, rest = re.fullmatch(r"(.*?\.)(?: (.*))?", meaning).groups() if len(meaning) > LONG else (meaning, "")
    cells = [f"`{name}`", value, unit or of, default, example, first]
    owner = f" of {of}" if of and not of.startswith("all but") else ""
    note = f"- `{name}`{owner}: {rest}\n" if rest else ""
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |\n", note


def with_notes(rows):
    notes = "".join(dict.fromkeys(textwrap.fill(note, 130, subsequent_indent="  ", break_on_hyphens=False, break_long_words=False) + "\n"
                                  for _, note in rows if note))
    return "".join(line for line, _ in rows) + ("\n" + notes if notes else "")


def default_text(name, schema, required):
    if name == "assigners":
        return "all but `naive-` and those that need depth"
    if name == "grids":
        return "seven, four `frustum`"
    return code(schema["default"]) if "default" in schema else "needed" if required else ""


def key_rows(root, prefix, owner):
    rows = []
    for key, schema in owner["properties"].items():
        full = described(root, schema)
        example = f"`{json.dumps(key)}: {json.dumps(schema['examples'][0])}`"
        value = {"assigners": "list of names, patterns, objects", "storages": "list of names, objects"}.get(key)
        value = value or value_text(root, schema)
        users = ", ".join(f"`{user}`" for user in schema.get("x-used-by", []))
        if users:
            full = dict(full, description=f"{full['description']} Used by {users}.")
        rows.append(row(prefix + key, value, full.get("x-unit", ""), default_text(key, full, key in owner.get("required", [])), example,
                        full.get("description", "")))
    return rows


def other_value(schema):
    """Any value but the default, as an example."""
    one = schema["anyOf"][0]
    if "enum" in one:
        return next(word for word in reversed(words_of(one)) if word != schema["default"])
    if one["type"] == "boolean":
        return not schema["default"]
    twice = min(2 * schema["default"], one["maximum"])
    return int(twice) if twice == int(twice) else twice


def those(methods, all_of_part):
    """The methods that have a parameter, in as few names as possible."""
    others = [name for name in all_of_part if name not in methods]
    return "all but " + ", ".join(others) if len(others) < len(methods) and len(methods) > 3 else ", ".join(methods)


def method_rows(root):
    """A parameter that several methods have alike stands once."""
    rows, all_of = {}, {}
    for part in ("assigners", "storages"):
        every = root["properties"][part]["items"]["anyOf"][-1]["oneOf"]
        all_of[part] = [method["properties"]["name"]["const"] for method in every]
        for method in every:
            for key, schema in method["properties"].items():
                if key == "name":
                    continue
                methods = rows.setdefault((key, json.dumps(schema, sort_keys=True)), (schema, [], part))[1]
                methods.append(method["properties"]["name"]["const"])
    text = []
    for (key, _), (schema, methods, part) in rows.items():
        meaning = schema["description"][0].upper() + schema["description"][1:] + "."
        example = f"`{json.dumps({'name': methods[0], key: other_value(schema)})}`"
        text.append(row(key, value_text(root, schema), "", code(schema["default"]), example, meaning,
                        those(methods, all_of[part])))
    return text


def objects(schema, pointer=""):
    """Where the schema has keys."""
    if isinstance(schema, dict):
        if isinstance(schema.get("properties"), dict) and "type" in schema:
            yield pointer
        if schema.get("x-axis") and "anyOf" in schema:  # a value, or a list of such
            yield from objects(schema["anyOf"][0], f"{pointer}/anyOf/0")
            return
        for key, member in schema.items():
            yield from objects(member, f"{pointer}/{key}") if key not in ("examples", "default") else ()
    elif isinstance(schema, list):
        for i, member in enumerate(schema):
            yield from objects(member, f"{pointer}/{i}")


def page_text(root, page):
    known = {pointer for table in TABLES.values() for _, pointer in table} | {SAME_AS_FRUSTUM}
    missing = [pointer for pointer in objects(root)
               if pointer not in known and not re.match("/properties/(assigners|storages)/", pointer)]
    if missing:
        sys.exit(f"{PAGE.name} has no table for {', '.join(missing)}: add it to TABLES")
    tables = {name: HEAD + with_notes([line for prefix, pointer in parts for line in key_rows(root, prefix, at(root, pointer))])
              for name, parts in TABLES.items()}
    tables["methods"] = HEAD_OF_METHODS + with_notes(method_rows(root))
    for name, table in tables.items():
        mark = f"<!-- keys: {name} -->\n"
        head, rest = page.split(mark)
        page = head + mark + "\n" + table + "\n<!-- end of keys -->" + rest.split("<!-- end of keys -->", 1)[1]
    return page


def main():
    if len(sys.argv) < 2 or sys.argv[1] in ("-h", "--help"):
        return print(__doc__)
    schema = json.loads(subprocess.run([sys.argv[1], "schema", "config"], check=True, capture_output=True).stdout)
    old = PAGE.read_text()
    new = page_text(schema, old)
    if "--check" not in sys.argv:
        PAGE.write_text(new)
    elif new != old:
        sys.exit(f"docs/{PAGE.name} is not what the schema says: run scripts/configuration_page.py {sys.argv[1]}")


main()
