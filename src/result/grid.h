#pragma once
// The partition of space into cells.

#include "result/shared_parts.h"

namespace clusterbench::result {

struct Tiles {
  RECORD(Tiles);
  FIELD(std::optional<Counts2>, count, About("[columns, rows] of the screen", "tiles", "the screen").at_least(1));
  FIELD(std::optional<Counts2>, pixels, About("[width, height] of a tile", "pixels", "one tile").at_least(1));
  END_RECORD;
};

struct SliceLookup {
  RECORD(SliceLookup);
  FIELD(std::optional<double>, bias, About("Added after scale", "slices", "the grid").finite().as_fraction());
  FIELD(std::optional<double>, first,
        About("Depth below which a sample is in slice 0; absent where the formula holds for slice 0, too", "m",
              "the grid")
            .finite()
            .as_fraction());
  FIELD(std::string, form,
        About("slice = int(depth * scale + bias), int(log2(depth) * scale + bias), or a search in boundaries")
            .one_of({"linear", "log2", "search"}));
  FIELD(std::optional<double>, scale,
        About("Factor of the lookup", "slices per m, or per doubling", "the grid").finite().as_fraction());
  END_RECORD;
};

struct Slices {
  RECORD(Slices);
  FIELD(std::vector<double>, boundaries,
        About("Near to far, one more than slices: of depth, of distance grids of the distance from the eye", "m",
              "the grid")
            .finite()
            .as_fraction());
  FIELD(SliceLookup, lookup, "A shader's way from depth to slice");
  FIELD(std::string, scheme, "As the configuration has it");
  END_RECORD;
};

struct MinMax {
  RECORD(MinMax);
  FIELD(double, max, About("Deepest").finite().as_fraction());
  FIELD(double, min, About("Flattest").finite().as_fraction());
  END_RECORD;
};

struct Box {
  RECORD(Box);
  FIELD(Vector, max, "Highest corner");
  FIELD(Vector, min, "Lowest corner");
  END_RECORD;
};

struct Grid {
  RECORD(Grid);
  FIELD(std::optional<MinMax>, aspect,
        "Where the configuration asks for cells of a shape: how many times as deep as high cells are at their near "
        "side; without the first slice, which holds what lies before it, too",
        "ratio", "the slices");
  FIELD(std::optional<Box>, bounds, "Of world grids: the box, relative to the origin", "m", "the grid");
  FIELD(std::optional<Vector>, cell_size, "Of world grids: edges of a cell", "m", "the grid");
  FIELD(Counts3, cells, "Number of cells, [x, y, z]; z of cascades counts the cells of all levels", "cells",
        "the grid");
  FIELD(std::optional<double>, finest,
        About("Of cascades: edge of a cell of the first level; each further level doubles it", "m", "the grid")
            .finite()
            .as_fraction());
  FIELD(
      std::optional<std::string>, follow,
      About(
          "Of world grids that follow something from frame to frame: origin, bounds and cell_size are the last frame's")
          .one_of({"camera", "lights"}));
  FIELD(std::string, kind,
        About("How space is cut: docs/grids-and-lookups.md").one_of({"frustum", "distance", "cascades", "world"}));
  FIELD(std::optional<std::uint64_t>, levels,
        About("Of cascades: number of nested boxes", "levels", "the grid").at_least(1));
  FIELD(std::string, name, "Kind, tiles and slices in words, as in names of cases");
  FIELD(std::optional<std::string>, note,
        "What to know about the slices or the box, as text: where slices end if nothing names a far plane, or that "
        "those of the last frame are shown",
        "", "", Compares::unjudged);
  FIELD(std::optional<Vector>, origin, "Of world grids: position in the world that bounds are relative to", "m",
        "the grid");
  FIELD(std::optional<Slices>, slices, "Of frustum and distance grids");
  FIELD(std::optional<Tiles>, tiles, "Of frustum and distance grids: count or pixels, as the configuration has it");
  END_RECORD;
};

}  // namespace clusterbench::result
