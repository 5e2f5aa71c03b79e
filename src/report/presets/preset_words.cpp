#include "report/presets/preset_words.h"

#include <algorithm>
#include <cmath>

#include "config/presets/preset_library.h"
#include "core/text.h"
#include "measure/samples/shading.h"
#include "report/cases/case_samples.h"
#include "report/cases/columns.h"
#include "report/cases/contender.h"
#include "report/cases/json_values.h"
#include "report/cases/nothing_seen.h"
#include "result/at.h"
#include "run/grid_facts.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::number;
using result::SampleSet;

std::string name(const RankedPreset& row) {
  return *row.result_case->preset;
}

const config::Preset* preset_of(const RankedPreset& row) {
  return config::find_preset(name(row));
}

std::string percent(double share) {
  return share < 1e-4 ? "less than 0.01 %" : text(share < 0.1 ? "%.2f %%" : "%.0f %%", 100.0 * share);
}

std::string read_size_text(double bytes) {
  if (bytes < 1e3) return text("%.0f B", bytes);
  return bytes < 1e6 ? text("%.3g kB", bytes / 1e3) : text("%.3g MB", bytes / 1e6);
}

std::string milliseconds(double ns) {
  return text("%.3g ms", ns / 1e6);
}

// The reason why entries do not fit into the preset's storage.
std::string shortage(const RankedPreset& row) {
  const config::Preset* preset = preset_of(row);
  if (preset == nullptr) return "";
  if (preset->storage && preset->storage->contains("cap"))
    return " (room for " + number_of(preset->storage->at("cap").get<std::uint64_t>(), "light") +
           " per cell, the first ones of the file: in another order others are lost)";
  return " (its pool of entries is too small)";
}

std::string lost_pairs_text(std::uint64_t lost, const PresetLosses& losses) {
  return number_of(lost, "pair") + " of " + std::to_string(losses.true_pairs);
}

// A method that itself limits lights per cell does not distinguish these losses from those of its test.
std::string full_cells(const Case& result_case) {
  const auto most = number_at(result_case.assigner.params, "/most");
  const auto longest =
      number<&Case::occupancy, &result::Occupancy::lights_per_cell, &result::LightsPerCell::max>(result_case);
  if (!most || !longest || *longest < *most) return "";
  return ", or cells are full (room for " + number_of(static_cast<std::uint64_t>(*most), "light") + " per cell)";
}

// For tiles that react but whose lists still do not fit: the engine has room for them only with storage buffers.
std::string room_text(const RankedPreset& row) {
  const auto& react = row.result_case->react;
  if (!react || react->frames.over == 0 || react->to != "entries") return "";
  return "with storage buffers, where its lists grow, as the figures of its row are; without them there is room for " +
         std::to_string(react->most) + " entries, " + std::to_string(react->frames.over) + " of " +
         number_of(row.result_case->frames, "frame") +
         (react->frames.over == 1 ? " does not fit, and lacks lights" : " do not fit, and lack lights");
}

// The preset's limitations, for users: "the fallback on the CPU, ..."; "" if none are known.
std::string remark_of(const RankedPreset& row) {
  const config::Preset* preset = preset_of(row);
  std::vector<std::string> remarks;
  if (preset != nullptr && preset->remark) remarks.push_back(*preset->remark);
  if (const std::string limit = at_surfaces_text(row.result_case->assigner.name); !limit.empty())
    remarks.push_back(limit);
  return joined(remarks, "; ");
}

// The engine's source was not checked for this preset: no reason to prefer one engine to another.
bool is_from_memory(const RankedPreset& row) {
  const config::Preset* preset = preset_of(row);
  return preset != nullptr && preset->is_from_memory();
}

// Whether the note on its grid, on the end of slices, contains the words.
bool has_note(const RankedPreset& row, const char* words) {
  const auto& note = row.result_case->grid.note;
  return note && note->find(words) != std::string::npos;
}

bool has_slices_without_camera_far(const RankedPreset& row) {
  const auto& slices = row.result_case->grid.slices;
  return slices && slices->boundaries.size() > 2 && has_note(row, run::k_no_far_plane);
}

