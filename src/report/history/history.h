#pragma once
// Results over commits: a file of JSON lines, one per result, with the headline figures of each case.

#include <string>
#include <vector>

#include "measure/statistics/change_points.h"
#include "report/exports/metrics.h"
#include "result/result.h"

namespace clusterbench::report {

// Which lights a result's scene has: scene_lights.h.
struct SceneLights {
  std::string scene;
  std::string digest;  // "" in results of older versions
  std::string counts;  // "248 points, 52 spots"
};

// Along which a case was measured; of older versions all is empty, of a path that was made the digest.
struct CameraPath {
  std::string camera, digest;
  double from_s = 0.0, to_s = 0.0;
};

// Whether histories have a figure: the headline, and the figures of gates (docs/ci.md); one that follows from others is
// no series.
bool is_kept(const result::Figure& figure);

struct HistoryEntry {
  std::string commit;   // as it was given
  std::string machine;  // processor and instruction set
  std::string counter;  // of instructions: "callgrind", "perf"; "" if none, or of an older version
  std::string caches;   // of times: "cold"; "" if warm, or of an older version
  struct Case {
    std::string settings, name;                           // the first is "" in lines of older versions
    std::vector<std::pair<std::string, double>> figures;  // by the exported name
    std::string scene = {};                               // "" in lines of older versions
    CameraPath path = {};
  };
  std::vector<Case> cases;
  std::vector<SceneLights> scenes = {};  // none in lines of older versions
};

// "at 3f2a: the lights of level have changed: 248 points, 52 spots, now 200 points; figures from there on are of other
// lights" for each result whose lights are not those of the one before it that has the scene, and "at 3f2a: level is
// missing, which 1b90 has" where an earlier commit has a scene beside others of the result and no result of this commit
// does.
std::vector<std::string> light_changes_in(const std::vector<HistoryEntry>& history);
// "at 3f2a: the path of camera walk in level has changed: 0 to 15 s, now 0 to 7.5 s", likewise.
std::vector<std::string> path_changes_in(const std::vector<HistoryEntry>& history);

// One figure of one case, in the order of the file.
struct Series {
  std::string case_name;
  std::string settings;        // others are another series
  std::string settings_since;  // the commit from which on the case has these settings; "" if it has no others before
  std::string machine;         // and counter: two of them are two series; "" for what is counted, the same on all
  const result::Figure* figure;
  std::vector<std::string> commits;
  std::vector<double> values;
  // The digests of the scene's lights and of the camera's path, for each value; "" where it is not known.
  std::vector<std::string> lights, paths;
  bool is_too_short = false;  // for any change to be told from noise
  std::vector<measure::ChangePoint> changes;
};

// Throws Error with the line for what is not a line of a history, an unfinished last line included.
std::vector<HistoryEntry> read_history(const std::string& path);

struct Addition {
  bool is_added = true;     // false: the same line is there already, and nothing was written
  std::size_t earlier = 0;  // lines of this commit that were there
  // Like light_changes_in(): against the last lines of other commits.
  std::vector<std::string> light_changes = {};
  std::vector<std::string> path_changes = {};
  std::vector<std::string> new_scenes = {};  // that no line of another commit has, where there are such lines
  std::uint64_t other_names = 0;             // hard links of the file, which stay as they were
};
// Adds the result as the file's last line, or behind those of its commit where a job runs again; makes the file if
// there is none. One process at a time: others wait. The file, or the one that a link leads to, is replaced at once by
// one that has all lines, so that no crash can leave half of one. Throws Error for a file that is no history, and on a
// failed write.
Addition add_to_history(const std::string& path, const result::Result& result, const std::string& commit);

// By case in order of first appearance, then by figure, without those that say another in another way; the changes
// found by `rule`.
std::vector<Series> series_of(const std::vector<HistoryEntry>& history, const measure::ChangeRule& rule);

// What has happened to lights, series with changes, or all of them, and a line of totals.
std::string history_text(const std::vector<Series>& series, std::size_t entries, bool all,
                         const measure::ChangeRule& rule = {}, const std::vector<std::string>& light_changes = {});

// "better", "worse", or "" where the figure has no direction. A figure of other lights or another camera path is
// neither.
std::string direction(const Series& series, const measure::ChangePoint& change);
// That direction in words, "of other lights", "of another camera path" where this is why there is none.
std::string direction_text(const Series& series, const measure::ChangePoint& change);

// "+3.3 %"; from nothing: "from 0".
std::string change_text(const measure::ChangePoint& change);
// A figure of any unit, five digits.
std::string figure_text(double value);

}  // namespace clusterbench::report
