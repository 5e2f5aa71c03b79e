#include "report/history/history.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "os/locked_file.h"
#include "report/history/history_lines.h"
#include "report/history/history_page.h"
#include "report/page/page_template.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"

namespace clusterbench::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

class History : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  // A result whose fast case takes that long.
  void add(const std::string& commit, double assign_ns, const std::string& cpu = "a processor") {
    run::Result result = testing::result_by_hand();
    result.machine.cpu = cpu;
    result.cases[1] = testing::case_by_hand("fast", "aabb", assign_ns);
    add_to_history(file_, record_of(result, {}), commit);
  }
  // Commits a1, a2, ..., whose times differ by 0.2 % at most.
  void add_many(const std::string& commits, int count, double assign_ns, const std::string& cpu = "a processor") {
    for (int i = 1; i <= count; ++i)
      add(commits + std::to_string(i), assign_ns * (1.0 + 0.001 * (i * 3 % 7 - 3) / 3.0), cpu);
  }
  std::string text() const {
    std::ifstream in(file_);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& text) const { std::ofstream(file_) << text; }
  std::string where_refused() const {
    try {
      read_history(file_);
    } catch (const Error& error) {
      return error.where();
    }
    return "accepted";
  }

  const fs::path folder_ = fs::temp_directory_path() / ("clusterbench_history_" + std::to_string(getpid()));
  const std::string file_ = (folder_ / "history.jsonl").string();
};

const Series& times_of_fast(const std::vector<Series>& all) {
  for (const Series& series : all)
    if (series.figure->exported_as() == "assign_time" && series.case_name.find("/aabb/") != std::string::npos)
      return series;
  throw std::runtime_error("no such series");
}

const Series& bytes_of_fast(const std::vector<Series>& all) {
  for (const Series& series : all)
    if (series.figure->exported_as() == "list_bytes" && series.case_name.find("/aabb/") != std::string::npos)
      return series;
  throw std::runtime_error("no such series");
}

// The hall with that many points; its fast case takes that many bytes.
run::Result hall_with(int points, std::uint64_t bytes) {
  run::Result result = testing::result_by_hand();
  result.scenes[0].points = points;
  result.scenes[0].light_digest = "of " + std::to_string(points);
  result.cases[1].buffers.bytes.high_water = bytes;
  return result;
}

TEST_F(History, fewer_lights_are_told_first_and_are_not_better) {
  add_to_history(file_, record_of(hall_with(9, 232), {}), "a");
  const Addition addition = add_to_history(file_, record_of(hall_with(0, 16), {}), "b");
  EXPECT_EQ(addition.light_changes,
            std::vector<std::string>{"the lights of hall have changed: 9 points, 1 spot, now 1 spot"});
  const std::vector<HistoryEntry> history = read_history(file_);
  const std::vector<std::string> lights = light_changes_in(history);
  EXPECT_EQ(lights, std::vector<std::string>{"at b: " + addition.light_changes[0] +
                                             "; figures from there on are of other lights"});
  const std::string text = history_text(series_of(history, {}), 2, false, {}, lights);
  EXPECT_TRUE(text.starts_with("at b: the lights of hall have changed")) << text;
  EXPECT_NE(text.find("232 to 16, -93.1 %, of other lights"), std::string::npos) << text;
  EXPECT_EQ(text.find("better"), std::string::npos) << text;
}

TEST_F(History, of_the_same_lights_fewer_bytes_are_better) {
  add_to_history(file_, record_of(hall_with(9, 232), {}), "a");
  EXPECT_EQ(add_to_history(file_, record_of(hall_with(9, 200), {}), "b").light_changes, std::vector<std::string>{});
  const std::vector<HistoryEntry> history = read_history(file_);
  EXPECT_EQ(light_changes_in(history), std::vector<std::string>{});
  EXPECT_NE(history_text(series_of(history, {}), 2, false).find("232 to 200, -13.8 %, better"), std::string::npos);
}

