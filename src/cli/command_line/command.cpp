#include "cli/command_line/command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <type_traits>

#include "cli/command_line/commands.h"
#include "core/text.h"
#include "gpu/methods/methods.h"

namespace clusterbench::cli {
namespace {

template <class Number>
constexpr Number k_largest = std::numeric_limits<Number>::max();

// The whole word as a number: decimal, and within the range of the type. The parser's own reading accepts "nan" in
// every range and reads 2^64 as 2^64 - 1.
template <class Number>
std::optional<Number> parsed_number(const std::string& word) {
  if constexpr (std::is_floating_point_v<Number>) {
    return decimal_number(word);
  } else {
    Number value{};
    const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failed != std::errc() || end != word.data() + word.size()) return {};
    return value;
  }
}

template <class Number>
std::string range_error(const std::string& allowed, const std::string& word) {
  return std::string("takes ") + (std::is_floating_point_v<Number> ? "a number" : "a whole number") + " " + allowed +
         ", not '" + word + "'";
}

constexpr const char* k_of_its_type = "of its type";

// Rejects an empty or blank word, which an unset variable of a script becomes: it would look like an option that was
// not given.
CLI::Option* with_text(CLI::Option* option) {
  const auto check = [](const std::string& word) {
    if (word.empty()) return "takes a text that is not empty";
    return word.find_first_not_of(" \t\n\v\f\r") == std::string::npos ? "takes a text that is not blank" : "";
  };
  return option->check(check);
}

// Rejects an option of the command as a value: it stands behind an option whose value was forgotten. Not of an
// argument, which may be a file of any name.
CLI::Option* with_text_but_no_option(const CLI::App& command, CLI::Option* option) {
  const auto check = [&command](const std::string& word) -> std::string {
    const std::string name = word.substr(0, word.find('='));
    const bool is_option = name.starts_with('-') && command.get_option_no_throw(name) != nullptr;
    return is_option ? "takes no option as its value, and " + name + " is one" : "";
  };
  return option->get_positional() ? with_text(option) : with_text(option)->check(check);
}

// The range of the type, if no narrower range is given.
template <class Number>
CLI::Option* with_number(CLI::Option* option) {
  const auto check = [](const std::string& word) -> std::string {
    if (parsed_number<Number>(word)) return "";
    if (std::is_floating_point_v<Number>) return "takes a number, not '" + word + "'";
    return range_error<Number>(
        "from " + std::to_string(std::numeric_limits<Number>::min()) + " to " + std::to_string(k_largest<Number>),
        word);
  };
  return option->check(check, "", k_of_its_type);
}

template <class Number>
void limit(CLI::Option& option, Number least, Number most, const std::string& allowed) {
  const auto check = [=](const std::string& word) -> std::string {
    const std::optional<Number> value = parsed_number<Number>(word);
    return value && *value >= least && *value <= most ? "" : range_error<Number>(allowed, word);
  };
  option.get_validator(k_of_its_type)->active(false);
  option.check(check, allowed);
}

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::hidden() {
  option_->group("");
  return *this;
}

Option& Option::shows_standard() {
  option_->capture_default_str();
  return *this;
}

Option& Option::range(int least, int most) {
  limit(*option_, least, most, "from " + std::to_string(least) + " to " + std::to_string(most));
  return *this;
}

Option& Option::range(double least, double most) {
  char allowed[64];
  std::snprintf(allowed, sizeof allowed, "from %g to %g", least, most);
  limit(*option_, least, most, allowed);
  return *this;
}

Option& Option::at_least(std::uint64_t least) {
  limit(*option_, least, k_largest<std::uint64_t>, "of at least " + std::to_string(least));
  return *this;
}

Option& Option::seed() {
  limit(*option_, std::uint64_t{0}, k_most_seed, "from 0 to 2^53 - 1");
  return shows_standard();
}

Option& Option::positive() {
  limit(*option_, std::numeric_limits<double>::min(), k_largest<double>, "above 0");
  return *this;
}

Option& Option::positive_to(double most) {
  char allowed[64];
  std::snprintf(allowed, sizeof allowed, "above 0, at most %g", most);
  limit(*option_, std::numeric_limits<double>::min(), most, allowed);
  return *this;
}

Option& Option::non_negative() {
  limit(*option_, 0.0, k_largest<double>, "of at least 0");
  return *this;
}

Option& Option::one_of(std::vector<std::string> words) {
  CLI::Validator known = CLI::IsMember(words);  // read by completions
  known.operation([words = std::move(words)](std::string& word) {
    if (std::ranges::find(words, word) != words.end()) return std::string();
    return "no '" + word + "'" + did_you_mean(word, words) + "; there are: " + joined(words);
  });
  option_->check(known);
  return *this;
}

Option& Option::once_a_name() {
  option_->allow_extra_args(false);
  return *this;
}

Option& Option::utf8() {
  option_->check(
      [](const std::string& word) { return is_utf8(word) ? "" : "takes text in UTF-8, not '" + word + "'"; });
  return *this;
}

Option& Option::needs(const Option& other) {
  option_->needs(other.option_);
  return *this;
}

Command Command::add_command(const std::string& name, const std::string& summary) {
  return Command(app_->add_subcommand(name, summary));
}

Option Command::add_option(const std::string& names, std::string& value, const std::string& summary) {
  return Option(with_text_but_no_option(*app_, app_->add_option(names, value, summary)));
}

Option Command::add_option(const std::string& names, std::vector<std::string>& values, const std::string& summary) {
  return Option(with_text_but_no_option(*app_, app_->add_option(names, values, summary)));
}

Option Command::add_option(const std::string& names, int& value, const std::string& summary) {
  return Option(with_number<int>(app_->add_option(names, value, summary)));
}

Option Command::add_option(const std::string& names, std::uint64_t& value, const std::string& summary) {
  return Option(with_number<std::uint64_t>(app_->add_option(names, value, summary)));
}

Option Command::add_option(const std::string& names, double& value, const std::string& summary) {
  return Option(with_number<double>(app_->add_option(names, value, summary)));
}

Option Command::add_flag(const std::string& names, bool& is_set, const std::string& summary) {
  return Option(app_->add_flag(names, is_set, summary));
}

Option Command::add_flag(const std::string& names, std::string& value, const std::string& summary) {
  return Option(with_text(app_->add_flag(names, value, summary)));
}

void Command::needs_command() {
  app_->require_subcommand(1);
}

void Command::footer(const std::string& text) {
  app_->footer(text);
}

void Command::when_named(std::function<void()> call) {
  app_->callback(std::move(call));
}

namespace {

const CLI::App& named_command(const CLI::App& program) {
  const std::vector<CLI::App*> named = program.get_subcommands();
  return named.empty() ? program : named_command(*named.back());
}

// "scene generate"; "" for the program.
std::string path_of(const CLI::App& command) {
  if (command.get_parent() == nullptr) return "";
  const std::string above = path_of(*command.get_parent());
  return (above.empty() ? "" : above + " ") + command.get_name();
}

std::string help_of(const CLI::App& command) {
  const std::string path = path_of(command);
  return "; see `clusterbench " + (path.empty() ? "" : path + " ") + "--help`";
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> command_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(below->get_name());
  return names;
}

// The problem with a word that the parser could not use.
std::string complaint(const CLI::App& command, const std::string& word) {
  const std::vector<std::string> commands = command_names(command);
  if (word.starts_with('-')) {
    const std::string name = word.substr(0, word.find('='));
    return "no option '" + name + "'" + did_you_mean(name, option_names(command)) + help_of(command);
  }
  if (commands.empty()) return "'" + word + "' is one argument too many" + help_of(command);
  return "no command '" + word + "'" + did_you_mean(word, commands) + "; there are: " + joined(commands);
}

bool names_unknown_command(const CLI::App& program) {
  const std::vector<std::string> words = program.remaining(true);
  return !words.empty() && !words.front().starts_with('-') && !command_names(named_command(program)).empty();
}

// The parser reports wrong values and missing parts of a line, but for an unknown word only that it was not expected.
[[noreturn]] void refuse(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& command = named_command(program);
  if (dynamic_cast<const CLI::ValidationError*>(&error) != nullptr)
    throw Error("", path_of(command), error.what() + help_of(command));
  for (const std::string& word : program.remaining(true))
    if (word != "--") throw Error("", path_of(command), complaint(command, word));
  if (const std::vector<std::string> commands = command_names(command); !commands.empty())
    throw Error("", path_of(command), "names no command; there are: " + joined(commands));
  throw Error("", path_of(command), error.what() + help_of(command));
}

}  // namespace

int run_command_line(int argc, char** argv) {
  gpu::register_methods();
  CLI::App app{"Measures clustered light assignment: exact error, list sizes, time.", "clusterbench"};
  app.allow_windows_style_options(false);  // "/level.glb" is a file there, too
  app.require_subcommand(0, 1);
  Command program(&app);
  Action action;
  for (const auto add :
       {add_run,    add_compare,  add_ratio,   add_size,   add_worst_case, add_recommend, add_light_map,
        add_check,  add_plugin,   add_report,  add_export, add_scene,      add_stress,    add_list,
        add_schema, add_validate, add_history, add_merge,  add_completion, add_man,       add_version})
    add(program, action);
  try {
    app.parse(argc, argv);
    if (!action) throw CLI::CallForHelp();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0 || names_unknown_command(app)) refuse(app, error);
    return app.exit(error);
  }
  return static_cast<int>(action());
}

}  // namespace clusterbench::cli
