#!/usr/bin/env python3
"""Makes the tables that pictures are drawn with: scripts/picture_tables.py FONTS.

FONTS: the folder with 7x13.pcf.gz and 9x15B.pcf.gz, /usr/share/fonts/X11/misc where Debian's xfonts-base is installed.
Writes src/pictures/glyphs.inc (from there) and src/pictures/viridis.inc (from page/node_modules/d3-scale-chromatic).
"""
import gzip
import pathlib
import re
import struct
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FIRST, LAST = 32, 126  # ASCII
METRICS, BITMAPS, ENCODINGS = 1 << 2, 1 << 3, 1 << 5
COMPRESSED_METRICS, BIG_ENDIAN, BITS_FROM_LEFT = 0x100, 1 << 2, 1 << 3


def tables_of(data):
    count = struct.unpack_from("<I", data, 4)[0]
    rows = [struct.unpack_from("<IIII", data, 8 + 16 * i) for i in range(count)]
    return {kind: (form, offset) for kind, form, _, offset in rows}


def glyph_indices(data, form, offset):
    order = ">" if form & BIG_ENDIAN else "<"
    first, last, row, _, _ = struct.unpack_from(order + "5H", data, offset + 4)
    indices = struct.unpack_from(f"{order}{last - first + 1}H", data, offset + 14)
    assert first <= FIRST and row == 0
    return {code: indices[code - first] for code in range(FIRST, LAST + 1)}


def metrics(data, form, offset, index):
    order = ">" if form & BIG_ENDIAN else "<"
    if form & COMPRESSED_METRICS:
        left, right, width, ascent, descent = (b - 0x80 for b in data[offset + 6 + 5 * index:offset + 11 + 5 * index])
    else:
        left, right, width, ascent, descent, _ = struct.unpack_from(order + "6h", data, offset + 8 + 12 * index)
    return left, right, ascent, descent


def rows_of(data, tables, index, width, height, ascent):
    """The glyph as one whole number a row, the leftmost pixel highest."""
    left, right, up, down = metrics(data, *tables[METRICS], index)
    form, offset = tables[BITMAPS]
    order = ">" if form & BIG_ENDIAN else "<"
    assert form & BITS_FROM_LEFT
    count = struct.unpack_from(order + "I", data, offset + 4)[0]
    start = offset + 8 + 4 * count + 16 + struct.unpack_from(order + "I", data, offset + 8 + 4 * index)[0]
    pad = 1 << (form & 3)
    stride = ((right - left + 7) // 8 + pad - 1) // pad * pad
    rows = [0] * height
    for y in range(up + down):
        bits = int.from_bytes(data[start + y * stride:start + (y + 1) * stride], "big")
        shift = 8 * stride - width + left
        rows[ascent - up + y] = bits >> shift if shift >= 0 else bits << -shift
    return rows


def glyph_table(folder, name, width, height, ascent):
    data = gzip.decompress((folder / f"{name}.pcf.gz").read_bytes())
    tables = tables_of(data)
    indices = glyph_indices(data, *tables[ENCODINGS])
    lines = [f"// {name}"]
    for code in range(FIRST, LAST + 1):
        rows = rows_of(data, tables, indices[code], width, height, ascent)
        lines.append(", ".join(f"0x{row:03x}" for row in rows) + ",")
    return lines


def main():
    if len(sys.argv) != 2:
        print("usage: scripts/picture_tables.py FONTS", file=sys.stderr)
        return 2
    fonts = pathlib.Path(sys.argv[1])
    for name, sizes in (("7x13", (7, 13, 11)), ("9x15B", (9, 15, 12))):
        head = ["// clang-format off", f"// By scripts/picture_tables.py from {name}.pcf.gz of Debian's xfonts-base, one of X11's misc-fixed fonts",
                "// (public domain): ASCII 32 to 126, a row of pixels per number, the leftmost pixel highest."]
        (ROOT / f"src/pictures/glyphs_{name.lower()}.inc").write_text("\n".join(head + glyph_table(fonts, name, *sizes)[1:]) + "\n")
    source = (ROOT / "page/node_modules/d3-scale-chromatic/dist/d3-scale-chromatic.mjs").read_text()
    digits = re.search(r'viridis = ramp\(colors\("([0-9a-f]+)"', source).group(1)
    colours = [digits[i:i + 6] for i in range(0, len(digits), 6)]
    assert len(colours) == 256
    lines = ["// clang-format off", "// By scripts/picture_tables.py: viridis, as d3-scale-chromatic has it. By Stefan van der Walt and Nathaniel Smith for",
             "// matplotlib (CC0): lightness rises evenly, and any colour vision can tell it apart."]
    for i in range(0, 256, 8):
        lines.append(" ".join("{0x%s, 0x%s, 0x%s}," % (c[:2], c[2:4], c[4:]) for c in colours[i:i + 8]))
    (ROOT / "src/pictures/viridis.inc").write_text("\n".join(lines) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
