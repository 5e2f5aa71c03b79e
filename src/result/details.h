#pragma once
// Frames cell by cell.

#include "result/shared_parts.h"

namespace clusterbench::result {

struct DetailedCamera {
  RECORD(DetailedCamera);
  FIELD(Vector, eye, About("Position in world space", "m", "the frame").finite().as_fraction());
  FIELD(Matrix, view_from_world,
        About("Rows of the rotation: view = rotation (world - eye), looking down -z", "1", "the frame")
            .finite()
            .as_fraction());
  FIELD(bool, orthographic, "true: orthographic; false: perspective");
  FIELD(Sides, sides,
        About("Left, right, bottom, top of the image: slopes, or metres of an orthographic camera", "slope, or m",
              "the frame")
            .finite()
            .as_fraction());
  FIELD(double, near_m, About("Near plane", "m", "the frame").finite().as_fraction());
  FIELD(double, far_m, About("Far plane; null: infinite", "m", "the frame").as_fraction());
  END_RECORD;
};

struct DetailedTiles {
  RECORD(DetailedTiles);
  FIELD(Counts2, count, About("Across and down", "tiles").at_least(1));
  FIELD(std::optional<Counts2>, pixels,
        About("Width and height of a tile; absent for tiles per screen", "px").at_least(1));
  END_RECORD;
};

struct DetailedBox {
  RECORD(DetailedBox);
  FIELD(Vector, origin, "Position in the world that min and max are relative to");
  FIELD(Vector, min, "Lowest corner");
  FIELD(Vector, max, "Highest corner");
  END_RECORD;
};

struct DetailedCells {
  RECORD(DetailedCells);
  FIELD(std::uint64_t, count, "Cells with a reported or a true light; all others are empty", "cells", "the frame");
  FIELD(std::string, indices, "Gaps of their indices, x fastest, then y, then z");
  FIELD(std::string, reported, "Lights in each cell's list");
  FIELD_AS("true", std::string, true_lights, "Lights that reach each cell");
  FIELD(std::string, false_positives, "Lights in each cell's list that do not reach it");
  FIELD(std::string, false_negatives, "Lights that reach each cell and are not in its list");
  END_RECORD;
};

struct DetailedLights {
  RECORD(DetailedLights);
  FIELD(std::string, indices, "Gaps of their indices in the lists");
  FIELD(std::vector<std::string>, names, "Names in the scene, in the order of indices");
  FIELD(std::string, positions, "3 numbers per light: x y z in view space, metres");
  FIELD(std::string, ranges, "Ranges in metres; Infinity: without end");
  FIELD(std::uint64_t, spots, "Number of spots: they are the last ones, or those before the boxes", "lights",
        "the frame");
  FIELD(std::string, spot_axes, "3 numbers per spot: unit vector in view space");
  FIELD(std::string, spot_half_angles, "Half-angle of each spot's cone, radians");
  FIELD(std::optional<std::uint64_t>, boxes,
        About("Number of boxes: they are the last ones. Absent without any", "boxes", "the frame").at_least(1));
  FIELD(std::optional<std::string>, box_half_axes,
        "9 numbers per box: three half axes in view space, metres. Absent without any");
  END_RECORD;
};

struct DetailedPairs {
  RECORD(DetailedPairs);
  FIELD(std::string, lights,
        "Cell after cell (reported + false_negatives each) the gaps of its lights' indices, which start again in each "
        "cell");
  FIELD(std::string, marks, "0: reported and true, 1: false positive, 2: false negative");
  END_RECORD;
};

struct DetailedFrame {
  static About about() { return About("One frame"); }
  RECORD(DetailedFrame);
  FIELD(std::uint64_t, frame, "Number of the frame on the camera's path, from 0", "frame", "the path");
  FIELD(double, time_s, About("Time of the animation", "s", "the frame").finite().as_fraction());
  FIELD(DetailedCamera, camera, "Pose and projection");
  FIELD(std::optional<std::string>, boundaries,
        "Boundaries of the slices, as a row of numbers; absent where they are those of the case's grid");
  FIELD(std::optional<DetailedTiles>, tiles,
        "Tiles of a grid that reacts; absent where they are those of the case's grid", "", "the frame");
  FIELD(std::optional<DetailedBox>, box, "Box of a world grid; absent where it is that of the case's grid", "m",
        "the frame");
  FIELD(DetailedCells, cells,
        "Rows of count numbers each. A row of numbers is a text: numbers are separated by one space, N*K is N repeated "
        "K times. Gaps: the first number, then the difference of each to the one before. docs/details.md has a reader");
  FIELD(DetailedLights, lights,
        "Lights in any list of the frame, reported or true, ascending by index; as rows of numbers");
  FIELD(std::optional<DetailedPairs>, pairs, "Each cell's lights; missing where lists are not asked for or left out");
  END_RECORD;
};

struct LeftOut {
  RECORD(LeftOut);
  FIELD(std::vector<std::uint64_t>, frames, "Frames for which max_bytes has no room", "frame", "the path");
  FIELD(std::vector<std::uint64_t>, pairs, "Frames that are here without their pairs, for which max_bytes has no room",
        "frame", "the path");
  FIELD(std::vector<std::uint64_t>, not_on_path, "Frames that the configuration names and the path does not have",
        "frame", "the path");
  END_RECORD;
};

struct Details {
  RECORD(Details);
  FIELD(std::uint64_t, max_bytes, "Most bytes that the configuration allows", "bytes", "the case");
  FIELD(std::vector<DetailedFrame>, frames, "");
  FIELD(LeftOut, left_out, "What was asked for and is not in the result");
  END_RECORD;
};

}  // namespace clusterbench::result
