#include "report/history/history_changes.h"

#include <algorithm>

#include "report/cases/scene_lights.h"
#include "report/gates/light_gate.h"

namespace clusterbench::report {
namespace {

bool are_other_lights(const HistoryLights& before, const HistoryLights& now) {
  return before.digest.empty() || now.digest.empty() ? before.counts != now.counts : before.digest != now.digest;
}

// "the lights of level have changed: 300 points, now 250 points"
std::string changed_lights_text(const HistoryLights& before, const HistoryLights& now) {
  return "the lights of " + now.scene + " have changed: " +
         (before.counts == now.counts ? "still " + now.counts + ", some of them moved or changed"
                                      : before.counts + ", now " + now.counts);
}

bool has_one_of(const HistoryEntry& entry, const std::vector<HistoryLights>& scenes) {
  return std::ranges::any_of(
      scenes, [&](const HistoryLights& scene) { return lights_of_scene(entry, scene.scene) != nullptr; });
}

const HistoryPath* path_in(const HistoryEntry& entry, const std::string& scene, const std::string& camera) {
  const auto found = std::ranges::find_if(entry.cases, [&](const HistoryEntry::Case& other) {
    return other.scene == scene && other.path.camera == camera && !other.path.digest.empty();
  });
  return found == entry.cases.end() ? nullptr : &found->path;
}

// Lines of older versions do not name their scenes.
bool may_have_scene(const HistoryEntry& head, const std::string& scene) {
  return head.scenes.empty() || lights_of_scene(head, scene) != nullptr;
}

}  // namespace

const HistoryLights* lights_of_scene(const HistoryEntry& entry, const std::string& scene) {
  const auto found = std::ranges::find(entry.scenes, scene, &HistoryLights::scene);
  return found == entry.scenes.end() ? nullptr : &*found;
}

std::vector<std::string> missing_scenes(std::span<const HistoryEntry> before, std::span<const HistoryEntry> all,
                                        const HistoryEntry& entry) {
  const auto is_earlier = [&](const HistoryEntry& other) {
    return other.commit != entry.commit && has_one_of(other, entry.scenes);
  };
  const auto last = std::ranges::find_if(before.rbegin(), before.rend(), is_earlier);
  if (last == before.rend()) return {};
  std::vector<std::string> lines;
  for (const HistoryLights& then : last->scenes) {
    const auto has_it = [&](const HistoryEntry& other) {
      return other.commit == entry.commit && lights_of_scene(other, then.scene) != nullptr;
    };
    if (lights_of_scene(entry, then.scene) == nullptr && std::ranges::none_of(all, has_it))
      lines.push_back(then.scene + " is missing, which " + last->commit + " has (" + then.counts + ")");
  }
  return lines;
}

std::vector<std::string> changed_lights(std::span<const HistoryEntry> before, const HistoryEntry& entry) {
  std::vector<std::string> lines;
  for (const HistoryLights& now : entry.scenes)
    for (auto earlier = before.rbegin(); earlier != before.rend(); ++earlier) {
      const HistoryLights* then = lights_of_scene(*earlier, now.scene);
      if (then == nullptr) continue;
      if (are_other_lights(*then, now)) lines.push_back(changed_lights_text(*then, now));
      break;
    }
  return lines;
}

std::vector<std::string> changed_paths(std::size_t before, const EntryAt& heads, const EntryAt& whole,
                                       const HistoryEntry& entry) {
  std::vector<std::string> lines;
  for (const HistoryEntry::Case& now : entry.cases) {
    if (now.path.digest.empty()) continue;
    const HistoryPath* then = nullptr;
    for (std::size_t i = before; i-- > 0 && then == nullptr;)
      if (may_have_scene(heads(i), now.scene)) then = path_in(whole(i), now.scene, now.path.camera);
    if (then == nullptr || then->digest == now.path.digest) continue;
    const std::string line =
        path_change_text(now.scene, now.path.camera, {then->from_s, then->to_s}, {now.path.from_s, now.path.to_s});
    if (std::ranges::find(lines, line) == lines.end()) lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> light_changes_in(const std::vector<HistoryEntry>& history) {
  std::vector<std::string> lines;
  for (std::size_t i = 1; i < history.size(); ++i) {
    const std::span before = std::span(history).first(i);
    const std::string at = "at " + history[i].commit + ": ";
    for (const std::string& missing : missing_scenes(before, history, history[i])) lines.push_back(at + missing);
    for (const std::string& change : changed_lights(before, history[i]))
      lines.push_back(at + change + "; figures from there on are of other lights");
  }
  return lines;
}

std::vector<std::string> path_changes_in(const std::vector<HistoryEntry>& history) {
  std::vector<std::string> lines;
  const auto entry_at = [&](std::size_t i) -> const HistoryEntry& { return history[i]; };
  for (std::size_t i = 1; i < history.size(); ++i)
    for (const std::string& change : changed_paths(i, entry_at, entry_at, history[i]))
      lines.push_back("at " + history[i].commit + ": " + change + "; figures from there on are of other views");
  return lines;
}

}  // namespace clusterbench::report