// A shorter walk sees less; that is no better clustering.
TEST_F(History, figures_of_another_camera_path_are_neither_better_nor_worse) {
  const auto walk = [](double to_s, const char* digest, std::uint64_t bytes) {
    run::Result result = hall_with(9, bytes);
    for (run::CaseResult& walked : result.cases) walked.camera_path = {0.0, to_s, digest};
    return record_of(result, {});
  };
  add_to_history(file_, walk(15.0, "a", 232), "a");
  const Addition addition = add_to_history(file_, walk(7.5, "b", 200), "b");
  EXPECT_EQ(addition.path_changes,
            std::vector<std::string>{"the path of camera walk in hall has changed: 0 to 15 s, now 0 to 7.5 s"});
  EXPECT_EQ(addition.light_changes, std::vector<std::string>{});
  const std::vector<HistoryEntry> history = read_history(file_);
  EXPECT_EQ(path_changes_in(history), std::vector<std::string>{"at b: " + addition.path_changes[0] +
                                                               "; figures from there on are of other views"});
  const std::string text = history_text(series_of(history, {}), 2, false);
  EXPECT_NE(text.find("232 to 200, -13.8 %, of another camera path"), std::string::npos) << text;
  add_to_history(file_, walk(7.5, "b", 180), "c");
  EXPECT_NE(history_text(series_of(read_history(file_), {}), 3, false).find("200 to 180, -10 %, better"),
            std::string::npos);
}

TEST_F(History, a_job_that_runs_again_is_held_against_the_commit_before) {
  add_to_history(file_, record_of(hall_with(9, 232), {}), "a");
  const result::Result gone = record_of(hall_with(0, 16), {});
  add_to_history(file_, gone, "b");
  EXPECT_EQ(add_to_history(file_, gone, "b").light_changes.size(), 1u);
  EXPECT_EQ(add_to_history(file_, gone, "c").light_changes.size(), 0u);
}

// The hall by another name, with the cases that go with it.
result::Result level(const std::string& name) {
  result::Result result = record_of(hall_with(9, 232), {});
  result.scenes[0].name = name;
  for (result::Case& result_case : result.cases) result_case.scene = name;
  return result;
}

TEST_F(History, a_level_that_is_missing_is_told_once_and_by_its_name) {
  result::Result both = level("hall");
  both.scenes.push_back(level("attic").scenes[0]);
  add_to_history(file_, both, "a");
  const Addition gone = add_to_history(file_, level("hall"), "b");
  EXPECT_EQ(gone.light_changes, std::vector<std::string>{"attic is missing, which a has (9 points, 1 spot)"});
  EXPECT_EQ(add_to_history(file_, level("hall"), "c").light_changes, std::vector<std::string>{});
  EXPECT_EQ(light_changes_in(read_history(file_)), std::vector<std::string>{"at b: " + gone.light_changes[0]});
  const std::string text = history_text({}, 3, false, {}, light_changes_in(read_history(file_)));
  EXPECT_TRUE(text.starts_with("at b: attic is missing, which a has (9 points, 1 spot)\n")) << text;
  EXPECT_EQ(add_to_history(file_, level("attic"), "b").light_changes, std::vector<std::string>{});
  EXPECT_EQ(light_changes_in(read_history(file_)), std::vector<std::string>{}) << "of two results of b, one has it";
}

TEST_F(History, levels_in_results_of_their_own_miss_none_and_new_ones_are_named) {
  add_to_history(file_, level("hall"), "a");
  const Addition other = add_to_history(file_, level("attic"), "a");
  EXPECT_EQ(other.light_changes, std::vector<std::string>{});
  EXPECT_EQ(other.new_scenes, std::vector<std::string>{}) << "the first commit has nothing before it";
  EXPECT_EQ(add_to_history(file_, level("attic"), "b").light_changes, std::vector<std::string>{});
  const Addition renamed = add_to_history(file_, level("loft"), "c");
  EXPECT_EQ(renamed.light_changes, std::vector<std::string>{});
  EXPECT_EQ(renamed.new_scenes, std::vector<std::string>{"loft"});
}