// For cameras without a far plane: the end of slices that follow it in the engine, and how to set it. "" if costs do
// not depend on it.
std::string far_text(const std::vector<RankedPreset>& rows) {
  std::vector<std::string> by_engine, by_lights;
  for (const RankedPreset& row : rows) {
    if (!has_slices_without_camera_far(row)) continue;
    const double end_m = row.result_case->grid.slices->boundaries.back();
    (has_note(row, run::k_ends_with_lights) ? by_lights : by_engine).push_back(name(row) + text(" at %.4g m", end_m));
  }
  if (by_engine.empty() && by_lights.empty()) return "";
  std::string out = "costs depend on the far plane, which the camera does not have: slices end ";
  if (!by_engine.empty()) out += "with that of the engine's own cameras (" + joined(by_engine) + ")";
  if (!by_lights.empty())
    out += std::string(by_engine.empty() ? "" : " and ") + "with the lights in view (" + joined(by_lights) + ")";
  return out + "; --set 'scenes.*.far=METRES' gives cameras that of your game";
}

// Losses to a limit of lights; "" if no light in view is lost.
std::string limit_loss(const RankedPreset& row) {
  std::string out;
  for (const result::Warning& warning : row.result_case->warnings)
    if (warning.kind == "too_many_lights") out = warning.text;
  if (row.losses.by_limit == 0) return out;
  return out + (out.empty() ? "" : "; ") + "the limit removes " + lost_pairs_text(row.losses.by_limit, row.losses);
}

// Lights and pairs missing in the lists, by cause; visibility at samples is reported separately.
std::vector<std::string> loss_texts(const RankedPreset& row) {
  const Case& result_case = *row.result_case;
  std::vector<std::string> ways;
  if (const std::string limit = limit_loss(row); !limit.empty()) ways.push_back(limit);
  const result::Overflow& overflow = result_case.buffers.overflow;
  if (row.losses.dropped > 0)
    ways.push_back("drops " + number_of(overflow.lights.size(), "light") + " in some cells of " +
                   number_of(overflow.frames, "frame") + shortage(row));
  if (row.losses.by_method > 0)
    ways.push_back("its test misses cells that the light reaches" + full_cells(result_case) + ": " +
                   lost_pairs_text(row.losses.by_method, row.losses));
  if (const double outside = sum_at_samples(result_case, number<&SampleSet::missed_outside>); outside > 0.0)
    ways.push_back(percent(outside / row.losses.needed) + " of the lights that samples need lie beyond its grid");
  return ways;
}

std::string needed_lights_text(const RankedPreset& row) {
  const auto needed = static_cast<std::uint64_t>(row.losses.needed);
  return needed == 0 ? "no light" : "only " + number_of(needed, "light") + ", summed over all samples";
}

std::string sample_word(const RankedPreset& row) {
  return "sample (" + result::words_of_sets(ranking_set_names(*row.result_case)) + ")";
}

// "samples (visible surfaces)".
std::string samples_words(const RankedPreset& row) {
  return "samples (" + result::words_of_sets(ranking_set_names(*row.result_case)) + ")";
}

// Whether there are samples that rank presets.
bool has_samples(const RankedPreset& row) {
  return sum_at_samples(*row.result_case, number<&SampleSet::samples>) > 0.0;
}

// For cases whose samples cannot show whether a loss is visible.
std::string undecided_loss(const RankedPreset& row) {
  if (!has_samples(row))
    return "no sample was taken, so what it loses is counted in pairs of a cell and a light, and not in what is seen";
  if (row.losses.needed == 0.0)
    return "no " + sample_word(row) + " needs a light, so nothing tells whether it loses any that is seen";
  std::string out = "its samples need " + needed_lights_text(row) + ", too few to tell whether ";
  if (row.losses.loses_pairs()) return out + "what it loses is seen";
  if (row.losses.outside > 0.0) {
    const auto& lights = row.result_case->lights_beyond_grid;
    const std::uint64_t beyond = lights ? lights->max : 0;
    return out + "it loses any beyond its grid, which ends before the view does" +
           (beyond > 0 ? " (" + number_of(beyond, "light") + " in view may reach there, in the frame with most)" : "");
  }
  out += "it loses any that is seen";
  return row.losses.is_compared ? out : out + ", and its lists were not compared with the truth";
}

