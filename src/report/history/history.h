#pragma once
// Results over commits: a file of JSON lines, one per result, with the headline figures of each case.

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "measure/statistics/change_points.h"
#include "report/exports/metrics.h"
#include "result/result.h"

namespace clusterbench::report {

// The lights of a result's scene: see scene_lights.h.
struct HistoryLights {
  std::string scene;
  std::string digest;  // "" in results of older versions
  std::string counts;  // "248 points, 52 spots"
};

// The path of a case; all empty in older versions; `digest` is empty for a generated path.
struct HistoryPath {
  std::string camera, digest;
  double from_s = 0.0, to_s = 0.0;
};

// Whether histories include a figure: the headline, and the figures of gates (docs/ci.md); a figure derived from others
// is not a series.
bool is_kept(const result::Figure& figure);

struct HistoryEntry {
  std::string commit;   // as passed by the user
  std::string machine;  // processor and instruction set
  std::string counter;  // of instructions: "callgrind", "perf"; "" if none, or in an older version
  std::string caches;   // of times: "cold"; "" if warm, or in an older version
  struct Case {
    std::string settings, name;                           // `settings` is "" in lines of older versions
    std::vector<std::pair<std::string, double>> figures;  // by the exported name
    std::string scene = {};                               // "" in lines of older versions
    HistoryPath path = {};
  };
  std::vector<Case> cases;
  std::vector<HistoryLights> scenes = {};  // empty in lines of older versions
  std::string device = {};                 // with its driver, of the device's times; "" without any
  std::string swept = {};  // before cold times of the processor: "64 MiB"; "" if the configuration leaves it open
};

// "at 3f2a: the lights of level have changed: 248 points, 52 spots, now 200 points; figures from there on are of other
// lights" for each result whose lights differ from those of the previous result with the scene, and "at 3f2a: level is
// missing, which 1b90 has" if an earlier commit has a scene beside others of the result and no result of this commit
// does.
std::vector<std::string> light_changes_in(const std::vector<HistoryEntry>& history);
// The same for paths: "at 3f2a: the path of camera walk in level has changed: 0 to 15 s, now 0 to 7.5 s".
std::vector<std::string> path_changes_in(const std::vector<HistoryEntry>& history);

// One figure of one case, in the order of the file.
struct Series {
  std::string case_name;
  std::string settings;        // other settings are another series
  std::string settings_since;  // the first commit with these settings; "" if the case has no earlier ones
  std::string machine;  // and counter: part of the key of a series; "" for counts, which are equal on all machines
  const result::Figure* figure;
  std::vector<std::string> commits;
  std::vector<double> values;
  // The digests of the scene's lights and of the camera's path, for each value; "" if unknown.
  std::vector<std::string> lights, paths;
  bool is_too_short = false;  // too short to separate a change from noise
  std::vector<measure::ChangePoint> changes;
};

// Whether the text of a file begins as a history does.
bool is_history(std::string_view text);

// Throws Error, with the line, for a line that is not an entry of a history, including an unfinished last line.
std::vector<HistoryEntry> read_history(const std::string& path);

struct Addition {
  bool is_added = true;     // false: the same line already existed, and the file was not changed
  std::size_t earlier = 0;  // existing lines of this commit
  // As light_changes_in(), compared with the last lines of other commits.
  std::vector<std::string> light_changes = {};
  std::vector<std::string> path_changes = {};
  std::vector<std::string> new_scenes = {};  // in no line of another commit, if there are such lines
  std::uint64_t other_names = 0;             // hard links of the file, which keep the old contents
};

// While another process holds the history: calls `on_long` once, after `until_long`, and gives up after `longest`.
struct HistoryWait {
  std::function<void()> on_long = {};
  std::chrono::milliseconds until_long = std::chrono::seconds(1);
  std::chrono::seconds longest = std::chrono::minutes(1);
};

// Adds the result as the file's last line, or after those of its commit if a job runs again; creates the file if
// necessary. One process at a time: others wait. The file (or the target of a link) is replaced atomically by a
// complete one, so a crash cannot leave a partial file. Throws Error for a file that is not a history, and on a failed
// write.
Addition add_to_history(const std::string& path, const result::Result& result, const std::string& commit,
                        const HistoryWait& wait = {});

// By case in order of first appearance, then by figure, without figures that repeat another in a different form; the
// changes found by `rule`.
std::vector<Series> series_of(const std::vector<HistoryEntry>& history, const measure::ChangeRule& rule);

// Changes of lights, then series with changes, or all of them, and a line of totals.
std::string history_text(const std::vector<Series>& series, std::size_t entries, bool all,
                         const measure::ChangeRule& rule = {}, const std::vector<std::string>& light_changes = {});

// "better", "worse", or "" if the figure has no direction, or if lights or camera path differ.
std::string direction(const Series& series, const measure::ChangePoint& change);
// That direction in words; "of other lights" or "of another camera path" if that is why there is none.
std::string direction_text(const Series& series, const measure::ChangePoint& change);

// "+3.3 %"; "from 0" if the value before is 0.
std::string change_text(const measure::ChangePoint& change);
// A figure of any unit, five digits.
std::string figure_text(double value);

}  // namespace clusterbench::report
