#include "report/gates/baseline_changes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <vector>

#include "core/text.h"
#include "report/cases/columns.h"
#include "report/cases/percent_change.h"
#include "report/gates/baseline_cases.h"
#include "result/figures/case_figure.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::FigureValue;
using Lines = std::vector<std::string>;

constexpr const char* k_instructions = "instructions";  // reported if the same processor and program counted both

// Equal for all cases of a camera and viewport.
constexpr const char* k_of_view[] = {"lights", "lights_lit", "lights_seen", "lights_seen.mean", "lights_in_view"};
constexpr const char* k_of_case[] = {"index_entries", "bytes",   "longest",     "pairs.mean",
                                     "missed",        "dropped", k_instructions};

// With the viewport if others have the same name, which does not contain it.
std::string names_of(const std::vector<const Case*>& cases, const std::vector<const Case*>& others) {
  Lines names;
  for (const Case* one : cases) {
    const bool is_ambiguous = std::ranges::any_of(others, [&](const Case* other) { return other->name == one->name; });
    names.push_back(shown(one->name) + (is_ambiguous ? " at " + viewport_text(one->viewport) : ""));
  }
  return joined(names);
}

class Changes {
 public:
  Changes(const result::Result& result, const BaselineCases& baseline) : baseline_(baseline) {
    for (const Case& result_case : result.cases)
      if (const Case* before = baseline.case_of(result_case); before != nullptr)
        add(*before, result_case);
      else
        not_in_base_.push_back(&result_case);
  }

  std::string text() const {
    const std::string begin = "changes since " + baseline_.name() + ":";
    const std::vector<const Case*>& gone = baseline_.gone_cases();
    const bool is_all_there = not_in_base_.empty() && gone.empty() && unknown_.empty();
    if (views_.empty() && cases_.empty() && is_all_there)
      return begin + " none in " + number_of(unchanged_, "case") + " (" + joined(compared()) + ")\n";
    Lines lines = views_;
    lines.insert(lines.end(), cases_.begin(), cases_.end());
    if (unchanged_ > 0) lines.push_back("none in " + number_of(unchanged_, cases_.empty() ? "case" : "other case"));
    if (!not_in_base_.empty()) lines.push_back("not in " + baseline_.name() + ": " + names_of(not_in_base_, gone));
    if (!gone.empty()) lines.push_back("only in " + baseline_.name() + ": " + names_of(gone, not_in_base_));
    if (!unknown_.empty()) lines.push_back(baseline_.name() + " does not tell " + joined(unknown_));
    std::string out = begin + "\n";
    for (const std::string& line : lines) out += "  " + line + "\n";
    return out;
  }

 private:
  Lines compared() const {
    Lines names{"lights"};
    for (const char* figure : k_of_case)
      if (compared_.contains(figure)) names.emplace_back(figure);
    return names;
  }

  void add(const Case& before, const Case& now) {
    const std::string of_view = changed(before, now, k_of_view), of_case = changed(before, now, k_of_case);
    if (!of_view.empty()) add_once(shown(now.scene) + ", camera " + shown(now.camera) + ": " + of_view, views_);
    if (of_case.empty())
      ++unchanged_;
    else
      cases_.push_back(shown(now.name) + ": " + of_case);
  }

  // "indices of 8 -> 16 bits", if the number of lights changed the width; "" otherwise.
  static std::string other_width(const Case& before, const Case& now) {
    const std::uint64_t was = before.buffers.index_bits, is = now.buffers.index_bits;
    return was == is ? "" : "indices of " + std::to_string(was) + " -> " + std::to_string(is) + " bits";
  }

  // "index_entries 40 -> 50 (+25 %; frame 1, cell [3,2,1]), bytes 232 -> 242 (+4.31 %)"; a location that several
  // figures share is printed once.
  std::string changed(const Case& before, const Case& now, std::span<const char* const> figures) {
    std::string out, last_location;
    for (const char* figure : figures) {
      const std::optional<FigureValue> was = figure_value(before, figure), is = figure_value(now, figure);
      if (figure == std::string_view(k_instructions) && (!was || !baseline_.obstacle_to_instructions(now).empty()))
        continue;
      if (is && was) compared_.insert(figure);
      if (is && !was) add_once(figure, unknown_);
      if (!is || !was || is->value() == was->value()) continue;
      const double percent = percent_change({was->value()}, {is->value()});
      Lines remarks;
      if (std::isfinite(percent)) remarks.push_back(report::text("%+.3g %%", percent));
      if (const std::string width = other_width(before, now); figure == std::string("bytes") && !width.empty())
        remarks.push_back(width);
      if (!is->location.empty() && is->location != last_location) remarks.push_back(is->location);
      last_location = is->location;
      out += (out.empty() ? "" : ", ") + std::string(figure) + " " + config::budget_number(was->value()) + " -> " +
             config::budget_number(is->value()) + (remarks.empty() ? "" : " (" + joined(remarks, "; ") + ")");
    }
    return out;
  }

  const BaselineCases& baseline_;
  Lines views_, cases_, unknown_;
  std::vector<const Case*> not_in_base_;
  std::size_t unchanged_ = 0;
  std::set<std::string_view> compared_;  // figures that a case has in both
};

}  // namespace

std::string baseline_changes_text(const result::Result& result, const BaselineCases& baseline) {
  return Changes(result, baseline).text();
}

}  // namespace clusterbench::report
