#pragma once
// The data of a page of `clusterbench check`, which page/ reads: verdicts, and the cells that lose lights with their
// lists, in space.

#include "result/documents/check.h"

namespace clusterbench::result {

struct CheckPageGrid {
  static About about() { return About("Where cells are: blocks between planes of three parameters"); }
  RECORD(CheckPageGrid);
  FIELD(std::string, shape,
        About("slopes: x / depth, y / depth, depth; shells: the same with the distance; box: x, y, z of view space or "
              "of the world")
            .one_of({"slopes", "shells", "box"}));
  FIELD(std::vector<double>, x, About("Planes of columns, ascending").finite());
  FIELD(std::vector<double>, y, About("Planes of rows, descending where row 0 is at the top").finite());
  FIELD(std::vector<double>, z,
        About("Ends of slices, ascending; of a box in view space minus depth, descending").finite());
  FIELD(Matrix, rotation, "Of a box: view space = rotation (point - origin)");
  FIELD(Vector, origin, "See rotation");
  END_RECORD;
};

struct CheckPageLight {
  RECORD(CheckPageLight);
  FIELD(std::uint64_t, index, "In the dump");
  FIELD(Vector, position, "In view space, which looks along -z");
  FIELD(double, range_m, About("null: no end", "m").at_least(0));
  FIELD(std::optional<Vector>, direction, "Of a spot");
  FIELD(std::optional<double>, half_angle_rad, About("Of a spot", "radians").finite());
  END_RECORD;
};

struct CheckPageCell {
  static About about() { return About("A cell that loses lights"); }
  RECORD(CheckPageCell);
  FIELD(std::uint64_t, index, "x fastest, from the top, from the near end");
  FIELD(double, reach_percent,
        About("Of its deepest lost light, of its range", "percent").finite().at_least(0).as_fraction());
  FIELD(std::vector<std::uint64_t>, listed, "Lights in the engine's list");
  FIELD(std::vector<std::uint64_t>, lost, "Lights that reach the cell and are not listed");
  FIELD(std::vector<std::uint64_t>, excess, "Listed lights that do not reach the cell");
  END_RECORD;
};

struct CheckPageSet {
  RECORD(CheckPageSet);
  FIELD(std::string, name, "Of the set");
  FIELD(std::vector<CheckPageCell>, cells, "Those of the most deeply lost pairs, the deepest first");
  FIELD(std::uint64_t, cells_left_out, "Further ones of these pairs, which have no room in the page");
  END_RECORD;
};

struct CheckPageFrame {
  RECORD(CheckPageFrame);
  FIELD(CheckedDump, checked, "Its verdict");
  FIELD(CheckPageGrid, grid, "Its cells");
  FIELD(Sides, sides, About("Left, right, bottom, top of the picture at depth 1, or in metres").finite());
  FIELD(bool, orthographic, "Of the camera");
  FIELD(std::vector<CheckPageLight>, lights, "Those that the lists of its cells name");
  FIELD(std::vector<CheckPageSet>, sets, "In the order of the dump; those that could not be read have no cells");
  END_RECORD;
};

struct CheckPage {
  RECORD(CheckPage);
  FIELD(std::string, command, "That makes the page again");
  FIELD(std::string, verdict, "As `check --json` has it");
  FIELD(std::vector<CheckPageFrame>, frames, "In the order of the command line");
  END_RECORD;
};

Json check_page_schema();

extern template const Type& type_of<CheckPage>();

}  // namespace clusterbench::result
