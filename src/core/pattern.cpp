#include "core/pattern.h"

#include <re2/re2.h>

#include "core/error.h"

namespace clusterbench {
namespace {

re2::StringPiece re2_text(std::string_view text) {
  return {text.data(), text.size()};
}

std::shared_ptr<const RE2> compiled(const std::string& text, const std::string& option) {
  constexpr std::size_t k_longest = 10'000;  // bytes
  if (text.size() > k_longest)
    throw Error(
        "", option,
        "a regular expression of " + std::to_string(text.size()) + " bytes; at most " + std::to_string(k_longest));
  RE2::Options quiet;
  quiet.set_log_errors(false);
  auto expression = std::make_shared<RE2>(text, quiet);
  if (!expression->ok())
    throw Error("", option, "'" + text + "' is no regular expression (as RE2 has them): " + expression->error());
  return expression;
}

}  // namespace

Pattern::Pattern(const std::string& text, const std::string& option) : expression_(compiled(text, option)) {}

bool Pattern::is_in(std::string_view text) const {
  return !expression_ || RE2::PartialMatch(re2_text(text), *expression_);
}

bool Pattern::is_all_of(std::string_view text) const {
  return !expression_ || RE2::FullMatch(re2_text(text), *expression_);
}

}  // namespace clusterbench