TEST_F(History, times_of_a_device_are_a_series_for_each_device_and_each_kind_of_caches) {
  const auto add_times = [&](const std::string& commit, const std::string& device, bool is_cold) {
    run::Result result = testing::result_by_hand();
    result.machine.cpu = "processor of " + commit;
    run::DeviceTimes times;
    times.device = device;
    times.warm.run_ns.median = 2000.0;
    if (is_cold) times.cold = times.warm;
    for (run::CaseResult& one : result.cases) one.timing.reset();
    result.cases[1].device = times;
    result::Result record = record_of(result, {});
    if (commit == "b") record.config["timing"]["sweep_mib"] = 64;  // of the processor's caches
    add_to_history(file_, record, commit);
  };
  add_times("a", "Card, driver 1", true);
  add_times("b", "Card, driver 1", true);
  add_times("c", "Other card, driver 1", true);
  add_times("d", "Card, driver 1", false);
  std::vector<std::pair<std::string, std::size_t>> found;
  for (const Series& series : series_of(read_history(file_), {}))
    if (series.figure->exported_as() == "device_time") found.emplace_back(series.machine, series.values.size());
  EXPECT_EQ(found,
            (std::vector<std::pair<std::string, std::size_t>>{
                {"Card, driver 1, cold caches", 2}, {"Other card, driver 1, cold caches", 1}, {"Card, driver 1", 1}}));
}

TEST_F(History, lines_of_older_versions_leave_the_lights_open) {
  Json older = Json::parse(R"({"history_version": 1, "commit": "a", "name": "by hand", "cpu": "a processor",
    "simd_target": "scalar", "cases": [{"id": "fast", "name": "hall/walk/frustum 64px/aabb/packed",
    "settings": "settings of aabb", "figures": {"list_bytes": 300}}]})");
  write(older.dump() + "\n");
  EXPECT_EQ(add_to_history(file_, record_of(hall_with(9, 232), {}), "b").light_changes, std::vector<std::string>{});
  const std::string text = history_text(series_of(read_history(file_), {}), 2, false);
  EXPECT_NE(text.find("300 to 232, -22.7 %, perhaps of other lights, which older lines do not tell"), std::string::npos)
      << text;
}

TEST_F(History, a_slower_commit_is_named_with_its_change_and_direction) {
  add_many("a", 7, 3000.0);
  add_many("b", 7, 3300.0);
  const std::vector<Series> all = series_of(read_history(file_), {});
  ASSERT_EQ(times_of_fast(all).changes.size(), 1u);
  const std::string said = history_text(all, 14, false);
  EXPECT_NE(said.find("at b1: 3000 to 3300, +10 %, worse (p 0.0"), std::string::npos) << said;
  EXPECT_EQ(said.find("brute-force"), std::string::npos) << said;
  EXPECT_NE(history_text(all, 14, true).find("brute-force"), std::string::npos);
  EXPECT_NE(history_text(all, 14, true).find("  14 values, all 232\n"), std::string::npos) << "a mark that stays";
  EXPECT_NE(said.find("  14 values, 3000 to 3296.7\n"), std::string::npos) << said;
  EXPECT_NE(said.find("14 results, "), std::string::npos) << said;
  EXPECT_NE(said.find(" series, 1 change of 0.5 % or more\n"), std::string::npos)
      << "the same time per pair is no second one\n"
      << said;
}

TEST_F(History, other_settings_begin_a_series_of_their_own_and_are_told) {
  add_many("a", 7, 3000.0);
  for (const char* commit : {"b1", "b2"}) {
    run::Result result = testing::result_by_hand();
    result.cases[1] = testing::case_by_hand("fast with other samples", "aabb", 9000.0);
    result.cases[1].settings = "others";
    result.planned_ids[1] = result.cases[1].id;
    result.cases[1].buffers.bytes.high_water = 500;
    add_to_history(file_, record_of(result, {}), commit);
  }
  const std::vector<Series> all = series_of(read_history(file_), {});
  EXPECT_EQ(bytes_of_fast(all).values.size(), 7u);
  for (const Series& series : all)
    EXPECT_TRUE(series.changes.empty()) << series.case_name << " " << series.figure->exported_as();
  const std::string said = history_text(all, 9, false);
  EXPECT_NE(said.find("warning: other settings (others), not joined with what was before: "
                      "hall/walk/frustum 64px/aabb/packed from b1 on\n"),
            std::string::npos)
      << said;
  EXPECT_NE(history_text(all, 9, true).find("  other settings than before, from b1 on: a series of its own"),
            std::string::npos);
}

