#include "gpu/user_shaders/formula.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "core/error.h"
#include "core/text.h"

namespace clusterbench::gpu {
namespace {

constexpr std::size_t k_longest_formula = 1000;
constexpr int k_deepest_formula = 64;
constexpr double k_most_amount = 0x1p53;

std::string value_text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// A number, and whether it is the same whatever names stand for.
struct Part {
  double value = 0.0;
  bool is_constant = true;
};

// Reads and computes at once: sums of products of factors.
class FormulaReader {
 public:
  FormulaReader(const std::string& formula, const NumberOf& number, const std::string& where)
      : text_(formula), number_(number), where_(where) {}

  Part value() {
    if (text_.size() > k_longest_formula)
      refuse("has more than " + std::to_string(k_longest_formula) + " characters: " + std::to_string(text_.size()));
    const Part out = sum();
    skip_spaces();
    if (at_ < text_.size()) refuse("has '" + text_.substr(at_, 1) + "' at column " + std::to_string(at_ + 1));
    return out;
  }

  [[noreturn]] void refuse(const std::string& problem) const {
    throw Error("", where_, "'" + shortened(text_) + "' " + problem);
  }

 private:
  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  bool takes(char c) {
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void need(char c) {
    if (!takes(c)) refuse(std::string("lacks '") + c + "' at column " + std::to_string(at_ + 1));
  }

  template <class Operation>
  static Part combined(const Part& a, const Part& b, Operation operation) {
    return {operation(a.value, b.value), a.is_constant && b.is_constant};
  }
  Part sum() {
    Part out = product();
    for (;;)
      if (takes('+'))
        out = combined(out, product(), std::plus<>());
      else if (takes('-'))
        out = combined(out, product(), std::minus<>());
      else
        return out;
  }
  Part product() {
    Part out = factor();
    for (;;)
      if (takes('*'))
        out = combined(out, factor(), std::multiplies<>());
      else if (takes('/'))
        out = combined(out, divisor(), std::divides<>());
      else if (takes('%'))
        out = combined(out, divisor(), [](double a, double b) { return std::fmod(a, b); });
      else
        return out;
  }
  // One that is 0 in every frame cannot be meant.
  Part divisor() {
    const std::size_t sign = at_;
    const Part out = factor();
    if (out.is_constant && out.value == 0.0) refuse("divides by 0 at column " + std::to_string(sign));
    return out;
  }

  Part factor() {
    if (++depth_ > k_deepest_formula) refuse("is nested deeper than " + std::to_string(k_deepest_formula) + " levels");
    const Part out = plain_factor();
    --depth_;
    return out;
  }
  Part plain_factor() {
    if (takes('-')) {
      const Part out = factor();
      return {-out.value, out.is_constant};
    }
    if (takes('(')) {
      const Part out = sum();
      need(')');
      return out;
    }
    skip_spaces();
    if (at_ == text_.size()) refuse("ends where a number is missing");
    const char c = text_[at_];
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') return {digits(), true};
    const std::string name = word();
    if (name.empty()) refuse("has '" + std::string(1, c) + "' at column " + std::to_string(at_ + 1));
    if (takes('(')) return function(name);
    const double* found = number_(name);
    if (found == nullptr) refuse("names '" + shortened(name) + "', which is not known");
    return {*found, false};
  }

  double digits() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '.'))
      ++at_;
    const std::string number = text_.substr(begin, at_ - begin);
    char* end = nullptr;
    const double out = std::strtod(number.c_str(), &end);
    if (number.find_first_not_of("0123456789.e") != std::string::npos || *end != '\0')
      refuse("has '" + shortened(number) + "', which is no number");
    if (!std::isfinite(out)) refuse("has '" + shortened(number) + "', which is beyond all numbers of 64 bits");
    return out;
  }
  std::string word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_'))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }
  Part function(const std::string& name) {
    const Part first = sum();
    Part out;
    if (name == "ceil" || name == "floor") {
      out = {name == "ceil" ? std::ceil(first.value) : std::floor(first.value), first.is_constant};
    } else if (name == "min" || name == "max") {
      need(',');
      const Part second = sum();
      out =
          combined(first, second, [&](double a, double b) { return name == "min" ? std::min(a, b) : std::max(a, b); });
    } else {
      refuse("has a function '" + shortened(name) + "'; allowed: ceil, floor, min, max");
    }
    need(')');
    return out;
  }

