#pragma once
// Hard cases and random settings: the output of `clusterbench stress`.

#include "result/fields.h"

namespace clusterbench::result {

struct StressMethod {
  RECORD(StressMethod);
  FIELD(std::string, label, "The assigner, with its choices where they are not the defaults");
  FIELD(bool, conservative, "It promises to lose no light");
  FIELD(bool, exact, "It promises not to list one too many, either");
  END_RECORD;
};

struct ToolCheck {
  RECORD(ToolCheck);
  FIELD(std::string, what, "What is checked");
  FIELD(bool, passed, "Whether it is as it should be");
  FIELD(std::string, detail, "Figures; may be empty");
  END_RECORD;
};

struct HardCase {
  RECORD(HardCase);
  FIELD(std::string, id, "H1 to H35");
  FIELD(std::string, title, "What is hard");
  FIELD(std::vector<ToolCheck>, checks, "Of the tool itself, without a method");
  END_RECORD;
};

struct LostLight {
  RECORD(LostLight);
  FIELD(std::string, trial, "The scene within the hard case; --failures writes it under this name");
  FIELD(std::uint64_t, cell, "Number of the cell, x fastest, then y, then z");
  FIELD(std::uint64_t, light, "Index in the scene");
  FIELD(double, depth,
        About("1 - distance / range: how far the cell reaches into the light, of its range").finite().as_fraction());
  END_RECORD;
};

struct HardCaseOfMethod {
  RECORD(HardCaseOfMethod);
  FIELD_AS("case", std::string, hard_case, "Id of a hard case");
  FIELD(std::string, method, "Label of a method that takes its grids");
  FIELD(std::uint64_t, trials, "Scenes tried");
  FIELD(std::uint64_t, refused, "Of these, refused as they should be");
  FIELD(std::uint64_t, true_pairs, "(cell, light) that touch, over all trials");
  FIELD(std::uint64_t, misses, "Of these, not listed");
  FIELD(Nullable<LostLight>, deepest_miss,
        "The light that is lost although a cell reaches farthest into it; null: none is lost");
  FIELD(std::uint64_t, extra_pairs, "Listed, but not touching");
  FIELD(std::uint64_t, undecided, "Pairs that exact arithmetic could not decide");
  FIELD(std::vector<std::string>, faults,
        "A refusal that did not come, one that was not expected, lists that are not lists");
  END_RECORD;
};

struct LossSearch {
  RECORD(LossSearch);
  FIELD(std::string, method, "Its label");
  FIELD(std::uint64_t, tries, "Made");
  FIELD(std::uint64_t, misses, "Tries in which a light was lost");
  FIELD(std::optional<std::uint64_t>, undecided,
        About("Tries in which a light was not listed and nothing could decide whether it touches. Absent in older "
              "results")
            .late());
  FIELD(double, least_margin_roundoffs,
        About("Of the padding: by how many unit roundoffs (2^-24 of its reach) the nearest light could have been moved "
              "away and still be listed; 0 where one is lost")
            .finite()
            .as_fraction());
  FIELD(Nullable<LostLight>, deepest_miss,
        "The light that is lost although a cell reaches farthest into it; null: none is lost");
  END_RECORD;
};

struct RandomFault {
  RECORD(RandomFault);
  FIELD(std::string, name, "Of the files that --failures writes");
  FIELD(std::string, kind,
        About("As in fault_count")
            .one_of({"truth", "loss", "extra", "simd-variant", "lists", "error", "undecided", "shading"}));
  FIELD(Nullable<std::string>, method, "Label; null: the truth itself");
  FIELD(std::string, grid, "Kind of grid");
  FIELD(bool, orthographic, "The camera's projection");
  FIELD(std::string, light, About("Its type").one_of({"point", "spot", "box"}));
  FIELD(std::uint64_t, settings, About("That show it").at_least(1));
  FIELD(std::vector<std::uint64_t>, seeds, "The first of these; `--random 1 --seed S` checks one again");
  FIELD(std::string, detail, "What is wrong in the first of them, shrunk");
  END_RECORD;
};

struct RandomSettings {
  RECORD(RandomSettings);
  FIELD(std::uint64_t, first_seed, "Setting i, from 0 on, has the seed first_seed + i");
  FIELD(std::uint64_t, settings, "Checked");
  FIELD(std::uint64_t, refused, "Of these, with a grid that cannot be");
  FIELD(ByName<std::uint64_t>, settings_by_grid, "Settings by kind of grid");
  FIELD(std::uint64_t, points, "Point lights of all settings");
  FIELD(std::uint64_t, spots, "Spot lights of all settings");
  FIELD(std::optional<std::uint64_t>, boxes, "Oriented boxes of all settings");
  FIELD(std::uint64_t, pairs, "Cells x lights of all settings");
  FIELD(std::uint64_t, true_pairs, "Of these, true");
  FIELD(std::uint64_t, listed_pairs, "By all methods, held against the true ones");
  FIELD(std::uint64_t, decisions, "Pairs decided one by one, to check the true lists and what methods differ in");
  FIELD(std::uint64_t, cells_sampled, "Pairs said to be apart in which points of the cell were tried, too");
  FIELD(std::uint64_t, undecided,
        "Pairs that nothing could decide, of the true lists and one by one; each setting with one has a fault");
  FIELD(std::uint64_t, lights_shaded,
        "Lights that clearly reach places in the view, held against the cells in which these are looked up");
  FIELD(ByName<std::uint64_t>, fault_count,
        "Settings that show a fault, by kind: truth (the true lists are wrong), loss (of a conservative method), extra "
        "(of an exact one), simd-variant (lists unlike the reference's), lists (no lists, or other ones when asked "
        "again), error, undecided (pairs that nothing decides), shading (a place is looked up in a cell that lacks a "
        "light that reaches it)");
  FIELD(std::vector<RandomFault>, faults, "Those of one kind, method, grid and type of light together");
  END_RECORD;
};

struct Stress {
  RECORD(Stress);
  FIELD(int, schema_version, About("Grows whenever a name or a meaning changes").always(1));
  FIELD(std::string, kind, About("Of the document").one_of({"stress"}));
  FIELD(std::uint64_t, seed, "Of everything random");
  FIELD(std::uint64_t, tries, "Asked for, of the search per method; 0: no search");
  FIELD(std::optional<bool>, interrupted,
        "A signal ended it: these are the cases, searches and settings that were done");
  FIELD(std::vector<StressMethod>, methods, "Those that were tried");
  FIELD(std::vector<HardCase>, cases, "In their order");
  FIELD(std::vector<HardCaseOfMethod>, results, "Of each case each method");
  FIELD(std::vector<LossSearch>, searches, "H31");
  FIELD(std::optional<Nullable<RandomSettings>>, random, "Random settings (`--random`); null: none were asked for");
  FIELD(std::vector<std::string>, failures, "What makes the exit code 1");
  END_RECORD;
};

Json stress_schema();

extern template const Type& type_of<Stress>();

}  // namespace clusterbench::result
