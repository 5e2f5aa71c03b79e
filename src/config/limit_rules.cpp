#include "config/limit_rules.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>

#include "core/error.h"
#include "core/pattern.h"
#include "core/text.h"
#include "measure/samples/samples.h"
#include "result/figures/case_figure.h"
#include "result/sample_sets.h"

namespace clusterbench::config {
namespace {

constexpr const char* k_form =
    "is no budget; takes a figure, then >, >=, <, <= or == and a number or a range (A..B, which fails outside of it), "
    "as in 'frame_us > 200', 'lights < 1', 'lights_in_view 200..300'; percent are against a baseline, as in "
    "'longest > +5 %'; before a colon a part of cases' names, as in 'exact-fast: longest > 64'";

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::vector<std::string> names_of_figures(bool (*is_named)(const result::Figure& figure)) {
  std::vector<std::string> names;
  for (const result::Figure& figure : result::figures())
    if (is_named(figure)) names.emplace_back(figure.name);
  return names;
}

// "; of one set of samples as in 'opaque.unlit' (sets: volume, opaque ...; figures: unlit ...)".
std::string at_samples_text() {
  return "; of one set of samples as in 'opaque.unlit' (sets: " + joined(result::sample_set_names()) +
         "; figures: " + joined(names_of_figures([](const result::Figure& figure) { return figure.is_at_samples(); })) +
         ")";
}

struct Number {
  double value = 0.0;
  bool is_percent = false;
};

// "64", "1e6", "+5 %", "-5%".
std::optional<Number> number_in(std::string_view text) {
  Number out;
  text = without_blanks(text);
  if (text.ends_with('%')) {
    out.is_percent = true;
    text = without_blanks(text.substr(0, text.size() - 1));
  }
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const std::optional<double> value = decimal_number(text);
  if (!value) return std::nullopt;
  out.value = *value;
  return out;
}

// Splits the text of a budget into its parts.
class RuleParser {
 public:
  RuleParser(const std::string& text, const std::string& file, const std::string& where)
      : text_(text), file_(file), where_(where) {}

  LimitRule rule() {
    std::string_view rest = after_cases();
    const std::size_t sign = rest.find_first_of("<>=");
    if (sign == std::string_view::npos)
      read_range(rest);
    else
      read_comparison(rest, sign);
    check_figure();
    return rule_;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw Error(file_, where_, "'" + text_ + "' " + what); }

  std::string_view after_cases() {
    const std::string_view all = text_;
    const std::size_t colon = all.rfind(':');
    if (colon == std::string_view::npos) return all;
    rule_.cases = without_blanks(all.substr(0, colon));
    if (rule_.cases.empty()) refuse("has no part of cases' names before its colon");
    try {
      const Pattern checked(rule_.cases, "");
    } catch (const Error& error) {
      refuse("selects cases by a pattern that is wrong: " + error.message());
    }
    return all.substr(colon + 1);
  }

  void read_comparison(std::string_view rest, std::size_t sign) {
    rule_.figure = without_blanks(rest.substr(0, sign));
    const std::string_view from_sign = rest.substr(sign);
    struct Sign {
      std::string_view text;
      LimitRule::Side side;
      bool is_inclusive;
    };
    using enum LimitRule::Side;
    constexpr Sign k_signs[] = {
        {">=", above, true}, {"<=", below, true}, {"==", equal, false}, {">", above, false}, {"<", below, false}};
    const Sign* found = std::ranges::find_if(k_signs, [&](const Sign& s) { return from_sign.starts_with(s.text); });
    if (found == std::end(k_signs)) refuse(k_form);
    rule_.side = found->side;
    rule_.is_inclusive = found->is_inclusive;
    const Number number = needed_number(from_sign.substr(found->text.size()));
    rule_.limit = number.value;
    rule_.is_relative = number.is_percent;
  }

  // "lights 200..300", "lights outside 200..300".
  void read_range(std::string_view rest) {
    const std::size_t dots = rest.find("..");
    rest = without_blanks(rest);
    const std::size_t blank = rest.find(' ');
    if (dots == std::string_view::npos || blank == std::string_view::npos) refuse(k_form);
    rule_.figure = rest.substr(0, blank);
    std::string_view range = without_blanks(rest.substr(blank));
    if (range.starts_with("outside ")) range = without_blanks(range.substr(8));
    const std::size_t middle = range.find("..");
    const Number low = needed_number(range.substr(0, middle)), high = needed_number(range.substr(middle + 2));
    if (low.is_percent && !high.is_percent) refuse("has percent at one end of its range alone");
    if (low.value > high.value) refuse("has a range that ends before it begins");
    rule_.side = LimitRule::Side::outside;
    rule_.limit = low.value;
    rule_.upper = high.value;
    rule_.is_relative = high.is_percent;
  }

  Number needed_number(std::string_view text) const {
    if (const std::optional<Number> number = number_in(text)) return *number;
    refuse("ends with '" + std::string(without_blanks(text)) + "', which is no number");
  }

  bool is_of_device() const { return rule_.figure.starts_with("device_") || rule_.figure.starts_with("reading_"); }

  void check_figure() const {
    const result::Figure* figure = result::figure_named(rule_.figure);
    if (figure == nullptr) {
      const std::vector<std::string> names = names_of_figures([](const result::Figure&) { return true; });
      refuse("names no figure of a case" + did_you_mean(result::figure_at_samples(rule_.figure).figure, names) +
             "; there are: " + joined(names) + at_samples_text());
    }
    if (rule_.is_relative && figure->rests_on_times())
      refuse("holds times of two runs against each other, and two runs of one program can differ several-fold; " +
             std::string(is_of_device() ? "set a budget in its own unit, as 'device_us > 50', or gate on "
                                          "`clusterbench compare --gate-separate`"
                                        : "hold instructions against the baseline (--count), or measure both programs "
                                          "side by side (--baseline-binary)"));
  }

  std::string text_, file_, where_;
  LimitRule rule_;
};

std::string number_text(double value, bool is_relative) {
  return is_relative ? (std::signbit(value) ? "" : "+") + budget_number(value) + " %" : budget_number(value);
}

}  // namespace

bool LimitRule::is_broken_by(double value) const {
  switch (side) {
    case Side::above:
      return is_inclusive ? value >= limit : value > limit;
    case Side::below:
      return is_inclusive ? value <= limit : value < limit;
    case Side::equal:
      return value == limit;
    case Side::outside:
      break;
  }
  return value < limit || value > upper;
}

bool LimitRule::is_near(double value) const {
  constexpr double k_nearly = 0.1;
  return (side == Side::above || side == Side::below) && std::abs(value - limit) < k_nearly * std::abs(limit);
}

std::string LimitRule::text() const {
  const std::string begin = (cases.empty() ? "" : cases + ": ") + figure + " ";
  const std::string number = number_text(limit, is_relative);
  switch (side) {
    case Side::above:
      return begin + (is_inclusive ? ">= " : "> ") + number;
    case Side::below:
      return begin + (is_inclusive ? "<= " : "< ") + number;
    case Side::equal:
      return begin + "== " + number;
    case Side::outside:
      break;
  }
  return begin + "outside " + number + ".." + number_text(upper, is_relative);
}

LimitRule limit_rule(const std::string& text, const std::string& file, const std::string& where) {
  return RuleParser(text, file, where).rule();
}

std::string budget_number(double value) {
  char text[48];
  const bool is_count = std::abs(value) < 1e15 && value == std::floor(value);
  std::snprintf(text, sizeof text, is_count ? "%.0f" : "%.7g", value);
  return text;
}

}  // namespace clusterbench::config
