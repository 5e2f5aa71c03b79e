#include "report/history/history.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <thread>

#include "core/error.h"
#include "core/file_text.h"
#include "core/text.h"
#include "os/locked_file.h"
#include "os/output_file.h"
#include "report/history/history_changes.h"
#include "report/history/history_lines.h"

namespace clusterbench::report {
namespace {

namespace fs = std::filesystem;

// Rejects a pipe or a device: later results could not be added to it.
fs::path history_path(const std::string& path) {
  const os::OutputTarget target = os::output_target(path);
  if (target.is_stream) throw Error(path, "", "is no regular file; a history is one");
  return target.path;
}

// Others hold it for a moment, or are stopped and hold it without end.
std::unique_ptr<os::LockedFile> locked_history(const std::string& path, const HistoryWait& wait) {
  constexpr std::chrono::milliseconds k_pause(20);
  const auto start = std::chrono::steady_clock::now();
  for (bool is_told = false;;) {
    try {
      return std::make_unique<os::LockedFile>(history_path(path));
    } catch (const os::FileHeld&) {
      if (std::chrono::steady_clock::now() - start >= wait.longest)
        throw Error(path, "",
                    "is held by another process, still after " +
                        number_of(static_cast<std::uint64_t>(wait.longest.count()), "second") +
                        "; end that process (`fuser FILE` shows it), then add the result again");
    }
    if (!is_told && wait.on_long && std::chrono::steady_clock::now() - start >= wait.until_long) {
      wait.on_long();
      is_told = true;
    }
    std::this_thread::sleep_for(k_pause);
  }
}

// Lines of commits other than the one that is added; their cases are read when they are asked for.
class OtherCommits {
 public:
  explicit OtherCommits(const std::string& path) : path_(path) {}

  void add(const HistoryLine& line, HistoryEntry head) {
    lines_.push_back(line);
    heads_.push_back(std::move(head));
    whole_.emplace_back();
  }
  const std::vector<HistoryEntry>& heads() const { return heads_; }
  std::vector<std::string> changed_paths_by(const HistoryEntry& entry) {
    return changed_paths(
        heads_.size(), [this](std::size_t i) -> const HistoryEntry& { return heads_[i]; },
        [this](std::size_t i) -> const HistoryEntry& { return whole(i); }, entry);
  }
  std::vector<std::string> scenes_new_in(const HistoryEntry& entry) const {
    std::vector<std::string> names;
    if (heads_.empty()) return names;
    for (const HistoryLights& scene : entry.scenes)
      if (std::ranges::none_of(heads_, [&](const HistoryEntry& other) { return lights_of_scene(other, scene.scene); }))
        names.push_back(scene.scene);
    return names;
  }

 private:
  const HistoryEntry& whole(std::size_t i) {
    if (!whole_[i]) whole_[i] = lines_[i].whole(path_);
    return *whole_[i];
  }

  std::string path_;
  std::vector<HistoryLine> lines_;
  std::vector<HistoryEntry> heads_;
  std::vector<std::optional<HistoryEntry>> whole_;
};

}  // namespace

std::vector<HistoryEntry> read_history(const std::string& path) {
  const std::string text = file_text(history_path(path));
  std::vector<HistoryEntry> history;
  for (const HistoryLine& line : history_lines(path, text)) history.push_back(line.whole(path));
  return history;
}

Addition add_to_history(const std::string& path, const result::Result& result, const std::string& commit,
                        const HistoryWait& wait) {
  os::require_folder_of(path);
  const std::unique_ptr<os::LockedFile> file = locked_history(path, wait);
  std::string text = file->text();
  const std::string line = written_line(result, commit);
  const HistoryEntry fresh = HistoryLine{line, 1, 0}.whole(path);

  Addition addition;
  addition.other_names = file->other_names();
  std::size_t insert_at = text.size();
  std::vector<HistoryEntry> all;
  OtherCommits others(path);
  for (const HistoryLine& earlier : history_lines(path, text)) {
    all.push_back(earlier.head(path));
    if (all.back().commit != commit) {
      others.add(earlier, all.back());
      continue;
    }
    ++addition.earlier;
    if (earlier.text == line) addition.is_added = false;
    insert_at = earlier.end;
  }
  addition.path_changes = others.changed_paths_by(fresh);
  addition.light_changes = missing_scenes(others.heads(), all, fresh);
  std::ranges::copy(changed_lights(others.heads(), fresh), std::back_inserter(addition.light_changes));
  addition.new_scenes = others.scenes_new_in(fresh);
  if (!addition.is_added) return addition;
  file->replace(text.insert(insert_at, line + "\n"));
  return addition;
}

}  // namespace clusterbench::report
