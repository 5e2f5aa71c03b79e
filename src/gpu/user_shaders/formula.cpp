#include "gpu/user_shaders/formula.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>

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

// Reads and computes at once: sums of products of factors.
class FormulaReader {
 public:
  FormulaReader(const std::string& formula, const NumberOf& number, const std::string& where)
      : text_(formula), number_(number), where_(where) {}

  double value() {
    if (text_.size() > k_longest_formula) refuse("has more than " + std::to_string(k_longest_formula) + " characters");
    const double out = sum();
    skip_spaces();
    if (at_ < text_.size()) refuse("has '" + text_.substr(at_, 1) + "' at column " + std::to_string(at_ + 1));
    return out;
  }

  [[noreturn]] void refuse(const std::string& problem) const { throw Error("", where_, "'" + text_ + "' " + problem); }

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

  double sum() {
    double out = product();
    for (;;)
      if (takes('+'))
        out += product();
      else if (takes('-'))
        out -= product();
      else
        return out;
  }
  double product() {
    double out = factor();
    for (;;)
      if (takes('*'))
        out *= factor();
      else if (takes('/'))
        out /= factor();
      else if (takes('%'))
        out = std::fmod(out, factor());
      else
        return out;
  }

  double factor() {
    if (++depth_ > k_deepest_formula) refuse("is nested deeper than " + std::to_string(k_deepest_formula) + " levels");
    const double out = plain_factor();
    --depth_;
    return out;
  }
  double plain_factor() {
    if (takes('-')) return -factor();
    if (takes('(')) {
      const double out = sum();
      need(')');
      return out;
    }
    skip_spaces();
    if (at_ == text_.size()) refuse("ends where a number is missing");
    const char c = text_[at_];
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') return digits();
    const std::string name = word();
    if (name.empty()) refuse("has '" + std::string(1, c) + "' at column " + std::to_string(at_ + 1));
    if (takes('(')) return function(name);
    const double* found = number_(name);
    if (found == nullptr) refuse("names '" + name + "', which is not known");
    return *found;
  }

  double digits() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '.'))
      ++at_;
    const std::string number = text_.substr(begin, at_ - begin);
    char* end = nullptr;
    const double out = std::strtod(number.c_str(), &end);
    if (number.find_first_not_of("0123456789.e") != std::string::npos || *end != '\0')
      refuse("has '" + number + "', which is no number");
    return out;
  }
  std::string word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_'))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }
  double function(const std::string& name) {
    const double first = sum();
    double out = 0.0;
    if (name == "ceil" || name == "floor") {
      out = name == "ceil" ? std::ceil(first) : std::floor(first);
    } else if (name == "min" || name == "max") {
      need(',');
      const double second = sum();
      out = name == "min" ? std::min(first, second) : std::max(first, second);
    } else {
      refuse("has a function '" + name + "'; allowed: ceil, floor, min, max");
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

}  // namespace

void check_formula(const std::string& formula, const std::vector<std::string>& names, const std::string& where) {
  static constexpr double k_any = 1.0;
  const NumberOf number = [&](const std::string& name) {
    if (std::ranges::find(names, name) == names.end())
      throw Error("", where,
                  "'" + formula + "' names '" + name + "'" + did_you_mean(name, names) + ", allowed: " + joined(names));
    return &k_any;
  };
  FormulaReader(formula, number, where).value();
}

double number_of_formula(const std::string& formula, const NumberOf& number, const std::string& where) {
  FormulaReader reader(formula, number, where);
  const double out = reader.value();
  if (!std::isfinite(out)) reader.refuse("is " + value_text(out) + " here; allowed: a finite number");
  return out;
}

std::uint64_t amount_of(const result::Json& given, const NumberOf& number, const std::string& where) {
  if (given.is_number_unsigned()) return given.get<std::uint64_t>();
  if (!given.is_string())
    throw Error("", where, "is " + given.dump() + "; allowed: a whole number from 0, or a formula");
  const auto formula = given.get<std::string>();
  const double value = number_of_formula(formula, number, where);
  if (value < 0.0 || value > k_most_amount || std::floor(value) != value)
    throw Error("", where,
                "'" + formula + "' is " + value_text(value) + " here; allowed: a whole number from 0 to 2^53");
  return static_cast<std::uint64_t>(value);
}

void check_amount(const result::Json& given, const std::vector<std::string>& names, const std::string& where) {
  if (given.is_string()) {
    const auto formula = given.get<std::string>();
    check_formula(formula, names, where);
    static constexpr double k_any = 1.0;
    bool is_constant = true;
    const NumberOf number = [&is_constant](const std::string&) {
      is_constant = false;
      return &k_any;
    };
    FormulaReader(formula, number, where).value();
    if (is_constant) amount_of(given, number, where);
    return;
  }
  if (!given.is_number_unsigned())
    throw Error("", where, "is " + given.dump() + "; allowed: a whole number from 0, or a formula");
}

}  // namespace clusterbench::gpu
