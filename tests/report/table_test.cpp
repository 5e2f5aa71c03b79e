#include "report/tables/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "report/result_by_hand.h"
#include "report/results/result_record.h"

namespace clusterbench::report {
namespace {

using testing::add_count;
using testing::add_precision;
using testing::add_stability;
using testing::judged;
using testing::lose_a_light;
using testing::result_by_hand;

std::string table_of(const run::Result& result, bool colour = false) {
  return render_table(record_of(result, {}), colour);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string line_with(const std::string& text, const std::string& part) {
  for (const std::string& line : lines_of(text))
    if (line.find(part) != std::string::npos) return line;
  return "";
}

std::vector<std::string> words(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), {}};
}

TEST(Table, a_line_holds_the_figures_of_its_case) {
  EXPECT_EQ(words(line_with(table_of(result_by_hand()), "aabb ")),
            (std::vector<std::string>{"*", "aabb", "3.50", "0.0", "%", "4.20", "@1", "3.00", "0.50", "25", "140.00",
                                      "25.0", "%", "0", "0", "%", "1.50", "232"}));
}

TEST(Table, a_wide_interval_shows_both_sides_and_a_narrow_one_half_of_it) {
  const auto with_interval = [](double low, double high) {
    run::Result result = result_by_hand();
    result.cases[1].timing->frame_ns.ci95 = {low, high};  // of 3500 ns
    return words(line_with(table_of(result), "aabb ")).at(3);
  };
  EXPECT_EQ(with_interval(3430, 3535), "1.5");
  EXPECT_EQ(with_interval(3080, 4165), "15.5") << "12 % below, 19 % above";
  EXPECT_EQ(with_interval(3150, 4900), "-10/+40");
}

TEST(Table, the_fastest_case_comes_first) {
  const std::string table = table_of(result_by_hand());
  EXPECT_LT(table.find("aabb "), table.find("brute-force "));
}

TEST(Table, only_the_front_is_marked) {
  const std::string table = table_of(result_by_hand());
  EXPECT_EQ(words(line_with(table, "brute-force ")).front(), "brute-force");
}

TEST(Table, columns_are_aligned_and_fit_a_terminal) {
  run::Result result = result_by_hand();
  result.cases[0].assigner_label = "sphere-refinement(spot=narrowing)";
  result.cases[0].timing->frame_ns.median = 123456789.0;
  const std::string table = table_of(result);
  EXPECT_EQ(line_with(table, "sphere-refinement").size(), line_with(table, "aabb ").size());
  const std::string heads = line_with(table, "frame us");
  EXPECT_EQ(heads.size(), line_with(table, "aabb ").size() + 1) << "± has two bytes";
  for (const std::string& line : lines_of(table)) EXPECT_LE(line.size(), line == heads ? 146u : 145u) << line;
}

TEST(Table, what_was_not_measured_has_no_column_or_a_dash) {
  run::Result result = result_by_hand();
  result.cases[0].timing.reset();
  const auto line = words(line_with(table_of(result), "brute-force "));
  EXPECT_EQ(std::count(line.begin(), line.end(), "-"), 6) << "frame, +-, worst, assign, convert and ns/pair";
  result.cases[1].timing.reset();
  const std::string untimed = table_of(result);
  EXPECT_EQ(untimed.find("frame us"), std::string::npos) << untimed;
  EXPECT_EQ(words(line_with(untimed, "aabb ")).at(2), "30") << "pairs of all frames";
}

TEST(Table, marks_have_a_legend_that_says_what_was_measured) {
  run::Result result = result_by_hand();
  EXPECT_NE(
      table_of(result).find("at most 0.1 % unlit, and no other case of its camera is better in one of time, bytes "
                            "and overshade and as good in the rest.\nTimes that are not known to differ count "
                            "as equal.\n"),
      std::string::npos);
  EXPECT_EQ(table_of(result).find("-: not measured"), std::string::npos);
  for (run::CaseResult& case_result : result.cases) case_result.timing.reset();
  const std::string untimed = table_of(result);
  EXPECT_NE(untimed.find("\n  * "), std::string::npos) << untimed;
  EXPECT_NE(untimed.find("is better in one of bytes and overshade and as good in the rest.\n"), std::string::npos)
      << untimed;
  EXPECT_EQ(untimed.find("frame: time"), std::string::npos) << untimed;
}

TEST(Table, cases_are_ranked_by_what_a_frame_takes) {
  run::Result result = result_by_hand();
  result.cases[1].timing->frame_ns.median = 20000.0;  // though its assignment is the fastest
  const std::string table = table_of(result);
  EXPECT_LT(table.find("brute-force "), table.find("aabb "));
}

TEST(Table, builds_have_a_column_where_frames_need_them) {
  run::Result result = result_by_hand();
  EXPECT_EQ(table_of(result).find("build"), std::string::npos);
  result.cases[0].timing->builds_per_frame = 1.0;
  EXPECT_NE(line_with(table_of(result), "frame us").find("build"), std::string::npos);
}

TEST(Table, unlit_lights_have_a_column_and_a_warning_with_the_worst_frame) {
  run::Result result = result_by_hand();
  for (run::CaseResult& case_result : result.cases) {
    case_result.shading->missed = 50;
    case_result.shading->missed_outside = 40;
    case_result.shading->lost_lux = 44.0;
    case_result.shading->total_lux = 100.0;
    case_result.shading->worst = {1, 30, 90};
  }
  const std::string table = table_of(result);
  EXPECT_NE(line_with(table, "aabb ").find("25.0 %          -"), std::string::npos) << "no overshade\n" << table;
  EXPECT_NE(table.find("warning: hall/walk/frustum 64px/brute-force/packed and 1 more case: 25 % of the lights that "
                       "random points in the view need are unlit, 44 % of the irradiance: 10 in cells, 40 outside of "
                       "the grid; most in "
                       "frame 1, 30 of 90"),
            std::string::npos)
      << table;
  EXPECT_EQ(table.find("*"), std::string::npos) << "no star\n" << table;
  result.cases[0].shading->needed = result.cases[1].shading->needed = 1000000;
  const std::string rounding = table_of(result);
  EXPECT_NE(line_with(rounding, "aabb ").find("<0.01 %"), std::string::npos) << rounding;
  EXPECT_EQ(rounding.find("warning"), std::string::npos) << rounding;
}

TEST(Table, dropped_pairs_have_a_column_and_no_star) {
  run::Result result = result_by_hand();
  EXPECT_EQ(table_of(result).find("dropped"), std::string::npos);
  result.cases[1].buffers.dropped_pairs = 7;
  const std::string table = table_of(result);
  EXPECT_NE(line_with(table, "frame us").find("dropped"), std::string::npos) << table;
  EXPECT_EQ(words(line_with(table, "aabb ")).front(), "aabb") << table;
  EXPECT_EQ(words(line_with(table, "brute-force ")).front(), "*") << table;
}

TEST(Table, what_dropped_lights_would_have_brought_stands_beside_them) {
  run::Result result = result_by_hand();
  EXPECT_EQ(table_of(result).find("lost lx"), std::string::npos);
  result.cases[1].buffers.dropped_pairs = 7;
  result.cases[1].shading->lost_lux = 250.0;  // of 100 samples
  result.cases[1].shading->darkest = {1, 4.0f, 5.0f, 40.0};
  std::string table = table_of(result);
  EXPECT_NE(line_with(table, "frame us").find("dropped  lost lx  worst lx"), std::string::npos) << table;
  EXPECT_NE(line_with(table, "aabb ").find("7      2.5        40"), std::string::npos) << table;
  // Of visible surfaces, where they are asked for.
  run::SampleSetResult opaque{measure::SampleSet::opaque, *result.cases[1].shading, {}};
  opaque.counts.lost_lux = 300.0;
  result.cases[1].samples = {opaque};
  table = table_of(result);
  EXPECT_NE(line_with(table, "aabb ").find("7        3        40"), std::string::npos) << table;
}

TEST(Table, numbers_and_words_agree) {
  const std::string table = table_of(result_by_hand());
  EXPECT_NE(table.find("(9 points, 1 spot, 2 frames)"), std::string::npos) << table;
  EXPECT_NE(table.find("\n1 combination of grid, method and storage left out"), std::string::npos) << table;
}

TEST(Table, methods_that_cannot_run_here_are_told_however_many_other_combinations_are_left_out) {
  run::Result result = result_by_hand();
  for (const char* storage : {"packed", "fixed"})
    result.skipped.push_back({std::string("hall/walk/16x9/mine/") + storage, "mine cannot run here: no driver", {}});
  const std::string table = table_of(result);
  EXPECT_NE(table.find("\n3 combinations of grid, method and storage left out"), std::string::npos) << table;
  EXPECT_NE(table.find("\nwarning: mine cannot run here: no driver (2 combinations)\n"), std::string::npos) << table;
}

TEST(Table, instructions_have_a_column_only_where_they_were_counted) {
  run::Result result = result_by_hand();
  EXPECT_EQ(table_of(result).find("instr"), std::string::npos);
  add_count(result.cases[1]);
  const std::string table = table_of(result);
  EXPECT_NE(line_with(table, "frame us").find("convert  instr  pairs"), std::string::npos) << table;
  EXPECT_EQ(words(line_with(table, "aabb ")).at(9), "20.0k");
  EXPECT_EQ(words(line_with(table, "brute-force ")).at(8), "-");
  EXPECT_NE(table.find("counted by callgrind (AVX2)"), std::string::npos) << table;
  for (const std::string& line : lines_of(table)) EXPECT_LE(line.size(), 132u) << line;
}

TEST(Table, without_times_the_fewest_instructions_come_first) {
  run::Result result = result_by_hand();
  for (run::CaseResult& case_result : result.cases) {
    case_result.timing.reset();
    add_count(case_result);
    case_result.error->false_positives = case_result.assigner == "aabb" ? 40 : 1;
  }
  result.cases[0].count->assign.instructions = 90000;
  const std::string table = table_of(result);
  EXPECT_LT(table.find("aabb "), table.find("brute-force "));
}

TEST(Table, without_colour_there_is_no_escape) {
  run::Result result = result_by_hand();
  lose_a_light(result.cases[0]);
  EXPECT_EQ(table_of(result).find('\033'), std::string::npos);
}

TEST(Table, failures_are_red) {
  run::Result result = result_by_hand();
  lose_a_light(result.cases[0]);
  result.cases[1].exact = true;  // and has false positives
  const std::string table = table_of(judged(result), true);
  EXPECT_NE(table.find("\033[31m    brute-force"), std::string::npos) << table;
  EXPECT_NE(table.find("\033[31m    aabb"), std::string::npos) << table;
}

TEST(Table, a_name_in_a_scene_file_cannot_speak_to_the_terminal) {
  run::Result result = result_by_hand();
  result.cases[0].camera = "\033[2Jgone\nand a line";
  result.scenes[0].warnings = {"light '\033]0;title\a' is black"};
  const std::string table = table_of(result);
  EXPECT_EQ(table.find_first_of("\033\a"), std::string::npos);
  EXPECT_NE(table.find("gone?and a line"), std::string::npos);
}

TEST(Table, overflow_undecided_pairs_made_ranges_and_skipped_cases_are_said) {
  run::Result result = result_by_hand();
  result.cases[0].buffers.dropped_pairs = 7;
  result.cases[0].error->undecided = 2;
  result.scenes[0].range_rule["from_intensity"] = 4;
  const std::string table = table_of(result);
  EXPECT_NE(table.find("7 pairs dropped"), std::string::npos);
  EXPECT_NE(table.find("2 undecided pairs counted as true"), std::string::npos);
  EXPECT_NE(table.find("4 lights have no range"), std::string::npos);
  EXPECT_NE(table.find("1 combination"), std::string::npos);
}

TEST(Table, stability_follows_the_main_table_with_the_truth_and_each_assigner_once) {
  run::Result result = result_by_hand();
  EXPECT_EQ(table_of(result).find("stability"), std::string::npos);
  for (run::CaseResult& case_result : result.cases) add_stability(case_result);
  result.cases[1].stability->method.changes = 18;
  result.cases.push_back(result.cases[0]);
  result.cases.back().id = "other storage";
  result.cases.back().storage_label = "fixed(cap=8)";
  result.planned_ids.emplace_back("other storage");
  const std::string table = table_of(result), part = table.substr(table.find("stability of hall"));
  EXPECT_EQ(words(line_with(part, "(truth)")), (std::vector<std::string>{"(truth)", "1.60", "4", "2"}));
  EXPECT_EQ(words(line_with(part, "aabb ")), (std::vector<std::string>{"aabb", "1.80", "9", "12.5", "%", "3", "+1"}));
  EXPECT_LT(part.find("aabb "), part.find("brute-force ")) << "the fewest changes first";
  EXPECT_EQ(part.find("brute-force "), part.rfind("brute-force ")) << "once, whatever its lists are stored in";
  EXPECT_NE(part.find("at most 1 mm and 0.01 degrees"), std::string::npos);
  EXPECT_NE(part.find("within 8 steps"), std::string::npos);
  for (const std::string& line : lines_of(part)) EXPECT_LE(line.size(), 100u) << line;
}

TEST(Table, a_made_drift_and_a_grid_that_moves_are_said) {
  run::Result result = result_by_hand();
  add_stability(result.cases[0]);
  result.cases[0].stability->is_drift = true;
  result.cases[0].stability->path = "standing camera, made to drift";
  result.cases[0].stability->grids = 11;
  result.cases[0].stability->undecided = 5;
  const std::string table = table_of(result);
  EXPECT_NE(table.find("standing camera, made to drift\n"), std::string::npos);
  EXPECT_NE(table.find("cells themselves move"), std::string::npos);
  EXPECT_NE(table.find("stability: 5 undecided pairs"), std::string::npos);
}

// Each case in float32, half and half inflated; half loses 3 pairs and has 29 a frame, inflated it has 33.
run::Result in_three_precisions() {
  run::Result result = result_by_hand();
  const std::vector<run::CaseResult> plain = result.cases;
  result.cases.clear();
  result.planned_ids.clear();
  for (const run::CaseResult& case_result : plain)
    for (const auto& [packing, inflate] : {std::pair{"float32", false}, {"half", false}, {"half", true}}) {
      run::CaseResult& added = result.cases.emplace_back(case_result);
      add_precision(added, packing, inflate);
      if (added.precision->packing == "half") added.occupancy->pairs.mean = inflate ? 33.0 : 29.0;
      if (added.precision->label == "half") lose_a_light(added);
      added.conservative = added.precision->label != "half";
      result.planned_ids.push_back(added.id);
    }
  return result;
}

TEST(Table, precision_follows_the_main_table_with_what_is_lost_and_what_inflation_adds) {
  EXPECT_EQ(table_of(result_by_hand()).find("precision"), std::string::npos);
  run::Result result = in_three_precisions();
  result.cases.push_back(result.cases[1]);
  result.cases.back().id = "other storage";
  result.planned_ids.emplace_back("other storage");
  const std::string table = table_of(result), part = table.substr(table.find("precision of hall"));
  EXPECT_EQ(words(line_with(table, "aabb half+inflate ")).at(2), "half+inflate") << "named in the main table";
  EXPECT_NE(part.find("half: positions are off by 0.001 m, at most 0.02 m; safe inflation 0.004 m, at most 0.08 m"),
            std::string::npos);
  EXPECT_EQ(words(line_with(part, "aabb   ")),
            (std::vector<std::string>{"aabb", "float32", "0", "-", "30", "+0.00", "%"}));
  std::vector<std::string> halves;
  for (const std::string& line : lines_of(part))
    if (line.find(" half ") != std::string::npos) halves.push_back(line);
  ASSERT_EQ(halves.size(), 2u) << "once, whatever its lists are stored in";
  EXPECT_EQ(words(halves[1]), (std::vector<std::string>{"aabb", "half", "3", "12.5", "%", "29", "-3.33", "%"}));
  EXPECT_EQ(words(line_with(part, "half+inflate")),
            (std::vector<std::string>{"brute-force", "half+inflate", "0", "-", "33", "+10.00", "%"}));
  for (const std::string& line : lines_of(part)) EXPECT_LE(line.size(), 100u) << line;
}

TEST(Table, what_the_lookup_misses_is_told_of_each_structure_that_misses_otherwise) {
  run::Result result = result_by_hand();
  run::CaseResult own = result.cases[1], dropping = own, alike = own;
  own.id = "own";
  own.storage_label = "own";
  dropping.id = "dropping";
  dropping.storage_label = "fixed(cap=1)";
  alike.id = "alike";
  alike.storage_label = "bitfield";
  const auto add = [&](run::CaseResult case_result, std::uint64_t missed) {
    case_result.lookup = {{{}, 100, 200, missed, missed, 0}};
    result.cases.push_back(case_result);
    result.planned_ids.push_back(case_result.id);
  };
  run::CaseResult listed = own;
  listed.id = "listed";
  listed.storage_label = "packed";
  add(listed, 0);
  add(own, 2);
  add(dropping, 20);
  add(alike, 0);
  const std::string table = table_of(result), part = table.substr(table.find("lookup on hall"));
  EXPECT_EQ(words(line_with(part, "aabb / packed")).at(3), "0.0000") << part;
  EXPECT_EQ(words(line_with(part, "aabb / no lists")).at(4), "1.0000") << part;
  EXPECT_EQ(words(line_with(part, "aabb / fixed(cap=1)")).at(3), "10.0000") << part;
  EXPECT_EQ(part.find("bitfield"), std::string::npos) << "as the packed lists\n" << part;
}

TEST(Table, a_structure_of_its_own_has_a_line_of_its_own_among_precisions) {
  run::Result result = in_three_precisions();
  run::CaseResult own = result.cases[1];
  own.id = "own";
  own.storage_label = "own";
  own.occupancy.reset();
  own.error.reset();
  result.cases.push_back(own);
  result.planned_ids.push_back(own.id);
  const std::string table = table_of(result), part = table.substr(table.find("precision of hall"));
  EXPECT_EQ(words(line_with(part, "brute-force / no lists")),
            (std::vector<std::string>{"brute-force", "/", "no", "lists", "half", "-", "-", "-", "-"}))
      << part;
  EXPECT_NE(line_with(part, "brute-force / packed"), "") << part;
}

TEST(Table, lights_that_a_format_cannot_hold_are_told) {
  run::Result result = in_three_precisions();
  EXPECT_EQ(table_of(result).find("cannot hold"), std::string::npos);
  for (run::CaseResult& case_result : result.cases) case_result.precision->loss.unrepresentable_lights = 7;
  for (run::CaseResult& case_result : result.cases) case_result.precision->loss.unrepresentable_frames = 2;
  const std::string table = table_of(result);
  const std::size_t told = table.find("half cannot hold up to 7 lights in 2 frames");
  EXPECT_NE(told, std::string::npos);
  EXPECT_EQ(table.find("cannot hold", told + 8), std::string::npos) << "once for each packing";
  for (const std::string& line : lines_of(table)) EXPECT_LE(line.size(), 132u) << line;
}

TEST(Table, stability_names_precisions_apart) {
  run::Result result = in_three_precisions();
  for (run::CaseResult& case_result : result.cases) add_stability(case_result);
  const std::string table = table_of(result), part = table.substr(table.find("stability of hall"));
  EXPECT_NE(line_with(part, "aabb half+inflate "), "");
  EXPECT_NE(line_with(part, "brute-force half "), "");
}

TEST(Table, storages_are_named_where_there_are_several) {
  run::Result result = result_by_hand();
  EXPECT_EQ(table_of(result).find("/ packed"), std::string::npos);
  result.cases[0].storage_label = "fixed(cap=8)";
  EXPECT_NE(table_of(result).find("brute-force / fixed(cap=8)"), std::string::npos);
}

TEST(Table, sets_of_samples_have_a_table_with_what_they_need_and_where_nothing_answers) {
  run::Result result = result_by_hand();
  EXPECT_EQ(table_of(result).find("lights per sample"), std::string::npos);
  for (run::CaseResult& case_result : result.cases) {
    measure::ShadingCounts opaque{.samples = 100, .evaluated = 250, .needed = 200};
    opaque.missed = case_result.assigner == "aabb" ? 5 : 0;
    measure::ShadingCounts mirror{.samples = 100, .needed = 40, .missed = 40};
    mirror.unanswered = 100;
    case_result.samples = {{measure::SampleSet::opaque, opaque, {}},
                           {measure::SampleSet::mirror, mirror, {}},
                           {measure::SampleSet::transparent, {}, {}}};
  }
  const std::string table = table_of(result), samples = table.substr(table.find("lights per sample of hall"));
  EXPECT_NE(line_with(samples, "(needed)").find("2.00"), std::string::npos) << samples;
  EXPECT_NE(line_with(samples, "aabb").find("2.50, 2.5 % unlit         none  no answer"), std::string::npos) << samples;
}

// Methods that need depth have no points of the whole view; a set that only some have stands under its own heading.
TEST(Table, a_set_of_samples_that_some_cases_lack_shifts_no_figure) {
  for (const bool is_depth_first : {false, true}) {
    run::Result result = result_by_hand();
    for (run::CaseResult& one : result.cases) {
      const bool is_tiled = (one.assigner == "aabb") == is_depth_first;
      one.shading = measure::ShadingCounts{.samples = 100, .evaluated = 111, .needed = 100};
      if (is_tiled) one.shading.reset();
      one.samples = {
          {measure::SampleSet::opaque, {.samples = 100, .evaluated = is_tiled ? 222U : 333U, .needed = 200}, {}}};
      if (!is_tiled)
        one.samples.push_back({measure::SampleSet::fog, {.samples = 100, .evaluated = 444, .needed = 300}, {}});
    }
    const std::string table = table_of(result), samples = table.substr(table.find("lights per sample of hall"));
    using Words = std::vector<std::string>;
    EXPECT_EQ(words(line_with(samples, "assigner")), (Words{"assigner", "volume", "opaque", "fog"})) << samples;
    EXPECT_EQ(words(line_with(samples, "(needed)")), (Words{"(needed)", "1.00", "2.00", "3.00"})) << samples;
    const auto figures = [&](const char* method) {
      Words all = words(line_with(samples, method));
      all.erase(all.begin());
      return all;
    };
    EXPECT_EQ(figures(is_depth_first ? "brute-force" : "aabb"), (Words{"1.11", "3.33", "4.44"})) << samples;
    EXPECT_EQ(figures(is_depth_first ? "aabb" : "brute-force"), (Words{"-", "2.22", "-"})) << samples;
  }
}

TEST(Table, a_note_of_thirty_grids_is_printed_once) {
  run::Result result = result_by_hand();
  const run::CaseResult one = result.cases[0];
  for (int grid = 0; grid < 30; ++grid) {
    result.cases.push_back(one);
    result.cases.back().id = "grid " + std::to_string(grid);
    result.cases.back().grid["name"] = "frustum " + std::to_string(grid);
    result.planned_ids.push_back(result.cases.back().id);
    result.cases.back().grid["note"] = "slices end at 50 m, the farthest reach of a light";
  }
  const std::string table = table_of(result), note = "slices end at 50 m";
  const std::size_t at = table.find(note);
  ASSERT_NE(at, std::string::npos) << table;
  EXPECT_EQ(table.find(note, at + 1), std::string::npos) << table;
  EXPECT_NE(table.find("note: hall, frustum 0 and 29 more grids: slices end at 50 m"), std::string::npos) << table;
}

}  // namespace
}  // namespace clusterbench::report