TEST_F(History, a_level_that_changes_goes_on_in_the_same_series) {
  add_many("a", 7, 3000.0);
  for (const char* commit : {"b1", "b2"}) {
    run::Result result = testing::result_by_hand();
    result.cases[1] = testing::case_by_hand("fast of another level", "aabb", 3000.0);
    result.planned_ids[1] = result.cases[1].id;
    result.cases[1].buffers.bytes.high_water = 500;
    add_to_history(file_, record_of(result, {}), commit);
  }
  const std::string said = history_text(series_of(read_history(file_), {}), 9, false);
  EXPECT_NE(said.find("at b1: 232 to 500"), std::string::npos) << said;
  EXPECT_EQ(said.find("other settings"), std::string::npos) << said;
}

// As versions wrote them that did not tell the settings.
TEST_F(History, lines_without_settings_go_on_in_the_series_of_their_name) {
  add_many("a", 3, 3000.0);
  std::string older = text();
  for (std::size_t at; (at = older.find("\"settings\":\"settings of aabb\",")) != std::string::npos;)
    older.erase(at, std::string("\"settings\":\"settings of aabb\",").size());
  ASSERT_EQ(older.find("settings of aabb"), std::string::npos);
  write(older);
  add_many("b", 4, 3000.0);
  const std::vector<Series> all = series_of(read_history(file_), {});
  EXPECT_EQ(times_of_fast(all).values.size(), 7u);
  EXPECT_EQ(history_text(all, 7, false).find("other settings"), std::string::npos);
}

TEST_F(History, series_of_times_that_are_too_short_to_tell_are_counted) {
  add_many("a", 3, 3000.0);
  add_many("b", 3, 3300.0);
  const std::string said = history_text(series_of(read_history(file_), {}), 6, false);
  EXPECT_NE(said.find("0 changes of 0.5 % or more\n4 series of times are too short"), std::string::npos) << said;
}

TEST_F(History, times_of_two_machines_are_two_series_and_counts_are_one) {
  add_many("a", 7, 3000.0);
  add_many("b", 7, 9000.0, "another processor");
  const std::vector<Series> all = series_of(read_history(file_), {});
  EXPECT_EQ(times_of_fast(all).values.size(), 7u);
  EXPECT_EQ(times_of_fast(all).machine, "a processor (family 6, model 85, stepping 7; L1d 32 KiB, L2 1 MiB), scalar");
  EXPECT_EQ(bytes_of_fast(all).values.size(), 14u);
  EXPECT_EQ(bytes_of_fast(all).machine, "");
  for (const Series& series : all) EXPECT_TRUE(series.changes.empty()) << series.machine;
}

TEST_F(History, times_with_cold_caches_do_not_go_on_a_series_of_warm_ones) {
  add_many("a", 7, 3000.0);
  for (int i = 1; i <= 7; ++i) {
    run::Result result = testing::result_by_hand();
    result.machine.cpu = "a processor";
    result.cases[1] = testing::case_by_hand("fast", "aabb", 6000.0 + i);
    result.cases[1].timing->is_cold = true;
    add_to_history(file_, record_of(result, {}), "b" + std::to_string(i));
  }
  const std::vector<Series> all = series_of(read_history(file_), {});
  EXPECT_EQ(times_of_fast(all).values.size(), 7u);
  EXPECT_EQ(bytes_of_fast(all).values.size(), 14u);
}