// The losses, and whether they are visible.
std::string light_text(const RankedPreset& row) {
  const std::vector<std::string> ways = loss_texts(row);
  const std::string causes = ways.empty() ? "" : ": " + joined(ways, "; ");
  if (row.standing == PresetStanding::unknown && row.losses.has_few_samples()) return undecided_loss(row) + causes;
  if (row.losses.unlit.value_or(0.0) > 0.0)
    return samples_words(row) + " lack " + percent(*row.losses.unlit) + " of the lights that they need" + causes;
  const std::string room = room_text(row);
  return (ways.empty() ? "loses nothing" : "loses nothing that " + samples_words(row) + " need" + causes) +
         (room.empty() ? "" : (ways.empty() ? " " : "; ") + room);
}

// Lights per sample, reads and upload, without cost.
std::string load_text(const RankedPreset& row) {
  const Case& result_case = *row.result_case;
  std::string out;
  if (const auto lights = mean_at_samples(result_case, number<&SampleSet::evaluated>))
    out = text("%.3g", *lights) +
          text(" lights per sample (%.3g needed)", *mean_at_samples(result_case, number<&SampleSet::needed>));
  const bool is_read_priced = row.frame && row.frame->cost.read_ns > 0.0;
  if (const auto bytes = mean_at_samples(result_case, number<&SampleSet::read_bytes>); bytes && is_read_priced)
    out += ", for which it fetches " + read_size_text(*bytes);
  if (makes_lists_on_gpu(result_case))
    return out + (out.empty() ? "" : "; ") + "nothing to upload: the GPU makes its lists, which is not in its cost";
  const auto upload = number<&Case::buffers, &result::Buffers::upload_bytes, &result::FrameBytes::mean>(result_case);
  return out + (out.empty() || !upload ? "" : ", ") + (upload ? read_size_text(*upload) + " uploaded a frame" : "");
}

// The confidence that the preset does the same as the engine.
std::string evidence_text(const RankedPreset& row) {
  const config::Preset* preset = preset_of(row);
  if (preset == nullptr) return "of another version of this program";
  if (preset->is_from_memory()) return "from memory alone";
  return preset->evidence == "ran" ? "compared with the engine's own code" : "its source was studied, not run";
}

std::string names_text(const std::vector<const RankedPreset*>& rows) {
  std::vector<std::string> names;
  for (const RankedPreset* row : rows) names.push_back(name(*row));
  return joined(names);
}

std::vector<const RankedPreset*> of_standing(const std::vector<RankedPreset>& rows, PresetStanding standing) {
  std::vector<const RankedPreset*> out;
  for (const RankedPreset& row : rows)
    if (row.standing == standing) out.push_back(&row);
  return out;
}

// Why a difference in cost is no reason to choose.
std::string alike_text(const std::vector<const RankedPreset*>& alike) {
  const double least = alike.front()->gpu_ns(), most = alike.back()->gpu_ns();
  const std::string costs = " (" + milliseconds(least) + " to " + milliseconds(most) + " of the GPU a frame)";
  if (most <= measure::k_alike_ratio * least)
    return ": no difference beyond " + text("%.0f %%", 100.0 * (measure::k_alike_ratio - 1.0)) + costs;
  return ": no difference that the model can show" + costs +
         ", since its prices of upload, reading and shading may each be off by " +
         text("%.0f times", measure::k_price_factor) + ", which turns the order";
}

std::string or_text(const std::vector<const RankedPreset*>& rows) {
  std::string out;
  for (std::size_t i = 0; i < rows.size(); ++i)
    out += (i == 0 ? "" : i + 1 == rows.size() ? " or " : ", ") + name(*rows[i]);
  return out;
}

// The first of those that miss lights, and those that miss the same share.
std::vector<const RankedPreset*> lacking_least(const std::vector<const RankedPreset*>& lacking) {
  std::vector<const RankedPreset*> least;
  for (const RankedPreset* row : lacking)
    if (row->losses.unlit == lacking.front()->losses.unlit) least.push_back(row);
  return least;
}

// The losses of a preset that is nevertheless recommended; "" without losses.
std::string own_loss_text(const RankedPreset& row) {
  std::vector<std::string> losses;
  if (row.losses.unlit.value_or(0.0) > 0.0)
    losses.push_back("samples lack " + percent(*row.losses.unlit) + " of the lights that they need");
  if (const std::string limit = limit_loss(row); !limit.empty()) losses.push_back(limit);
  if (const std::string room = room_text(row); !room.empty()) losses.push_back("loses nothing " + room);
  if (const std::string remark = remark_of(row); !remark.empty()) losses.push_back(remark);
  return losses.empty() ? "" : "; " + name(row) + ": " + joined(losses, "; ");
}

