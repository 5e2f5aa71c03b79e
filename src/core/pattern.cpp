#include "core/pattern.h"

#include "core/error.h"
#include "core/regular_expression.h"

#if CLUSTERBENCH_HAS_RE2
#include <re2/re2.h>
#endif

namespace clusterbench {

#if CLUSTERBENCH_HAS_RE2
struct Pattern::Expression {
  RE2 re2;

  explicit Expression(const std::string& text) : re2(text, RE2::Quiet) {
    if (!re2.ok()) throw Error("", "", re2.error());
  }
  bool is_in(std::string_view text) const { return RE2::PartialMatch(re2_text(text), re2); }
  bool is_all_of(std::string_view text) const { return RE2::FullMatch(re2_text(text), re2); }

 private:
  static re2::StringPiece re2_text(std::string_view text) { return {text.data(), text.size()}; }
};
#else
struct Pattern::Expression : RegularExpression {
  using RegularExpression::RegularExpression;
};
#endif

namespace {

constexpr std::string_view k_special = "()[]{}.+*?|^$\\";

// "\\ makes ( ) + plain characters", for those characters of the text that are special in a regular expression; "":
// none.
std::string escapes_text(std::string_view text) {
  std::string special;
  for (const char character : k_special)
    if (text.find(character) != std::string_view::npos) special += std::string(1, character) + " ";
  if (special.empty()) return "";
  return "\\ makes " + special + (special.size() == 2 ? "a plain character" : "plain characters");
}

}  // namespace

std::shared_ptr<const Pattern::Expression> Pattern::compiled(const std::string& text, const std::string& option) {
  constexpr std::size_t k_longest = 10'000;  // bytes
  if (text.size() > k_longest)
    throw Error(
        "", option,
        "a regular expression of " + std::to_string(text.size()) + " bytes; at most " + std::to_string(k_longest));
  try {
    return std::make_shared<Expression>(text);
  } catch (const Error& error) {
    const std::string escapes = escapes_text(text);
    throw Error("", option,
                "'" + text + "' is no regular expression (as RE2 has them): " + error.message() +
                    (escapes.empty() ? "" : "; " + escapes));
  }
}

Pattern::Pattern(const std::string& text, const std::string& option)
    : text_(text), expression_(compiled(text, option)) {}

bool Pattern::is_in(std::string_view text) const {
  return !expression_ || text.find(text_) != std::string_view::npos || expression_->is_in(text);
}

bool Pattern::is_all_of(std::string_view text) const {
  return !expression_ || text == text_ || expression_->is_all_of(text);
}

bool Pattern::is_literally_in(std::string_view text) const {
  return text.find(text_) != std::string_view::npos;
}

bool Pattern::is(std::string_view text) const {
  return text == text_;
}

std::string literal_expression(std::string_view text) {
  std::string out;
  for (const char character : text) {
    if (k_special.find(character) != std::string_view::npos) out += '\\';
    out += character;
  }
  return out;
}

std::string pattern_hint(std::string_view text) {
  const std::string escapes = escapes_text(text);
  return escapes.empty() ? "" : ", neither as it stands nor as a regular expression, in which " + escapes;
}

}  // namespace clusterbench