TEST_F(History, times_after_sweeps_of_another_size_are_a_series_of_their_own) {
  run::Result result = testing::result_by_hand();
  for (run::CaseResult& one : result.cases)
    if (one.timing) one.timing->is_cold = true;
  result::Result record = record_of(result, {});
  add_to_history(file_, record, "a");
  record.config["timing"]["sweep_mib"] = 64;
  for (const char* commit : {"b", "c"}) add_to_history(file_, record, commit);
  std::map<std::string, std::size_t> lengths;
  for (const Series& series : series_of(read_history(file_), {}))
    if (series.figure->exported_as() == "assign_time")
      lengths[series.machine] = std::max(lengths[series.machine], series.values.size());
  ASSERT_EQ(lengths.size(), 2u);
  EXPECT_EQ(lengths.begin()->second, 1u) << lengths.begin()->first;
  EXPECT_NE(lengths.rbegin()->first.find(", cold caches, 64 MiB swept"), std::string::npos) << lengths.rbegin()->first;
  EXPECT_EQ(lengths.rbegin()->second, 2u) << lengths.rbegin()->first;
}

TEST_F(History, counts_change_at_their_first_other_value) {
  run::Result result = testing::result_by_hand();
  add_to_history(file_, record_of(result, {}), "c1");
  result.cases[1].buffers.bytes.high_water += 100;
  add_to_history(file_, record_of(result, {}), "c2");
  const std::string said = history_text(series_of(read_history(file_), {}), 2, false);
  EXPECT_NE(said.find("list_bytes (bytes)\n"), std::string::npos) << said;
  EXPECT_NE(said.find("at c2: 232 to 332, +43.1 %, worse\n"), std::string::npos) << said;
}

TEST_F(History, instructions_change_beyond_what_counting_leaves_open) {
  run::Result result = testing::result_by_hand();
  testing::add_count(result.cases[1]);
  const auto changes = [&](double instructions, const char* source) {
    fs::remove(file_);
    result.cases[1].count->source = source;
    for (const double value : {40000.0, instructions}) {
      result.cases[1].count->assign.instructions = static_cast<std::uint64_t>(value);
      add_to_history(file_, record_of(result, {}), "c");
    }
    std::size_t found = 0;
    for (const Series& series : series_of(read_history(file_), {.min_change = 0.0})) found += series.changes.size();
    return found;
  };
  EXPECT_EQ(changes(40020, "callgrind"), 0u);
  EXPECT_EQ(changes(40080, "callgrind"), 2u) << "of assignment, and of the frame";
  EXPECT_EQ(changes(40080, "perf"), 0u);
  EXPECT_EQ(changes(40800, "perf"), 2u);
}

TEST_F(History, lines_of_the_first_version_are_read_without_their_pair_rates) {
  const std::string line = R"({"history_version": 1, "commit": "c1", "name": "quick", "cpu": "AMD EPYC", "simd_target":
    "AVX2", "cases": [{"id": "i", "name": "n", "figures": {"assign_time": 5, "pair_rate": 7, "list_bytes": 3}}]})";
  write(std::string(line).replace(line.find('\n'), 1, " ") + "\n");
  const std::vector<Series> all = series_of(read_history(file_), {});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].machine, "AMD EPYC, AVX2");
}

