#pragma once
// A recommendation: the output of `clusterbench recommend -o FILE`.

#include "result/result.h"

namespace clusterbench::result {

struct Objective {
  RECORD(Objective);
  FIELD(std::string, figure, "What is to be least, as in `--by`");
  FIELD(std::string, meaning, "What that is");
  FIELD(bool, timed, "Whether it differs from run to run");
  END_RECORD;
};

struct Candidate {
  static constexpr const char* k_definition = "candidate";
  static About about() { return About("A grid with a method and what keeps its lists"); }
  RECORD(Candidate);
  FIELD(std::string, name, "Grid, method and what keeps its lists, as in the names of cases");
  FIELD(std::vector<std::string>, ids, "Of its cases, one for each camera: as `run` gives them");
  FIELD(Json, grid, "As a configuration has it");
  FIELD(std::uint64_t, cells, "Cells of the grid, of the last frame where it changes", "cells");
  FIELD(Json, assigner, "As a configuration has it: name and parameters");
  FIELD(Json, storage,
        About("As a configuration has it; null: the method's own structure").shaped(R"({"type": ["object", "null"]})"));
  FIELD(Json, precision, "As a configuration has it");
  FIELD(double, objective, About("What is to be least, on all frames", "as in objective.figure").at_least(0));
  FIELD(double, by_choice,
        About("Objective / that of the choice. Of frame times and modelled costs the median of the ratios of the "
              "rounds, or launches, that both were measured in",
              "ratio")
            .at_least(0));
  FIELD(std::optional<Pair>, ci95, "Its 95 % interval, where both were measured side by side", "ratio");
  FIELD(std::optional<Pair>, by_prices,
        "From and to what by_choice goes as each price of config.cost (of uploading, drawing, reading, looping) takes "
        "values between half and twice its own. Absent where the objective is no cost or it costs no more, and in "
        "older answers",
        "ratio");
  FIELD(ByName<double>, figures,
        "All figures that it has, by their names in budgets and in `--by`: of several cameras the largest high-water "
        "mark, the sum of counts, else the mean by frames");
  FIELD(double, overshade,
        About("Lights given at samples / lights that they need: of the samples that cost something where the objective "
              "is a cost, else of random points of the view. Absent in older answers",
              "ratio")
            .at_least(0)
            .late());
  END_RECORD;
};

struct NearestRejected {
  RECORD(NearestRejected);
  FIELD(std::string, name, "As in candidates");
  FIELD(double, figure,
        About("The largest of its cameras, on the frames that it was measured on", "as in constraint")
            .finite()
            .at_least(0));
  FIELD(std::uint64_t, frames, "That it was measured on", "frames");
  END_RECORD;
};

struct BestRejected {
  RECORD(BestRejected);
  FIELD(std::string, name, "As in candidates");
  FIELD(double, objective, About("On the frames that it was measured on", "as in objective.figure").at_least(0));
  FIELD(double, by_best,
        About("That / the least of the candidates that break nothing on the same frames; null: there is none, or those "
              "are all frames",
              "ratio")
            .at_least(0));
  FIELD(std::uint64_t, frames, "That it was measured on", "frames");
  END_RECORD;
};

struct ConstraintOfAnswer {
  static About about() { return About("What a constraint has excluded"); }
  RECORD(ConstraintOfAnswer);
  FIELD(std::string, constraint, "What has to hold for each camera: `bytes <= 200000`");
  FIELD(bool, given, "false: it holds anyway");
  FIELD(std::uint64_t, excluded, "Candidates that were seen to break it", "candidates");
  FIELD(std::uint64_t, alone, "Of them, those that were seen to break no other one", "candidates");
  FIELD(Nullable<NearestRejected>, nearest,
        "That of them with the least of the figure; null: there are none, or they have no such figure");
  FIELD(Nullable<BestRejected>, best, "The best of them; null: there are none");
  END_RECORD;
};

struct SearchRung {
  static About about() { return About("A step of successive halving"); }
  RECORD(SearchRung);
  FIELD(std::uint64_t, frames, About("That its candidates were measured on", "frames").at_least(1));
  FIELD(std::uint64_t, candidates, "Measured", "candidates");
  FIELD(std::uint64_t, excluded, "Of them: break a constraint that further frames cannot mend", "candidates");
  FIELD(std::uint64_t, kept, "Of them: in the next rung, or measured on all frames", "candidates");
  END_RECORD;
};

struct SearchWork {
  RECORD(SearchWork);
  FIELD(std::uint64_t, measurements,
        About("Candidates times frames as often as they were measured: a stage measures the frames of the one before "
              "again, and all frames are counted once to order them. Absent in older answers",
              "frames")
            .late());
  FIELD(std::uint64_t, evaluations, "Candidates times frames that were measured, each once", "frames");
  FIELD(std::uint64_t, all_evaluations, "Of all candidates on all frames", "frames");
  FIELD(double, evaluations_share, About("The first / the second", "share").finite().at_least(0));
  FIELD(double, tests, About("Sum over the evaluations of lights x cells", "tests").finite().at_least(0));
  FIELD(double, all_tests, About("Of all candidates on all frames", "tests").finite().at_least(0));
  FIELD(double, tests_share, About("The first / the second", "share").finite().at_least(0));
  END_RECORD;
};

struct Answer {
  static About about() { return About("The answer for one scene and viewport"); }
  RECORD(Answer);
  FIELD(std::string, scene, "Name of the scene");
  FIELD(std::string, sha256, "Of all that was read of its file");
  FIELD(std::vector<std::string>, cameras, "Names of the cameras");
  FIELD(std::vector<std::string>, blind_cameras,
        About("Names of cameras that have no part in the answer, since no light that shines is in view in any of their "
              "frames. Absent in older answers, where they had")
            .late());
  FIELD(Counts2, viewport, About("Image size", "px").at_least(1));
  FIELD(std::uint64_t, frames, "Of all cameras together", "frames");
  FIELD(std::uint64_t, lights, "Of the scene", "lights");
  FIELD(std::uint64_t, candidates, "Searched", "candidates");
  FIELD(std::uint64_t, incomplete, "Left out, since not every camera can have their grid", "candidates");
  FIELD(std::vector<std::string>, samples,
        About("The sets of samples that candidates are ranked by: what cost, overshade, evaluated and read_bytes are "
              "of. Empty where nothing was found; absent in older answers")
            .each("A set, as in `samples` of a configuration; volume: random points in the view")
            .late());
  FIELD(bool, random_depths,
        About("The objective is of samples at random depths of the view, since the scene has no triangles and no floor "
              "was asked for (samples.opaque.ground), or since samples.opaque was not: on surfaces another choice can "
              "be better. Absent in older answers")
            .late());
  FIELD(double, ground_m,
        About("Height of the floor (the world's y) on which opaque samples lie, where samples.opaque.ground asks for "
              "one and the scene has no triangles. Absent in older answers",
              "m")
            .late());
  FIELD(double, needed_at_samples,
        About("Lights that reach the samples which the choice's cost is that of, of all cameras and frames together. "
              "Fewer than 1000 are too few to say that it loses none of a thousand. null where the objective is no "
              "cost. Absent in older answers",
              "lights")
            .at_least(0)
            .as_fraction()
            .late());
  FIELD(Nullable<std::string>, no_reader,
        About("Why `size --format hlsl` (glsl) has no function that reads the choice's lists; null where it has one, "
              "or there is no choice. Absent in older answers")
            .late());
  FIELD(Nullable<std::string>, nothing_seen,
        About("Why there is nothing to choose by, and so no choice: the scene has no lights, none is in view, no "
              "sample that the objective rests on sees one or the floor, or a figure with a given limit is not known "
              "since there are no samples. Absent in older answers")
            .late());
  FIELD(std::vector<std::string>, timing_doubts,
        About("What speaks against the times of what was measured on all frames, as wide intervals or other programs "
              "at work, and what to try. Absent in older answers")
            .late());
  FIELD(Nullable<Candidate>, choice,
        "The recommended one: of those that are not known to be worse than the best (by the interval of their ratio, "
        "or within 5 % where costs are modelled) the one with the fewest bytes, then cells. null: no candidate "
        "satisfies all constraints, or there is nothing to choose by (nothing_seen)");
  FIELD(std::vector<Candidate>, runners_up,
        "The next ones that were measured on all frames and break no constraint, the best first");
  FIELD(std::vector<Candidate>, searched,
        About("Structures that samples search for their lights, a hierarchy or masks of bits, the best first of those "
              "that break no constraint. What samples read and visit there is priced by config.cost, and no GPU has "
              "measured it: so they are ranked by themselves and are never the choice where there are lists. by_choice "
              "is beside the choice, or beside the first of these where there is none. Absent in older answers")
            .late());
  FIELD(double, within,
        About("How much worse than the best `coarsest` may be", "share").finite().at_least(0).as_fraction());
  FIELD(Nullable<Candidate>, coarsest,
        "Of the candidates that were measured on all frames and are so good, the one with the fewest cells. null: that "
        "is the choice");
  FIELD(std::vector<ConstraintOfAnswer>, constraints, "Those that were given, then those that hold anyway");
  FIELD(std::uint64_t, provisional,
        About("Without a choice: candidates that were measured on some frames only, and that further frames could "
              "make satisfy all constraints, since each one that they break can still hold: a mean can fall. None of "
              "them was among the best, which were measured on all frames. 0 with a choice; absent in older answers",
              "candidates")
            .late());
  FIELD(std::vector<SearchRung>, rungs, "The steps of successive halving");
  FIELD(std::uint64_t, finalists, "Candidates that were measured on all frames at the end", "candidates");
  FIELD(std::uint64_t, challengers,
        "Of them, those that halving had dropped and that could still have been better: only where the objective is a "
        "high-water mark, for which the choice is then proven to be the least",
        "candidates");
  FIELD(SearchWork, work, "What was measured, beside measuring all");
  END_RECORD;
};

struct Recommendation {
  RECORD(Recommendation);
  FIELD(int, recommendation_version, About("Grows whenever a name or a meaning changes").always(1));
  FIELD(std::string, name, "Of the configuration");
  FIELD(Tool, tool, "As results have it");
  FIELD(Machine, machine, "As in a result");
  FIELD(Json, config,
        "The configuration with all defaults: its grids, assigners, storages and precisions are the candidates");
  FIELD(Objective, objective, "What candidates are ranked by");
  FIELD(std::vector<Answer>, answers, "One for each scene and viewport");
  END_RECORD;
};

Json recommendation_schema();

extern template const Type& type_of<Recommendation>();

}  // namespace clusterbench::result
