#pragma once
// A comparison: the output of `clusterbench compare BASE NEW --json FILE`.

#include "result/result.h"

namespace clusterbench::result {

struct ComparedProgram {
  RECORD(ComparedProgram);
  FIELD(Tool, tool, "As results have it");
  FIELD(std::optional<std::vector<Plugin>>, plugins, "As results have them; absent without any");
  END_RECORD;
};

struct NotComparable {
  RECORD(NotComparable);
  FIELD(std::optional<std::vector<std::string>>, instructions, About("Why not").items(1, 0));
  FIELD(std::optional<std::vector<std::string>>, times, About("Why not").items(1, 0));
  END_RECORD;
};

struct Difference {
  RECORD(Difference);
  FIELD(std::string, what, "JSON pointer into the case");
  FIELD(Json, base, About("The value").shaped("{}"));
  FIELD_AS("new", Json, next, About("The value").shaped("{}"));
  FIELD(std::string, is,
        About("changed: says the same as another value, or how it was found").one_of({"better", "worse", "changed"}));
  END_RECORD;
};

struct ComparedInstructions {
  RECORD(ComparedInstructions);
  FIELD(std::string, verdict, About("Of assignment and conversion").one_of({"more", "fewer", "same"}));
  FIELD(double, assign_ratio, "Instructions of a frame's assignment, new / base");
  FIELD(double, convert_ratio, "Of its conversion to the storage");
  FIELD(double, build_ratio, "Of the grid's build");
  FIELD(double, tolerance,
        About("Smaller changes are same: what counting itself leaves open").finite().at_least(0).as_fraction());
  END_RECORD;
};

struct ComparedCase {
  static About about() {
    return About().shaped(R"({
      "dependencies": {
        "verdict": ["ratio", "ci95", "p_corrected", "base_ns", "new_ns", "launches"],
        "hint": ["ratio", "ci95", "base_ns", "new_ns", "launches"]
      },
      "not": {"required": ["verdict", "hint"]}
    })");
  }
  RECORD(ComparedCase);
  FIELD(std::string, id, "Of both results' case");
  FIELD(std::string, name, "Of both results' case");
  FIELD(std::optional<std::string>, hint,
        About("Of times of separate runs; fails nothing").one_of({"longer", "shorter", "none"}));
  FIELD(std::optional<std::string>, verdict,
        About("Of times side by side, and of separate runs with --gate-separate")
            .one_of({"faster", "slower", "same", "inconclusive"}));
  FIELD(std::optional<double>, p_corrected,
        About("Of a verdict: chance of such a change from noise alone, by Holm's correction over all methods")
            .finite()
            .at_least(0)
            .at_most(1)
            .as_fraction());
  FIELD(std::optional<double>, ratio,
        "Of the times, new / base; null where it is not finite; absent, as all to launches, without times");
  FIELD(std::optional<Pair>, ci95, "95 % interval of the ratio; null where it is unknown");
  FIELD(std::optional<double>, base_ns, About("Per frame").finite().at_least(0).as_fraction());
  FIELD(std::optional<double>, new_ns, About("Per frame").finite().at_least(0).as_fraction());
  FIELD(std::optional<std::uint64_t>, launches, "Of both programs in turns; 0: times of separate runs");
  FIELD(std::string, counts, About("What is counted exactly").one_of({"same", "better", "worse"}));
  FIELD(std::vector<Difference>, differences, "In what is counted");
  FIELD(std::optional<std::string>, place, "The deepest light that is newly lost: frame, cell and light");
  FIELD(std::optional<ListsDiffer>, lists, "Where both programs' lists first differ");
  FIELD(std::optional<ComparedInstructions>, instructions, "Where both results counted by the same means");
  END_RECORD;
};

struct ComparisonSummary {
  RECORD(ComparisonSummary);
  FIELD(std::uint64_t, cases, "In both results");
  FIELD(std::uint64_t, methods_timed,
        "Times that were compared: of cases; of assignment, which a method's storages share, of methods");
  FIELD(std::uint64_t, faster, "Cases");
  FIELD(std::uint64_t, slower, "Cases");
  FIELD(std::uint64_t, same, "Cases");
  FIELD(std::uint64_t, inconclusive, "Cases");
  FIELD(std::uint64_t, hints_shorter, "Cases");
  FIELD(std::uint64_t, hints_longer, "Cases");
  FIELD(std::uint64_t, counts_better, "Cases");
  FIELD(std::uint64_t, counts_worse, "Cases");
  FIELD(std::optional<double>, ratio,
        "Geometric mean over the methods that were timed side by side; absent, as ci95, of separate runs");
  FIELD(std::optional<Pair>, ci95, "95 % interval of the ratio; null where it is unknown");
  END_RECORD;
};

struct RenamedCase {
  RECORD(RenamedCase);
  FIELD(std::string, name, "Of both cases");
  FIELD(std::vector<std::string>, differs_in, About("Settings").items(1, 0));
  END_RECORD;
};

struct PartOfOne {
  RECORD(PartOfOne);
  FIELD(std::string, part, "As in a result's case: shading, timing, ...");
  FIELD(std::string, only_in, About("Which result has it").one_of({"base", "new"}));
  FIELD(std::uint64_t, cases, About("How many").at_least(1));
  END_RECORD;
};

struct Comparison {
  RECORD(Comparison);
  FIELD(int, comparison_version, About("Grows whenever a name or a meaning changes").always(1));
  FIELD(double, threshold, About("Of a change in time: 0.02 is 2 %").finite().at_least(0).as_fraction());
  FIELD(std::string, data,
        About("Times of both programs side by side, or of separate runs").one_of({"paired", "separate"}));
  FIELD(std::string, time,
        About("What the times are of: a frame, or side by side the assignment alone").one_of({"frame", "assign"}));
  FIELD(ComparedProgram, base, "The program that measured the base");
  FIELD_AS("new", ComparedProgram, next, "The program that measured the new result");
  FIELD(NotComparable, left_out, "What both results have and is not compared, with the fields in which they differ");
  FIELD(std::vector<ComparedCase>, cases, "Those of both results");
  FIELD(std::optional<bool>, is_same_program,
        "true: both programs are the same file, byte for byte, so that no verdict is another than `same`; else absent");
  FIELD(ComparisonSummary, summary, "Over the cases");
  FIELD(std::vector<std::string>, only_in_base, "Names of cases");
  FIELD(std::vector<std::string>, only_in_new, "Names of cases");
  FIELD(std::vector<RenamedCase>, renamed,
        "Cases in only_in_base and only_in_new that have one name, with the settings in which they differ");
  FIELD(std::optional<std::vector<BrokenCase>>, broken,
        About("Cases of the base that the new result has no figures of, since a plug-in crashed, hung, took too much "
              "memory or failed. Absent where there are none")
            .items(1, 0));
  FIELD(std::vector<PartOfOne>, not_compared, "Parts that cases of both results have in one of them alone");
  FIELD(std::vector<std::string>, failures, "What makes the exit code 1");
  FIELD(std::vector<std::string>, warnings, "What to know before believing it");
  FIELD(std::optional<std::vector<std::string>>, advice,
        About("What to do about verdicts that are inconclusive, or what the times of a program beside itself say; "
              "absent where every verdict stands")
            .items(1, 0));
  END_RECORD;
};

Json comparison_schema();

extern template const Type& type_of<Comparison>();

}  // namespace clusterbench::result