// Presets of one standing, each list by increasing cost. Presets modelled from memory are recommended only if all are.
struct PresetChoice {
  std::vector<const RankedPreset*> recommended;  // the cheapest, and those that the model cannot distinguish from it
  std::vector<const RankedPreset*> others;       // more expensive ones
  std::vector<const RankedPreset*> guessed;
};

PresetChoice choose(const std::vector<const RankedPreset*>& rows) {
  PresetChoice choice;
  std::vector<const RankedPreset*> known;
  for (const RankedPreset* row : rows) (is_from_memory(*row) ? choice.guessed : known).push_back(row);
  if (known.empty()) std::swap(known, choice.guessed);
  for (const RankedPreset* row : known) {
    const bool is_alike = row == known.front() || are_alike(known.front()->frame->cost, row->frame->cost);
    (is_alike ? choice.recommended : choice.others).push_back(row);
  }
  return choice;
}

// The recommendation with the cost difference. `of`: attribute of these presets, for "no other".
std::string choice_text(const PresetChoice& choice, const std::string& of) {
  const auto& [alike, others, guessed] = choice;
  const RankedPreset& first = *alike.front();
  std::string out = "take " + or_text(alike);
  out +=
      alike.size() > 1
          ? alike_text(alike)
          : ", which costs the GPU least of upload, reading and shading: " + milliseconds(first.gpu_ns()) + " a frame";
  if (std::ranges::any_of(alike, [](const RankedPreset* row) { return makes_lists_on_gpu(*row->result_case); }))
    out += " (what a GPU pays to make lists itself is not counted)";
  if (!others.empty())
    out += "; " + name(*others.front()) + ", the next, costs " +
           text("%.2f", others.front()->gpu_ns() / first.gpu_ns()) + " times as much as " + name(first);
  else if (alike.size() == 1)
    out += of.empty() ? "; no other preset was measured"
                      : "; no other preset " + of + " is known to give samples all lights";
  if (!guessed.empty() && guessed.front()->gpu_ns() < first.gpu_ns())
    out += "; " + name(*guessed.front()) + " would cost " + milliseconds(guessed.front()->gpu_ns()) +
           ", but is modelled from memory alone";
  for (const RankedPreset* row : alike) out += own_loss_text(*row);
  return out;
}

// How to get samples that need enough lights: more points in the whole view, or more rays for surfaces.
std::string remedy(const RankedPreset& row) {
  const std::vector<const SampleSet*> sets = ranking_samples(*row.result_case);
  if (sets.empty()) return "--set shading.samples=1024 takes samples";
  const double more = 1.5 * k_least_needed_to_choose / std::max(1.0, row.losses.needed);
  if (result::part<&Case::samples, &result::SampleSets::opaque>(*row.result_case) == nullptr) {
    const auto samples = static_cast<double>(sets.front()->samples);
    const auto frames = static_cast<double>(row.result_case->frames);
    const double count = std::min(1e7, std::ceil(more * samples / frames / 1e3) * 1e3);
    return text("--set shading.samples=%.0f", std::max(count, 1e3)) +
           " takes more, --set samples.opaque.ground=lowest those on a floor";
  }
  const double edge = number_at(*row.config, "/samples/opaque/divisor").value_or(1.0);
  if (edge <= 1.0) return "more frames take more samples (--set 'scenes.*.frames=30')";
  return text("--set samples.opaque.divisor=%.0f", std::max(1.0, std::floor(edge / std::sqrt(more)))) + " takes more";
}

// The uncertainty due to samples that need few lights, and the remedy. "" if they need enough.
std::string doubt_text(const std::vector<RankedPreset>& rows) {
  const RankedPreset& first = rows.front();
  if (!first.unseen.empty()) {
    const auto& in_view = first.result_case->lights_in_view;
    const bool can_samples_tell =
        first.result_case->lights_seen != 0u && !(in_view && in_view->max == 0) && has_samples(first);
    return first.unseen + (can_samples_tell ? "; " + remedy(first) : "");
  }
  if (!first.losses.has_few_samples()) return "";
  if (!has_samples(first))
    return "no sample was taken, so losses are counted in pairs of a cell and a light, and not in what is seen; " +
           remedy(first);
  const std::string few = "samples need " + needed_lights_text(first);
  const std::vector<const RankedPreset*> open = of_standing(rows, PresetStanding::unknown);
  if (open.empty()) return few + ", so costs are rough; " + remedy(first);
  return few + ", so costs are rough, and fewer than " + text("%.0f", k_least_needed_to_choose) +
         " do not show that lost lights are not seen, so not ranked: " + names_text(open) + "; " + remedy(first);
}

}  // namespace

