#!/usr/bin/env python3
"""Puts the table of presets into docs/presets.md, from `list presets`: scripts/presets_page.py CLUSTERBENCH [--check].
With --check nothing is written; exits 1 if the page is not what it would write."""
import json
import pathlib
import re
import subprocess
import sys

PAGE = pathlib.Path(__file__).resolve().parent.parent / "docs" / "presets.md"
HEAD = ("| preset | of | version | known by | scheme | limit | what differs here |\n"
        "|---|---|---|---|---|---|---|\n")
HEAD_DEVICE = "| preset | with `--device` | what of its steps differs there |\n|---|---|---|\n"
HEAD_SHIPPED = "| preset | with `--as-shipped` | method |\n|---|---|---|\n"


def table(presets):
    rows = []
    for preset in presets:
        differs = "; ".join(part for part in (preset["approximated"],
                                              preset["unverified"] and f"from memory: {preset['unverified']}") if part)
        rows.append(f"| `{preset['name']}` | {preset['engine']} | {preset['version']} | **{preset['evidence']}**: "
                    f"{preset['source']} | {preset['summary']} | {preset.get('limit', '')} | {differs} |\n")
    return HEAD + "".join(rows)


def shipped_table(presets):
    return HEAD_SHIPPED + "".join(f"| `{preset['name']}` | {preset['mistakes']} | `{preset['as_shipped']['assigner']['name']}` |\n"
                                  for preset in presets if "mistakes" in preset)


def method_text(entry):
    params = ", ".join(f"{key} = {str(value).lower() if isinstance(value, bool) else value}"
                       for key, value in entry.items() if key != "name")
    return f"`{entry['name']}`" + (f" ({params})" if params else "")


def device_table(presets):
    rows = [f"| `{preset['name']}` | {method_text(preset['on_device']['assigner'])} | {preset['on_device']['approximated']} |\n"
            for preset in presets if "on_device" in preset]
    rows += [f"| `{preset['name']}` | none: {preset['not_on_device']} | |\n" for preset in presets if "not_on_device" in preset]
    return HEAD_DEVICE + "".join(rows)


def filled(text, name, content):
    whole = re.compile(rf"(<!-- {name} -->\n).*?(<!-- /{name} -->)", re.DOTALL)
    if len(whole.findall(text)) != 1:
        sys.exit(f"{PAGE}: has no place <!-- {name} --> ... <!-- /{name} -->, or several")
    return whole.sub(lambda found: found[1] + content + found[2], text)


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--check"]
    if len(arguments) != 1:
        sys.exit(__doc__)
    presets = json.loads(subprocess.run([arguments[0], "list", "presets", "--json"], check=True, stdout=subprocess.PIPE).stdout)
    text = PAGE.read_text()
    new = filled(filled(text, "presets", table(presets)), "as-shipped", shipped_table(presets))
    new = filled(new, "on-device", device_table(presets))
    if "--check" not in sys.argv:
        PAGE.write_text(new)
    elif new != text:
        sys.exit(f"{PAGE}: is not what `list presets` says; run scripts/presets_page.py CLUSTERBENCH")


if __name__ == "__main__":
    main()
