#pragma once
// The worst frames of a case: the output of `clusterbench worst-case`.

#include "result/shared_parts.h"

namespace clusterbench::result {

// A figure of the measure: a whole number, except for `evaluated`, a mean.
inline constexpr const char* k_figure_shape = R"({"type": "number"})";

struct BoxInMetres {
  RECORD(BoxInMetres);
  FIELD(Vector, min, "Lowest corner");
  FIELD(Vector, max, "Highest corner");
  END_RECORD;
};

struct SearchedRangeRule {
  RECORD(SearchedRangeRule);
  FIELD(double, cutoff_lux, About("At which a light without a range ends", "lux").finite().as_fraction());
  FIELD(double, max_range, About("Largest range that such a light gets", "m").finite().as_fraction());
  END_RECORD;
};

struct SearchedGridEnd {
  static About about() { return About().shaped(R"({"minProperties": 1, "maxProperties": 1})"); }
  RECORD(SearchedGridEnd);
  FIELD(std::optional<BoxInMetres>, bounds_m, "Box of a world grid", "m");
  FIELD(std::optional<double>, slices_m, About("The last slice's far side", "m").finite().as_fraction());
  END_RECORD;
};

struct SearchedSettings {
  RECORD(SearchedSettings);
  FIELD(Nullable<std::string>, fov,
        "Field of view in place of the file's, as in a configuration: degrees with h or v; null: the file's");
  FIELD(std::optional<double>, far,
        About("Far plane in place of the file's, as in a configuration; null: the file's. Absent in files of earlier "
              "versions, which had none",
              "m")
            .as_fraction());
  FIELD(std::string, camera_fit, About("As in a configuration").one_of({"contain", "vertical"}));
  FIELD(bool, boxes, "Whether the scene's oriented boxes are among the lights");
  FIELD(SearchedRangeRule, range_rule, "As in a configuration");
  FIELD(Nullable<SearchedGridEnd>, grid_end,
        "Where the grid ends, given or made up from the recorded path; null: by the camera, by cells of a size, or "
        "another one in each frame");
  END_RECORD;
};

struct SearchedCase {
  RECORD(SearchedCase);
  FIELD(std::string, name, "As `clusterbench run` names it");
  FIELD(std::string, id, "As `run` has it");
  FIELD(std::string, scene, "Its name");
  FIELD(std::string, sha256, "Of the scene's file");
  FIELD(std::string, camera, "Whose projection the search takes, and whose path the recorded frames are of");
  FIELD(Counts2, viewport, "Pixels");
  FIELD(std::string, grid, "Its name; with the far end of slices and the bounds that follow from the recorded path");
  FIELD(std::string, assigner, "Its label");
  FIELD(std::string, storage, "Its label; own: the assigner's own structure");
  FIELD(std::optional<SearchedSettings>, settings,
        "What of the configuration changes the frames besides; absent in files of earlier versions");
  END_RECORD;
};

struct SearchedMeasure {
  RECORD(SearchedMeasure);
  FIELD(std::string, name,
        About("As --measure has it")
            .one_of({"entries", "longest", "p99", "evaluated", "tests", "lights", "lights-of-type"}));
  FIELD(std::string, unit, "Of the values");
  FIELD(std::string, figure, "The same figure of a case in a result of `run`, for a path of one frame");
  END_RECORD;
};

struct Floor {
  RECORD(Floor);
  FIELD(std::uint64_t, triangles, About("That look upward").at_least(1));
  FIELD(double, area_m2, About("Of them together, m²").finite().as_fraction());
  FIELD(double, eye_height_m, About("Of the eye above them, m").finite().as_fraction());
  END_RECORD;
};

struct SearchSpace {
  RECORD(SearchSpace);
  FIELD(BoxInMetres, eyes_m, "Where the camera could stand");
  FIELD(Nullable<Floor>, floor, "null: it could stand anywhere in eyes_m");
  FIELD(std::optional<std::uint64_t>, directions,
        "Of the recorded path, along which alone the camera could look (--keep-direction); 0: it could look anywhere. "
        "Absent in older files");
  FIELD(std::uint64_t, moments,
        About("Of the recorded path, at which lights differ; 1: they never change").at_least(1));
  FIELD(std::uint64_t, lights, "Point and spot lights of the scene");
  FIELD(std::vector<double>, added_ranges_m, About("Of point lights that were added, m").finite().as_fraction());
  FIELD(BoxInMetres, added_within_m, "Where they could stand: the box of the scene's lights and the recorded eyes");
  FIELD(double, move_m, About("How far each light of the scene could be moved, m").finite().as_fraction());
  FIELD(std::optional<std::string>, flags,
        "Those that say what could be chosen, as --keep-height; empty: none was given. Absent in older files");
  END_RECORD;
};

struct SearchStage {
  RECORD(SearchStage);
  FIELD(std::string, name, About("").one_of({"recorded", "sampled", "global", "local", "moved lights"}));
  FIELD(std::uint64_t, evaluations, About("Frames measured").at_least(1));
  FIELD(Json, best, About("The largest value up to its end").shaped(k_figure_shape));
  END_RECORD;
};

struct AddedLight {
  RECORD(AddedLight);
  FIELD(Vector, position_m, "m");
  FIELD(double, range_m, About("m").finite().as_fraction());
  END_RECORD;
};

struct MovedLight {
  RECORD(MovedLight);
  FIELD(std::string, light, "Name");
  FIELD(Vector, position_m, "m");
  END_RECORD;
};

using Quaternion = std::array<double, 4>;

struct WorstFrame {
  RECORD(WorstFrame);
  FIELD(Json, value, About("In the written path, as `run` gives it").shaped(k_figure_shape));
  FIELD(Vector, eye_m, "Position of the camera, m");
  FIELD(Vector, direction, "Along which it looks; unit up to rounding");
  FIELD(Quaternion, rotation, About("Quaternion x, y, z, w of the camera's node").finite().as_fraction());
  FIELD(std::uint64_t, moment, "Of the lights, 0: the first");
  FIELD(std::vector<AddedLight>, added_lights, "In the order of added_ranges_m");
  FIELD(std::vector<MovedLight>, moved_lights, "Lights of the scene that stand elsewhere");
  END_RECORD;
};

struct RecordedPath {
  RECORD(RecordedPath);
  FIELD(std::uint64_t, frames, About("Of the path").at_least(1));
  FIELD(Json, max, About("The largest value").shaped(k_figure_shape));
  FIELD(std::uint64_t, frame, "The first with it");
  END_RECORD;
};

struct RandomFrames {
  RECORD(RandomFrames);
  FIELD(std::uint64_t, frames, About("Measured").at_least(1));
  FIELD(Json, max, About("The largest value").shaped(k_figure_shape));
  FIELD(double, mean, About("Of their values").finite().as_fraction());
  END_RECORD;
};

struct NeededBuffer {
  RECORD(NeededBuffer);
  FIELD(std::string, name, "As the structure names it");
  FIELD(std::uint64_t, elements, "That it needs", "elements");
  FIELD(std::uint64_t, theoretical_max, "That any frame could need with these lights", "elements");
  FIELD(std::optional<std::uint64_t>, element_bytes,
        About("Of an element, with these lights; absent in documents of earlier versions", "bytes").at_least(1));
  END_RECORD;
};

struct LightsOfWorstFrame {
  RECORD(LightsOfWorstFrame);
  FIELD(std::uint64_t, all, "Lights whose bounding sphere is in view", "lights");
  FIELD(std::uint64_t, dark, "Of these, such as are dark there: intensity 0 or black", "lights");
  END_RECORD;
};

struct WrittenFrames {
  RECORD(WrittenFrames);
  FIELD(std::string, scene, "The frames as a scene with a camera path");
  FIELD(std::string, config, "The configuration that `run` replays it with");
  END_RECORD;
};

struct WorstCase {
  RECORD(WorstCase);
  FIELD(int, schema_version, About("Grows whenever a name or a meaning changes").always(1));
  FIELD(std::string, kind, About("Of the document").one_of({"worst-case"}));
  FIELD_AS("case", SearchedCase, searched, "What was searched");
  FIELD(std::uint64_t, other_cases, "Cases that were not searched");
  FIELD(SearchedMeasure, measure, "What was made as large as possible");
  FIELD(std::uint64_t, seed, "Of everything random");
  FIELD(std::uint64_t, evaluations, "Frames that the search has measured");
  FIELD(std::uint64_t, evaluations_allowed, About("At most").at_least(1));
  FIELD(std::string, ended,
        About("What ended the search. Only with `evaluations` the same call gives the same result")
            .one_of({"evaluations", "seconds", "signal", "device"}));
  FIELD(SearchSpace, space, "What could be chosen");
  FIELD(std::vector<SearchStage>, stages, "Of the search, in their order");
  FIELD(std::vector<WorstFrame>, frames,
        "The worst ones found, the worst first: those of the written path; a random frame among them where it is worse "
        "than what was searched for");
  FIELD(RecordedPath, recorded, "The camera's own path, with the scene's own lights");
  FIELD(Nullable<RandomFrames>, random, "Random frames of the same space, measured for comparison; null: none");
  FIELD(Json, theoretical_max,
        About("If every light were in every cell of the worst frame; null for tests, which have none")
            .shaped(R"({"type": ["number", "null"]})"));
  FIELD(std::optional<std::vector<NeededBuffer>>, buffers,
        "What the worst frame needs of each buffer; absent in documents of earlier versions");
  FIELD(std::optional<LightsOfWorstFrame>, lights_in_view,
        "In the worst frame; absent in documents of earlier versions");
  FIELD(Nullable<WrittenFrames>, written, "null: nothing was written");
  FIELD(std::vector<std::string>, warnings, "For the reader");
  END_RECORD;
};

Json worst_case_schema();

extern template const Type& type_of<WorstCase>();

}  // namespace clusterbench::result