TEST_F(History, adding_leaves_the_earlier_lines_as_they_are_and_no_other_file) {
  add("c1", 3000.0);
  const std::string before = text();
  EXPECT_EQ(std::count(before.begin(), before.end(), '\n'), 1);
  add("c2", 3100.0);
  EXPECT_EQ(text().substr(0, before.size()), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(History, the_same_commit_again_stands_beside_itself_and_the_same_result_only_once) {
  for (const char* commit : {"c1", "c2", "c3"}) add(commit, 3000.0);
  const auto again = [&](double assign_ns) {
    run::Result result = testing::result_by_hand();
    result.cases[1] = testing::case_by_hand("fast", "aabb", assign_ns);
    return add_to_history(file_, record_of(result, {}), "c2");
  };
  const std::string before = text();
  EXPECT_FALSE(again(3000.0).is_added);
  EXPECT_EQ(text(), before);
  const Addition addition = again(3100.0);
  EXPECT_TRUE(addition.is_added);
  EXPECT_EQ(addition.earlier, 1u);
  const std::vector<HistoryEntry> history = read_history(file_);
  ASSERT_EQ(history.size(), 4u);
  EXPECT_EQ(history[1].commit + history[2].commit + history[3].commit, "c2c2c3") << "not as the newest";
}

TEST_F(History, blank_lines_are_passed_over_and_stay) {
  for (const char* commit : {"c1", "c2"}) add(commit, 3000.0);
  const std::string lines = text();
  const std::size_t second = lines.find('\n') + 1;
  const std::string edited = "\n" + lines.substr(0, second) + " \r\n\n" + lines.substr(second) + "\n";
  write(edited);
  EXPECT_EQ(read_history(file_).size(), 2u);
  add("c1", 3100.0);
  add("c3", 3000.0);
  std::string commits;
  for (const HistoryEntry& entry : read_history(file_)) commits += entry.commit;
  EXPECT_EQ(commits, "c1c1c2c3");
  EXPECT_TRUE(text().starts_with("\n" + lines.substr(0, second)));
}

TEST_F(History, that_is_held_is_waited_for_and_then_given_up) {
  using namespace std::chrono_literals;
  const os::LockedFile held(file_);
  int told = 0;
  const auto start = std::chrono::steady_clock::now();
  try {
    add_to_history(file_, record_of(testing::result_by_hand(), {}), "c1", {[&] { ++told; }, 100ms, 1s});
    ADD_FAILURE() << "both write";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(file_ + ": is held by another process, still after 1 second;"),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(told, 1);
  EXPECT_GE(std::chrono::steady_clock::now() - start, 1s);
}

TEST_F(History, files_beside_it_stay_as_they_are) {
  add("c1", 3000.0);
  std::ofstream(file_ + ".new") << "another writer's";
  add("c2", 3000.0);
  EXPECT_EQ(read_history(file_).size(), 2u);
  std::ifstream beside(file_ + ".new");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(beside), {}), "another writer's");
}

TEST_F(History, a_link_stays_and_its_target_gets_the_line) {
  const fs::path target = fs::path(folder_) / "shared.jsonl";
  fs::create_symlink("shared.jsonl", file_);
  for (const std::string commit : {"c1", "c2"}) {  // it is made, and added to
    add(commit, 3000.0);
    EXPECT_TRUE(fs::is_symlink(file_));
    EXPECT_EQ(read_history(target.string()).back().commit, commit);
  }
  EXPECT_EQ(read_history(target.string()).size(), 2u);
}

TEST_F(History, what_is_no_regular_file_is_refused_and_stays) {
  ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
  for (const std::string& path : {file_, std::string("/dev/null"), std::string("/dev/stdout")}) {
    EXPECT_THROW(add_to_history(path, record_of(testing::result_by_hand(), {}), "c1"), Error) << path;
    EXPECT_THROW(read_history(path), Error) << path;
  }
  EXPECT_TRUE(fs::is_fifo(file_));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  fs::remove(file_);
  fs::create_symlink(fs::path(file_).filename(), file_);
  EXPECT_THROW(add("c1", 3000.0), Error) << "a circle";
}

TEST_F(History, a_value_that_is_no_text_list_or_number_is_named) {
  add("c1", 3000.0);
  const Json good = Json::parse(text());
  const auto refusal = [&](const char* pointer, const Json& value) -> std::string {
    Json line = good;
    line[Json::json_pointer(pointer)] = value;
    write(line.dump() + "\n");
    try {
      read_history(file_);
    } catch (const Error& error) {
      return error.where() + ": " + error.message();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal("/cases", nullptr), "line 1: /cases: found null, allowed: a list");
  EXPECT_EQ(refusal("/scenes", nullptr), "line 1: /scenes: found null, allowed: a list");
  EXPECT_EQ(refusal("/cases/0", 7), "line 1: /cases/0: found 7, allowed: an object");
  EXPECT_EQ(refusal("/cases/0/figures", Json::array()), "line 1: /cases/0/figures: found a list, allowed: an object");
  EXPECT_EQ(refusal("/cases/0/figures/x", "2"), "line 1: /cases/0/figures/x: found \"2\", allowed: a number");
  EXPECT_EQ(refusal("/cases/0/name", nullptr), "line 1: /cases/0/name: found null, allowed: a text");
  EXPECT_EQ(refusal("/commit", 3), "line 1: /commit: found 3, allowed: a text");
  EXPECT_EQ(refusal("/counter", nullptr), "line 1: /counter: found null, allowed: a text");
  Json line = good;
  line.erase("cases");
  write(line.dump() + "\n");
  EXPECT_EQ(where_refused(), "line 1");
}

TEST_F(History, a_corrupt_line_is_named_by_its_number) {
  add("c1", 3000.0);
  const std::string good = text();
  write(good + "{\"history_version\": 1, \n");
  EXPECT_EQ(where_refused(), "line 2: byte 23");
  write(good + good + "{}\n");
  EXPECT_EQ(where_refused(), "line 3");
  write(good + good.substr(0, good.size() / 2));  // cut off
  EXPECT_EQ(where_refused(), "line 2");
  write(good + good);
  EXPECT_EQ(where_refused(), "accepted");
}

// A history of years is added to once per commit: its cases, most of its text, are not parsed again each time.
TEST_F(History, adding_reads_the_heads_of_earlier_lines_and_showing_all_of_them) {
  add("c1", 3000.0);
  Json line = Json::parse(text());
  line["cases"][0]["figures"] = "none";
  write(line.dump() + "\n");
  add("c2", 3000.0);
  EXPECT_EQ(where_refused(), "line 1: /cases/0/figures");
  // In another order of keys, as an editor or jq leaves them, a line is read as a whole.
  line.erase("commit");
  line["commit"] = "c1";
  write(line.dump() + "\n");
  EXPECT_THROW(add("c2", 3000.0), Error);
}

TEST_F(History, heads_are_their_lines_without_cases) {
  const auto written = [&](const run::Result& result, const std::string& commit) {
    return written_line(record_of(result, {}), commit);
  };
  run::Result named = hall_with(200, 1000);
  named.scenes[0].name = R"(a","cases":[{"id":1}]})";
  Json moved = Json::parse(written(hall_with(300, 1000), "c"));
  moved.erase("commit");
  moved["commit"] = "c";
  const std::string other_order = moved.dump();
  for (const std::string& line : {written(testing::result_by_hand(), "c1"), written(named, R"(,"cases":[)"),
                                  written(named, "\\\"\n"), other_order}) {
    const HistoryLine stored{line, 1, line.size()};
    const HistoryEntry head = stored.head("f"), whole = stored.whole("f");
    EXPECT_EQ(head.commit, whole.commit);
    EXPECT_EQ(head.machine + head.counter + head.caches + head.device,
              whole.machine + whole.counter + whole.caches + whole.device);
    ASSERT_EQ(head.scenes.size(), whole.scenes.size());
    EXPECT_EQ(head.scenes[0].scene + head.scenes[0].counts, whole.scenes[0].scene + whole.scenes[0].counts);
    EXPECT_EQ(head.cases.empty(), line != other_order) << line.substr(0, 60);
  }
  for (const char* cut :
       {R"({"history_version":1,"commit":"c","cases":[{"id")", R"({"history_version":1,"commit":"c")"})
    EXPECT_THROW((HistoryLine{cut, 1, 0}.head("f")), Error) << cut;
}

TEST_F(History, what_is_no_history_is_not_added_to) {
  write("a letter\n");
  EXPECT_THROW(add("c1", 3000.0), Error);
  EXPECT_EQ(text(), "a letter\n");
}

TEST_F(History, the_page_has_what_varies_with_its_changes_and_names_that_end_no_script) {
  if (!page_obstacle().empty()) GTEST_SKIP() << page_obstacle();
  add_many("a", 7, 3000.0);
  add_many("<b>", 7, 3300.0);
  const std::string page = history_page(series_of(read_history(file_), {}), 14);
  EXPECT_NE(page.find(R"({"entries":14,"count":)"), std::string::npos);
  EXPECT_NE(page.find(R"("metric":"assign_time","unit":"ns","case":"hall)"), std::string::npos);
  EXPECT_NE(page.find(R"("changes":[{"index":7,"text":"\u003cb>1: 3000 to 3300, +10 %, worse","direction":"worse"}])"),
            std::string::npos);
  EXPECT_EQ(page.find("<b>1"), std::string::npos);
  EXPECT_EQ(page.find("list_bytes"), std::string::npos) << "it never changed";
}

}  // namespace
}  // namespace clusterbench::report
