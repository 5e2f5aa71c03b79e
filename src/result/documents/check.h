#pragma once
// What `clusterbench check` found in dumps: the output of --json.

#include "result/shared_parts.h"

namespace clusterbench::result {

struct ReadingFault {
  RECORD(ReadingFault);
  FIELD(std::string, buffer, "Where it is; empty: in the dump itself");
  FIELD(std::uint64_t, byte, "First byte of the value, in the buffer's file", "bytes");
  FIELD(std::uint64_t, value, "What was read there");
  FIELD(CellIndex, cell, "Whose list was read: column from the left, row from the top, slice from the near end");
  FIELD(std::string, message, "What is wrong, in a sentence");
  END_RECORD;
};

struct ListReading {
  static About about() { return About("Whether the buffers hold lists at all"); }
  RECORD(ListReading);
  FIELD(std::uint64_t, fault_count, "Values that cannot be right");
  FIELD(std::vector<ReadingFault>, faults, "The first of them");
  FIELD(std::uint64_t, twice_count, "Entries of a light that its list has already", "pairs");
  FIELD(std::vector<ReadingFault>, twice, "The first of them, each at the later entry");
  FIELD(Nullable<std::string>, likely_reading,
        "Another description under which nothing is wrong; null: none was found");
  END_RECORD;
};

struct ListErrors {
  RECORD(ListErrors);
  FIELD(std::uint64_t, true_pairs, "Pairs of a cell and a light that share a point", "pairs");
  FIELD(std::uint64_t, listed_pairs, "Pairs in the lists", "pairs");
  FIELD(std::uint64_t, false_positives, "Listed pairs that are not true", "pairs");
  FIELD(std::uint64_t, lost_pairs, "True pairs that are not listed", "pairs");
  FIELD(std::uint64_t, lost_within_rounding, "Of these, those that `rounding` of the dump allows for", "pairs");
  FIELD(std::uint64_t, lost_lights, "Lights that a cell has lost, each once", "lights");
  FIELD(std::uint64_t, lost_in_full_lists, "Of the lost pairs, those of cells whose list is full (layout fixed)",
        "pairs");
  FIELD(std::uint64_t, lost_in_longest_lists, "Of the lost pairs, those of cells whose list is as long as the longest",
        "pairs");
  FIELD(std::uint64_t, absent_lights, "Lights that reach a cell and are in no list at all", "lights");
  FIELD(std::uint64_t, undecided, "Pairs that exact arithmetic could not decide; counted as true", "pairs");
  FIELD(double, deepest_mm,
        About("How far the most deeply lost light, by its share of the range, reaches into its cell; of equal shares "
              "the longest; null: the range has no end",
              "mm")
            .at_least(0)
            .as_fraction());
  FIELD(double, deepest_percent,
        About("The same in percent of the range", "percent").finite().at_least(0).as_fraction());
  END_RECORD;
};

struct LostInCell {
  static About about() { return About("A pair that is true and not listed"); }
  RECORD(LostInCell);
  FIELD(std::uint64_t, light, "By its index in the dump");
  FIELD(CellIndex, cell, "Column from the left, row from the top, slice from the near end");
  FIELD(std::uint64_t, row, "Number of the cell in the dump's own order");
  FIELD(double, from_m,
        About("Where the cell begins: depth, distance, or z in a world grid", "m").finite().as_fraction());
  FIELD(double, to_m, About("Where it ends", "m").finite().as_fraction());
  FIELD(double, reach_mm,
        About("How far the light reaches into the cell; null: its range has no end", "mm").at_least(0).as_fraction());
  FIELD(double, reach_percent, About("The same in percent of the range", "percent").finite().at_least(0).as_fraction());
  FIELD(bool, is_within_rounding, "Whether `rounding` of the dump allows for it");
  END_RECORD;
};

struct OtherReading {
  static About about() {
    return About(
        "Another order of cells, another camera, other ranges or another description of lists, which loses far fewer "
        "lights, or makes far more of the listed pairs true");
  }
  RECORD(OtherReading);
  FIELD(std::string, axes, "As grid.axes of the dump");
  FIELD(std::string, first_row, "As grid.first_row");
  FIELD(std::string, first_slice, "As grid.first_slice");
  FIELD(std::string, order, "What differs in these three; empty: nothing");
  FIELD(std::string, camera, "What differs in the camera; empty: nothing");
  FIELD(std::string, lists, "What differs in the description of the lists; empty: nothing");
  FIELD(std::string, lights, "What differs in the lights' ranges; empty: nothing");
  FIELD(std::uint64_t, lost_pairs, "That it would lose", "pairs");
  END_RECORD;
};

struct CheckedSet {
  static About about() { return About("Lists that are judged together"); }
  RECORD(CheckedSet);
  FIELD(std::string, name, "Of the set");
  FIELD(std::string, verdict,
        About("unreadable: no lists; misread: other_reading fits far better; lost: a light is missing where it shines, "
              "beyond rounding; twice: none is, and "
              "one is twice in a list; empty: no light reaches a cell, so nothing was checked; rounding: one is "
              "missing within "
              "rounding; right: nothing of all that")
            .one_of({"unreadable", "misread", "lost", "twice", "empty", "rounding", "right"}));
  FIELD(ListReading, reading, "The buffers");
  FIELD(std::vector<std::string>, remarks,
        "What may be wrong with the description, though no other reading is likelier: rows of buffers that are not "
        "read, cameras and ranges that make many more listed pairs true");
  FIELD(std::uint64_t, bytes, "Of all buffers that its lists are read from", "bytes");
  FIELD(std::uint64_t, longest_list, "Most lights in a cell", "lights");
  FIELD(Nullable<CellIndex>, longest_cell, "The first cell with so many; null: all are empty");
  FIELD(Nullable<ListErrors>, error, "Against the exact lists; null where lists could not be read");
  FIELD(std::vector<LostInCell>, lost, "The most deeply lost first, at most 1000");
  FIELD(Nullable<OtherReading>, other_reading, "Which is likelier than the dump's; null: none is");
  END_RECORD;
};

struct CheckedMethod {
  static About about() { return About("A method of clusterbench on the same frame"); }
  RECORD(CheckedMethod);
  FIELD(std::string, name, "As in `clusterbench list`");
  FIELD(std::uint64_t, listed_pairs, "Pairs in its lists", "pairs");
  FIELD(std::uint64_t, false_positives, "Of them not true", "pairs");
  FIELD(std::uint64_t, lost_pairs, "True pairs that it does not list", "pairs");
  FIELD(std::uint64_t, packed_bytes, "Of its lists as `packed`", "bytes");
  END_RECORD;
};

struct CheckedDump {
  RECORD(CheckedDump);
  FIELD(std::string, dump, "Its file");
  FIELD(std::string, name, "Of the dump");
  FIELD(std::string, engine, "Of the dump; empty: it does not say");
  FIELD(std::uint64_t, points, "Point lights", "lights");
  FIELD(std::uint64_t, spots, "Spot lights", "lights");
  FIELD(std::string, grid_kind, "Of the grid");
  FIELD(CellIndex, cells, "Numbers of columns, rows and slices");
  FIELD(std::string, first_row,
        About("As grid.first_row of the dump, whose rows `row` counts; `cell` always counts from the top")
            .one_of({"top", "bottom"}));
  FIELD(std::string, first_slice,
        About("As grid.first_slice, in the same way; `cell` always counts from the near end").one_of({"near", "far"}));
  FIELD(std::vector<CheckedSet>, sets, "In the order of the dump");
  FIELD(std::vector<CheckedMethod>, methods, "On the same frame; empty with --methods none");
  FIELD(std::vector<std::string>, methods_left_out, "Of those that were asked for: would take too long on this frame");
  END_RECORD;
};

struct Check {
  RECORD(Check);
  FIELD(int, check_version, About("Grows whenever a name or a meaning changes").always(1));
  FIELD(std::string, verdict,
        About("The worst of all sets; without empty frames whose lists are empty, too, unless all are")
            .one_of({"unreadable", "misread", "lost", "twice", "empty", "rounding", "right"}));
  FIELD(std::vector<CheckedDump>, frames, "In the order of the command line; of a folder by name");
  END_RECORD;
};

Json check_schema();

extern template const Type& type_of<Check>();

}  // namespace clusterbench::result