const char* name_of(PresetStanding standing) {
  constexpr const char* k_names[] = {"lists", "searched", "lacks_lights", "unknown"};
  return k_names[static_cast<std::size_t>(standing)];
}

bool are_alike(const measure::FrameCost& less, const measure::FrameCost& more) {
  return more.gpu_ns() <= measure::k_alike_ratio * less.gpu_ns() || measure::turns_with_prices(less, more);
}

std::string preset_reason(const RankedPreset& row, const RankedPreset& first) {
  std::string out = light_text(row);
  if (!row.frame) return out + "; its cost is not known without samples";
  if (!row.unseen.empty()) return row.unseen + ", so not ranked: " + load_text(row) + " (" + evidence_text(row) + ")";
  const bool lacks = row.standing == PresetStanding::lacks_lights || row.standing == PresetStanding::unknown;
  if (lacks)
    out += row.standing == PresetStanding::unknown ? "; not ranked"
                                                   : "; not ranked by cost, since its samples lack lights";
  else if (&row == &first)
    out += row.standing == PresetStanding::searched ? "; costs least of those that samples search" : "; costs least";
  else if (row.place == first.place)
    out += "; no difference that the model can show to " + name(first);
  else
    out += text("; %.2f times the cost of ", row.gpu_ns() / first.gpu_ns()) + name(first);
  const std::string remark = remark_of(row);
  return out + ": " + load_text(row) + " (" + evidence_text(row) + (remark.empty() ? "" : "; " + remark) + ")";
}

std::vector<const RankedPreset*> recommended_presets(const std::vector<RankedPreset>& rows) {
  const std::vector<const RankedPreset*> lists = of_standing(rows, PresetStanding::lists);
  return lists.empty() ? lists : choose(lists).recommended;
}

std::string preset_conclusion(const std::vector<RankedPreset>& rows) {
  const std::vector<const RankedPreset*> lists = of_standing(rows, PresetStanding::lists),
                                         searched = of_standing(rows, PresetStanding::searched),
                                         lacking = of_standing(rows, PresetStanding::lacks_lights),
                                         unknown = of_standing(rows, PresetStanding::unknown);
  const std::string doubt = doubt_text(rows);
  std::string out;
  if (!lists.empty())
    out = choice_text(choose(lists), rows.size() == 1 ? "" : searched.empty() ? "that was measured" : "with lists");
  else if (!searched.empty())
    out = "of lists none is known to give samples all lights; of the structures that samples search " +
          choice_text(choose(searched), "that was measured");
  else if (!lacking.empty())
    return "no preset that was measured is known to give samples all lights; " +
           (unknown.empty() ? "" : "whether " + or_text(unknown) + " does is not known; ") + "of those that do not " +
           names_text(lacking_least(lacking)) +
           (lacking_least(lacking).size() == 1 ? " lacks least, " : " lack least, ") +
           percent(*lacking.front()->losses.unlit) + " of those that they need" + (doubt.empty() ? "" : "; " + doubt);
  else
    return "which preset suits is not known" + (doubt.empty() ? "" : ": " + doubt);
  const RankedPreset& first = *choose(lists.empty() ? searched : lists).recommended.front();
  if (!lists.empty() && !searched.empty())
    out += "; apart, since no GPU has measured what samples search: " + names_text(searched) + ", from " +
           milliseconds(searched.front()->gpu_ns()) + " by the model";
  if (!doubt.empty()) out += "; " + doubt;
  if (const std::string far = far_text(rows); !far.empty()) out += "; " + far;
  out += ". This is only as reliable as the cost model (key `cost`); " + name(first) + ": " + evidence_text(first);
  if (first.frame->has_random_depths)
    out += std::string("; depths are random, since there are no surfaces") +
           (doubt.empty() ? ": --set samples.opaque.ground=lowest takes a floor" : "");
  return out;
}

}  // namespace clusterbench::report
