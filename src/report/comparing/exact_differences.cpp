#include "report/comparing/exact_differences.h"

#include <algorithm>

#include "report/cases/columns.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using result::Compares;
using result::Difference;
using result::Json;

// The type of the elements of a list, of values by name, or of a nullable value.
const result::Type& innermost(const result::Type& type) {
  return type.element != nullptr ? innermost(*type.element) : type;
}

// The rule of the field, else of its struct, else of its holder.
Compares compares_in(Compares holder, const result::Field& field) {
  for (const Compares said : {field.about.compares, innermost(*field.type).about.compares})
    if (said != Compares::as_holder) return said;
  return holder;
}

const char* judged(Compares compares, const Json& base, const Json& next) {
  if (compares == Compares::unjudged || compares == Compares::follows) return "changed";
  // A ratio that is undefined on one side; its counts are compared.
  if (compares == Compares::cost && (base.is_null() || next.is_null())) return "changed";
  if (compares == Compares::fixed || !base.is_number() || !next.is_number()) return "worse";
  return next.get<double>() < base.get<double>() ? "better" : "worse";
}

bool holds_objects(const Json& value) {
  return value.is_array() && !value.empty() && value.front().is_object();
}

// The underlying high-water marks are always compared.
bool follows_margin(const std::string& pointer) {
  return pointer.starts_with("/buffers/") &&
         (pointer.ends_with("/recommended") || pointer.starts_with("/buffers/used_share"));
}

// Compares two values of a type recursively and collects each leaf that differs.
class Differences {
 public:
  explicit Differences(const SameSettings& same) : same_(same) {}

  void add(const std::string& pointer, const result::Type& type, Compares compares, const Json& base,
           const Json& next) {
    if (base == next || compares == Compares::skipped) return;
    if (type.kind == result::Kind::nullable) {
      add(pointer, *type.element, compares, base, next);
    } else if (base.is_object() && next.is_object()) {
      for (const auto& [key, value] : base.items())
        if (next.contains(key)) add_member(pointer + "/" + key, key, type, compares, value, next[key]);
    } else if (holds_objects(base) && holds_objects(next) && base.size() == next.size()) {
      for (std::size_t i = 0; i < base.size(); ++i)
        add(pointer + "/" + std::to_string(i), element_of(type), compares, base[i], next[i]);
    } else if (!follows_other_settings(pointer)) {
      any_follows_ |= compares == Compares::follows;
      found_.push_back({.what = pointer, .base = base, .next = next, .is = judged(compares, base, next)});
    }
  }

  const std::vector<Difference>& found() const { return found_; }
  bool any(const char* is) const { return std::ranges::find(found_, is, &Difference::is) != found_.end(); }
  bool any_follows() const { return any_follows_; }

 private:
  // The elements of any JSON are any JSON.
  static const result::Type& element_of(const result::Type& type) {
    return type.element != nullptr ? *type.element : type;
  }

  bool follows_other_settings(const std::string& pointer) const {
    if (!same_.margin && follows_margin(pointer)) return true;
    if (same_.prices || !pointer.starts_with("/cost/")) return false;
    return !same_.weights || pointer.ends_with("_ns") || pointer.ends_with("/ns") ||
           (!same_.waves && pointer.ends_with("/divergence"));
  }

  void add_member(const std::string& pointer, const std::string& key, const result::Type& type, Compares compares,
                  const Json& base, const Json& next) {
    const auto field = std::ranges::find(type.fields, key, &result::Field::name);
    if (field != type.fields.end())
      add(pointer, *field->type, compares_in(compares, *field), base, next);
    else
      add(pointer, element_of(type), compares, base, next);
  }

  SameSettings same_;
  std::vector<Difference> found_;
  bool any_follows_ = false;
};

}  // namespace

std::string deepest_loss_text(const result::Case& result_case) {
  const auto* deepest = result::part<&result::Case::error, &result::ListError::deepest>(result_case);
  if (deepest == nullptr) return "";
  return "frame " + std::to_string(deepest->frame) + ", cell " + Json(deepest->cell).dump() + ", light " +
         std::to_string(deepest->light) + " ('" + shown(deepest->light_name) + "')";
}

ExactDifferences exact_differences(const result::Case& base, const result::Case& next, const SameSettings& same) {
  Differences differences(same);
  differences.add("", result::type_of<result::Case>(), Compares::fixed, result::to_json(base), result::to_json(next));
  const bool is_better = differences.any("better");
  const bool is_worse = differences.any("worse") || (!is_better && differences.any_follows());
  const char* counts = is_worse ? "worse" : is_better ? "better" : "same";
  ExactDifferences out{.counts = counts, .differences = differences.found(), .place = {}};
  for (const Difference& difference : out.differences)
    if (difference.what == "/error/false_negatives" && difference.is == "worse") out.place = deepest_loss_text(next);
  return out;
}

}  // namespace clusterbench::report
