#include "cli/command.h"

#include <CLI/CLI.hpp>

#include "cli/commands.h"
#include "core/text.h"

namespace clusterbench::cli {

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
  option_->check(CLI::Range(least, most));
  return *this;
}

Option& Option::range(double least, double most) {
  option_->check(CLI::Range(least, most));
  return *this;
}

Option& Option::positive() {
  option_->check(CLI::PositiveNumber);
  return *this;
}

Option& Option::non_negative() {
  option_->check(CLI::NonNegativeNumber);
  return *this;
}

Option& Option::one_of(std::vector<std::string> words) {
  option_->check(CLI::IsMember(std::move(words)));
  return *this;
}

Option& Option::once_a_name() {
  option_->allow_extra_args(false);
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
  return Option(app_->add_option(names, value, summary));
}

Option Command::add_option(const std::string& names, std::vector<std::string>& values, const std::string& summary) {
  return Option(app_->add_option(names, values, summary));
}

Option Command::add_option(const std::string& names, int& value, const std::string& summary) {
  return Option(app_->add_option(names, value, summary));
}

Option Command::add_option(const std::string& names, std::optional<int>& value, const std::string& summary) {
  return Option(app_->add_option(names, value, summary));
}

Option Command::add_option(const std::string& names, std::uint64_t& value, const std::string& summary) {
  return Option(app_->add_option(names, value, summary));
}

Option Command::add_option(const std::string& names, double& value, const std::string& summary) {
  return Option(app_->add_option(names, value, summary));
}

Option Command::add_flag(const std::string& names, bool& is_set, const std::string& summary) {
  return Option(app_->add_flag(names, is_set, summary));
}

Option Command::add_flag(const std::string& names, std::string& value, const std::string& summary) {
  return Option(app_->add_flag(names, value, summary));
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

// CLI11 only says that an argument was not expected; a mistyped subcommand deserves a guess.
void check_subcommand_name(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  const std::string word = argv[1];
  for (const std::string& name : names)
    if (name == word) return;
  throw Error("", "command line",
              "no command '" + word + "'" + did_you_mean(word, names) + "; there are: " + joined(names));
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app{"Measures clustered light assignment: exact error, list sizes, time.", "clusterbench"};
  app.require_subcommand(0, 1);
  Command program(&app);
  Action action;
  for (const auto add : {add_run, add_compare, add_size, add_report, add_export, add_scene, add_stress, add_list,
                         add_schema, add_validate, add_history, add_merge, add_completion, add_man, add_version})
    add(program, action);
  check_subcommand_name(app, argc, argv);
  try {
    app.parse(argc, argv);
    if (!action) throw CLI::CallForHelp();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
  }
  return static_cast<int>(action());
}

}  // namespace clusterbench::cli
