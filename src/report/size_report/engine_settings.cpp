#include "report/size_report/engine_settings.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>

#include "config/presets/preset_library.h"
#include "core/error.h"
#include "core/text.h"
#include "report/cases/columns.h"
#include "report/size_report/engine_limits.h"
#include "report/sizing/found_frames.h"
#include "report/sizing/size_words.h"

namespace clusterbench::report {
namespace {

const char* unit_of(Needed needed) {
  switch (needed) {
    case Needed::lights_in_view:
      return "lights in view";
    case Needed::lights_of_type:
      return "lights of one type in view";
    case Needed::lights_in_scene:
      return "lights in the scene";
    case Needed::longest_list:
      return "lights in the longest list";
    case Needed::entries_per_cell:
      return "entries per cell on average";
    case Needed::entries:
      break;
  }
  return "entries in all lists";
}

// The call or member with the requested grid: if tiles grew, as before.
std::string filled_in(const char* call, const SizedStructure& structure) {
  const result::Grid& grid = structure.cases.front()->grid;
  result::Counts3 cells = grid.cells;
  if (!structure.grown.empty())
    for (std::size_t axis = 0; axis < 2; ++axis)
      cells[axis] = static_cast<std::uint64_t>(structure.grown.front().asked[axis]);
  std::string out = call;
  const auto put = [&](const std::string& letter, const std::string& value) {
    for (std::size_t at = 0; (at = out.find(letter, at)) != std::string::npos; at += value.size()) {
      const bool is_alone = (at == 0 || std::isalnum(static_cast<unsigned char>(out[at - 1])) == 0) &&
                            (at + 1 == out.size() || std::isalnum(static_cast<unsigned char>(out[at + 1])) == 0);
      if (is_alone) out.replace(at, 1, value);
    }
  };
  const char* letters[] = {"X", "Y", "Z"};
  for (std::size_t axis = 0; axis < 3; ++axis) put(letters[axis], std::to_string(cells[axis]));
  if (grid.tiles && grid.tiles->pixels) put("P", std::to_string((*grid.tiles->pixels)[0]));
  return out;
}

std::string grid_text(const EngineRow& row, const SizedStructure& structure, bool is_changed) {
  if (*row.grid == '\0' || is_changed) return filled_in(row.grid, structure);
  return *row.own_grid == '\0' ? filled_in(row.grid, structure) + " (the grid that the engine comes with)"
                               : filled_in(row.own_grid, structure);
}

std::string tiles_text(const std::array<int, 2>& tiles) {
  return std::to_string(tiles[0]) + "x" + std::to_string(tiles[1]);
}

// The value to set, and the engine's default.
std::string value_text(const SettingValue& value) {
  const LimitSetting& setting = *value.setting;
  if (setting.is_constant) return "at most " + std::to_string(setting.most) + ", compiled in";
  const std::string default_value = std::to_string(setting.default_value);
  std::string out = std::to_string(value.value);
  if (value.is_too_much()) return out + ", and that is NOT ENOUGH";
  if (setting.default_value == 0 || value.needed() == 0) return out;
  if (value.needed() > setting.default_value) return out + " (the engine comes with " + default_value + ")";
  return out + " (the engine's own " + default_value + " is enough" +
         (value.wanted > setting.default_value ? " for what was seen, not for the margin)" : ": leave it)");
}

std::string search_text(const SettingValue& value, const SizedStructure& structure) {
  const std::string measure = measure_of(value.setting->needed);
  const FoundFrame* search = structure.search_for(measure);
  if (value.found)
    return std::to_string(*value.found) + " " + unit_of(value.setting->needed) + " in " + tried_text(*search);
  if (search != nullptr) return "not searched: " + search->refusal;
  if (!structure.searches.empty()) return "not looked for: `clusterbench worst-case --measure " + measure + "` does";
  return "not searched (--worst-case)";
}

std::string of_type_text(Needed needed) {
  return needed == Needed::lights_of_type ? ", of the type that has most" : "";
}

// "such a frame loses 44 lights": if the room is smaller than the need by `over`.
std::string lost_text(Needed needed, std::uint64_t over) {
  if (needed == Needed::longest_list) return "the longest list loses " + number_of(over, "light");
  if (needed == Needed::lights_in_scene) return "the scene loses " + number_of(over, "light");
  if (needed == Needed::entries) return "such a frame loses " + std::to_string(over) + " entries";
  if (needed == Needed::entries_per_cell)
    return "such a frame lacks room for about " + std::to_string(over) + " entries per cell";
  return "such a frame loses " + number_of(over, "light") + (needed == Needed::lights_of_type ? " of that type" : "");
}

// Over the paths of all cameras.
GrownTiles together(const std::vector<GrownTiles>& all) {
  GrownTiles sum = all.front();
  for (const GrownTiles& one : std::span(all).subspan(1)) {
    sum.frames += one.frames;
    sum.grown += one.grown;
    sum.over += one.over;
    sum.entries = std::max(sum.entries, one.entries);
    if (one.fewest[0] * one.fewest[1] < sum.fewest[0] * sum.fewest[1]) sum.fewest = one.fewest;
  }
  return sum;
}

// The effect of a limit that makes the engine's tiles grow, if it was measured.
std::optional<GrownTiles> grown_tiles(const SettingValue& value, const SizedStructure& structure) {
  const bool makes_tiles_grow = value.setting->needed == Needed::entries && value.setting->default_value > 0;
  if (!makes_tiles_grow || structure.grown.empty()) return {};
  return together(structure.grown);
}

// The effect of the engine's default on these frames; "" if it is sufficient, or unknown.
std::string own_value_text(const SettingValue& value, const SizedStructure& structure) {
  const LimitSetting& setting = *value.setting;
  const std::string with = "    with its own " + std::to_string(setting.default_value) + ": ";
  if (const std::optional<GrownTiles> tiles = grown_tiles(value, structure)) {
    if (tiles->grown == 0 && tiles->over == 0) return "";
    return with + "tiles grow in " + std::to_string(tiles->grown) + " of " + number_of(tiles->frames, "frame") +
           ", from " + tiles_text(tiles->asked) + " to " + tiles_text(tiles->fewest) + " at most; " +
           (tiles->over == 0
                ? "all frames then fit"
                : number_of(tiles->over, "frame") +
                      " did not fit: tiles were still those of the frame before, or none are large enough") +
           " (" + std::to_string(tiles->entries) + " entries at most in a frame)\n";
  }
  if (setting.default_value == 0 || setting.is_constant || setting.needed == Needed::entries) return "";
  // Beyond the engine's maximum another line reports the same.
  const bool is_told = value.is_too_much() && setting.default_value >= setting.most;
  if (value.needed() <= setting.default_value || is_told) return "";
  return with + lost_text(setting.needed, value.needed() - setting.default_value) + "\n";
}

std::optional<result::WithOwnValue> with_own_value(const SettingValue& value, const SizedStructure& structure) {
  const LimitSetting& setting = *value.setting;
  if (setting.default_value == 0 || setting.is_constant || !value.seen) return {};
  result::WithOwnValue out{.value = setting.default_value};
  if (const std::optional<GrownTiles> tiles = grown_tiles(value, structure)) {
    out.frames = tiles->frames;
    out.frames_with_grown_tiles = tiles->grown;
    out.frames_over = tiles->over;
    out.fewest_tiles = {static_cast<std::uint64_t>(tiles->fewest[0]), static_cast<std::uint64_t>(tiles->fewest[1])};
    out.entries = tiles->entries;
    return out;
  }
  if (setting.needed == Needed::entries) return {};
  out.lost = value.needed() > setting.default_value ? value.needed() - setting.default_value : 0;
  return out;
}

std::string setting_lines(const SettingValue& value, const SizedStructure& structure, const AllocationRules& rules) {
  const LimitSetting& setting = *value.setting;
  std::string out = std::string("  ") + setting.name + ": ";
  if (!value.seen)
    return out + "unknown: the result does not say how many " + unit_of(setting.needed) +
           (is_of_lists(setting.needed) ? " there are without the engine's own limit on lights" : "") +
           "; count anew: clusterbench size LEVEL --engine NAME\n";
  out += value_text(value) + "\n    the most seen: " + std::to_string(*value.seen) + " " + unit_of(setting.needed) +
         " in " + number_of(structure.frames(), "frame") + "\n";
  if (setting.needed != Needed::lights_in_scene)
    out += "    the most found by a search: " + search_text(value, structure) + "\n";
  if (!setting.is_constant)
    out +=
        (value.is_all ? "    all lights of the level" + of_type_text(setting.needed)
                      : "    with the margin: " + std::to_string(value.needed()) + " x " + text("%g", rules.margin)) +
        (setting.multiple > 1 ? ", up to a multiple of " + std::to_string(setting.multiple) : std::string()) +
        (!value.is_too_much() && value.wanted > setting.most
             ? "; the engine takes at most " + std::to_string(setting.most) + ", less room than asked for"
             : "") +
        "\n";
  out += own_value_text(value, structure);
  if (!value.is_too_much()) return out;
  return out + "    TOO MUCH: the engine takes at most " + std::to_string(setting.most) + "; " +
         lost_text(setting.needed, value.needed() - setting.most) + "\n";
}

// Whether the engine's default is smaller than the value to set.
bool is_to_be_set(const SettingValue& value) {
  return !value.setting->is_constant && value.seen && value.value > value.setting->default_value;
}

// Whether the engine has one setting for both. Grids that differ in adjustable settings are alternatives.
bool have_one_setting(const EngineRequest& request, const SizedStructure& a, const SizedStructure& b) {
  const EngineRow& row = *row_of_engine(request.engine);
  return !request.has_changed_grid || grid_text(row, a, true) == grid_text(row, b, true);
}

// Advice on the settings: if frames need more than the engine's maximum, no setting helps.
std::string advice_text(const EngineRequest& request, std::span<const SizedStructure* const> structures) {
  bool is_too_much = false, is_known = true;
  bool is_settable = false;  // to a value other than the engine's default
  bool is_any_enough = false, is_any_to_be_set = request.has_changed_grid;
  for (const SizedStructure* structure : structures)
    for (const LimitSetting& setting : row_of_engine(request.engine)->limits) {
      const SettingValue value = value_of(setting, *structure, request.rules);
      is_too_much |= value.is_too_much();
      is_settable |= !setting.is_constant && value.seen && value.value != setting.default_value;
      is_known &= value.seen.has_value();
      (is_to_be_set(value) ? is_any_to_be_set : is_any_enough) |= !setting.is_constant;
    }
  if (std::ranges::any_of(structures, [](const auto* structure) { return is_sized_from_nothing(*structure); }))
    return "Do not set these values: they hold for frames without lights. Give cameras that see some.\n";
  if (is_too_much && !is_settable)
    return "The engine loses lights where it says TOO MUCH, and has no setting with which it does not: fewer or "
           "smaller "
           "lights, or another clustering; `clusterbench run` with the preset says what pixels lose.\n";
  if (is_too_much)
    return "With these values the engine still loses lights, where it says TOO MUCH: fewer or smaller lights, or "
           "another clustering; `clusterbench run` with the preset says what pixels lose.\n";
  constexpr const char* k_again = "measure again when levels or lights change.\n";
  if (!is_known) return std::string("Set the values that are known; ") + k_again;
  if (!is_any_to_be_set)
    return std::string(
               "Nothing to set: what the engine comes with is enough, and a smaller value would only save "
               "memory; ") +
           k_again;
  const bool has_alternatives = std::ranges::any_of(
      structures, [&](const auto* structure) { return !have_one_setting(request, *structures.front(), *structure); });
  return std::string(has_alternatives ? "Take one of these grids and set its values" : "Set these values") +
         (is_any_enough ? ", and leave those of which the engine's own is enough" : "") + "; " + k_again;
}

// The largest value of all structures that share the setting.
SettingValue value_for_all(const EngineRequest& request, const LimitSetting& setting, const SizedStructure& structure,
                           std::span<const SizedStructure* const> structures) {
  SettingValue most = value_of(setting, structure, request.rules);
  for (const SizedStructure* other : structures)
    if (have_one_setting(request, structure, *other))
      if (const SettingValue value = value_of(setting, *other, request.rules); value.value > most.value) most = value;
  return most;
}

// "Of these 2, which have one setting: maxLightsPerCell 200, the largest"; "" for a single one.
std::string shared_text(const EngineRequest& request, const SizedStructure& first,
                        std::span<const SizedStructure* const> structures) {
  std::vector<const SizedStructure*> sharing;
  std::ranges::copy_if(structures, std::back_inserter(sharing),
                       [&](const auto* other) { return have_one_setting(request, first, *other); });
  if (sharing.size() < 2 || sharing.front() != &first) return "";
  std::string out;
  for (const LimitSetting& setting : row_of_engine(request.engine)->limits)
    if (!setting.is_constant)
      out +=
          "  " + std::string(setting.name) + ": " + value_text(value_for_all(request, setting, first, sharing)) + "\n";
  const std::string grid =
      request.has_changed_grid ? " of " + grid_text(*row_of_engine(request.engine), first, true) : "";
  return "The engine has one setting for all " + std::to_string(sharing.size()) + " above" + grid +
         ", which is the largest:\n" + out;
}

}  // namespace

std::vector<std::string> engines_with_settings() {
  std::vector<std::string> names;
  for (const EngineRow& row : engine_rows()) names.emplace_back(row.preset);
  return names;
}

std::vector<std::string> measures_of_engine(const std::string& name) {
  std::vector<std::string> measures;
  for (const LimitSetting& setting : row_of_engine(name)->limits)
    if (const std::string measure = measure_of(setting.needed);
        !measure.empty() && std::ranges::find(measures, measure) == measures.end())
      measures.push_back(measure);
  return measures;
}

void check_engine(const std::string& name) {
  if (row_of_engine(name) != nullptr) return;
  if (const std::string why = why_nothing_is_set(name); !why.empty())
    throw Error(
        "", "--engine",
        name + " has no setting for it: " + why + "; `clusterbench run --preset " + name + "` says what frames lose");
  const std::vector<std::string> names = engines_with_settings();
  throw Error("", "--engine",
              "'" + name + "' is no engine whose limits can be set" + did_you_mean(name, names) + "; there are " +
                  joined(names));
}

std::string engine_settings_text(const EngineRequest& request, std::span<const SizedStructure* const> structures) {
  const EngineRow& row = *row_of_engine(request.engine);
  const std::string remark = config::find_preset(request.engine)->remark.value_or("");
  std::string out;
  for (const SizedStructure* structure : structures) {
    out += shown(structure->name) + "\n  " + version_text(row) + "\n";
    if (!remark.empty()) out += "  " + remark + "\n";
    if (const std::string grid = grid_text(row, *structure, request.has_changed_grid); !grid.empty())
      out += "  " + grid + "\n";
    for (const LimitSetting& setting : row.limits)
      out += setting_lines(value_of(setting, *structure, request.rules), *structure, request.rules);
    if (const std::string unseen = nothing_seen_text(*structure); !unseen.empty()) out += "  " + unseen + "\n";
    out += std::string("  beyond the limit: ") + row.beyond + "\n";
    for (const std::string& note : grid_notes(*structure)) out += "  grid: " + shown(note) + "\n";
    out += "\n";
  }
  for (const SizedStructure* structure : structures)
    if (const std::string shared = shared_text(request, *structure, structures); !shared.empty()) out += shared + "\n";
  return out + advice_text(request, structures);
}

result::EngineSettings engine_settings_of(const EngineRequest& request, const SizedStructure& structure,
                                          std::span<const SizedStructure* const> structures) {
  const EngineRow& row = *row_of_engine(request.engine);
  result::EngineSettings out{
      .engine = request.engine, .version = version_text(row), .grid = filled_in(row.grid, structure)};
  for (const LimitSetting& setting : row.limits) {
    const SettingValue value = value_of(setting, structure, request.rules);
    result::EngineLimit limit{.name = setting.name,
                              .needed = unit_of(setting.needed),
                              .is_too_much = value.is_too_much(),
                              .with_own_value = with_own_value(value, structure)};
    if (value.seen) limit.seen.emplace(*value.seen);
    if (value.found) limit.found.emplace(*value.found);
    if (const FoundFrame* search = structure.search_for(measure_of(setting.needed)))
      limit.search = size_search(*search);
    if (value.seen && !setting.is_constant && !is_sized_from_nothing(structure)) {
      limit.value.emplace(value.value);
      limit.value_for_all = value_for_all(request, setting, structure, structures).value;
    }
    if (setting.most != k_any) limit.most.emplace(setting.most);
    if (value.is_too_much()) limit.lost = value.needed() - setting.most;
    out.limits.push_back(std::move(limit));
  }
  return out;
}

}  // namespace clusterbench::report