  const std::string& text_;
  const NumberOf& number_;
  const std::string& where_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

// Its value where no name changes it.
std::optional<double> read_without_names(const std::string& formula, const std::string& where) {
  static constexpr double k_any = 1.0;
  const NumberOf number = [](const std::string&) { return &k_any; };
  FormulaReader reader(formula, number, where);
  const Part out = reader.value();
  if (!out.is_constant) return std::nullopt;
  if (!std::isfinite(out.value)) reader.refuse("is " + value_text(out.value) + "; allowed: a finite number");
  return out.value;
}

std::uint64_t whole_amount(const std::string& formula, double value, const std::string& where, std::uint64_t least) {
  if (value >= static_cast<double>(least) && value <= k_most_amount && std::floor(value) == value)
    return static_cast<std::uint64_t>(value);
  throw Error("", where,
              "'" + shortened(formula) + "' is " + value_text(value) + " here; allowed: a whole number from " +
                  std::to_string(least) + " to 2^53");
}

}  // namespace

std::string shortened(const std::string& text) {
  constexpr std::size_t k_most_shown = 80;
  if (text.size() <= k_most_shown) return text;
  std::size_t end = k_most_shown;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80u) --end;  // within a character of UTF-8
  return text.substr(0, end) + "...";
}

void check_formula(const std::string& formula, const std::vector<std::string>& names, const std::string& where) {
  static constexpr double k_any = 1.0;
  const NumberOf number = [&](const std::string& name) {
    if (std::ranges::find(names, name) == names.end())
      throw Error("", where,
                  "'" + shortened(formula) + "' names '" + shortened(name) + "'" + did_you_mean(name, names) +
                      ", allowed: " + joined(names));
    return &k_any;
  };
  FormulaReader(formula, number, where).value();
  read_without_names(formula, where);
}

std::optional<double> constant_of_formula(const std::string& formula) {
  return read_without_names(formula, "");
}

double number_of_formula(const std::string& formula, const NumberOf& number, const std::string& where) {
  FormulaReader reader(formula, number, where);
  const double out = reader.value().value;
  if (!std::isfinite(out)) reader.refuse("is " + value_text(out) + " here; allowed: a finite number");
  return out;
}

std::uint64_t amount_of(const result::Json& given, const NumberOf& number, const std::string& where) {
  if (given.is_number_unsigned()) return given.get<std::uint64_t>();
  if (!given.is_string())
    throw Error("", where, "is " + shortened(given.dump()) + "; allowed: a whole number from 0, or a formula");
  const auto formula = given.get<std::string>();
  return whole_amount(formula, number_of_formula(formula, number, where), where, 0);
}

void check_amount(const result::Json& given, const std::vector<std::string>& names, const std::string& where,
                  std::uint64_t least) {
  if (given.is_string()) {
    const auto formula = given.get<std::string>();
    check_formula(formula, names, where);
    if (const std::optional<double> value = constant_of_formula(formula)) whole_amount(formula, *value, where, least);
    return;
  }
  if (!given.is_number_unsigned() || given.get<std::uint64_t>() < least ||
      given.get<std::uint64_t>() > static_cast<std::uint64_t>(k_most_amount))
    throw Error("", where,
                "is " + shortened(given.dump()) + "; allowed: a whole number from " + std::to_string(least) +
                    " to 2^53, or a formula");
}

std::optional<std::uint64_t> constant_amount(const result::Json& given) {
  if (given.is_number_unsigned()) return given.get<std::uint64_t>();
  if (!given.is_string()) return std::nullopt;
  const auto formula = given.get<std::string>();
  const std::optional<double> value = constant_of_formula(formula);
  return value ? std::optional(whole_amount(formula, *value, "", 0)) : std::nullopt;
}

}  // namespace clusterbench::gpu
