#include "cli/command_line/command_tree.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

#include "assign/contract/assigner.h"
#include "config/grid_json.h"
#include "config/presets/preset_library.h"
#include "grid/grid.h"
#include "report/exports/exports.h"
#include "scene/generators/generate.h"
#include "stress/hard_cases.h"

namespace clusterbench::cli {
namespace {

using Kind = Values::Kind;

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const report::ExportFormat& format : report::export_formats()) names.emplace_back(format.name);
  return names;
}

Values formats() {
  return {Kind::words, format_names()};
}
Values format_files() {
  return {Kind::named_files, format_names()};
}
Values count_ways() {
  return {Kind::words, {"auto", "perf", "callgrind"}};
}
Values hard_cases() {
  Values values{Kind::words, {}};
  for (const stress::HardCase& hard_case : stress::hard_cases()) values.words.emplace_back(hard_case.id);
  return values;
}
Values assigners() {
  Values values{Kind::words, {}};
  for (const assign::AssignerDescriptor* row : assign::assigner_descriptors()) values.words.push_back(row->name);
  return values;
}
Values preset_words() {
  return {Kind::words, config::preset_names()};
}
Values grid_kinds() {
  Values values{Kind::words, {}};
  for (int kind = 0; kind < grid::k_kind_count; ++kind)
    values.words.emplace_back(grid::kind_name(static_cast<grid::Kind>(kind)));
  return values;
}
Values slicing_schemes() {
  return {Kind::words, config::scheme_names()};
}
Values generators() {
  Values values{Kind::words, {}};
  for (const scene::GeneratorRow& row : scene::generators()) values.words.push_back(row.name);
  return values;
}
Values anything() {
  return {};
}

// Value lists of texts that the parser does not know. All other texts are files, unless the parser has a list
// (CLI::IsMember).
struct WordsRow {
  const char *command, *option;
  Values (*values)();
};
constexpr WordsRow k_words[] = {
    {"run", "--count", count_ways},
    {"run", "--export", format_files},
    {"run", "--filter", anything},
    {"run", "--grid", grid_kinds},
    {"run", "--assigner", assigners},
    {"run", "--preset", preset_words},
    {"run", "--tiles", anything},
    {"run", "--slices", anything},
    {"run", "--scheme", slicing_schemes},
    {"run", "--viewport", anything},
    {"run", "--rounds", anything},
    {"run", "--threads", anything},
    {"run", "--fail-if", anything},
    {"run", "--set", anything},
    {"export", "--format", formats},
    {"export", "--filter", anything},
    {"compare", "--filter", anything},
    {"report", "--filter", anything},
    {"stress", "--cases", hard_cases},
    {"stress", "--methods", assigners},
    {"worst-case", "--filter", anything},
    {"worst-case", "--grid", grid_kinds},
    {"worst-case", "--assigner", assigners},
    {"worst-case", "--preset", preset_words},
    {"worst-case", "--tiles", anything},
    {"worst-case", "--slices", anything},
    {"worst-case", "--scheme", slicing_schemes},
    {"worst-case", "--viewport", anything},
    {"worst-case", "--threads", anything},
    {"worst-case", "--set", anything},
    {"worst-case", "--within", anything},
    {"worst-case", "--add-lights", anything},
    {"light-map", "--resolution", anything},
    {"recommend", "--preset", preset_words},
    {"size", "--preset", preset_words},
    {"plugin check", "--method", anything},
    {"scene generate", "NAME", generators},
    {"history add", "--commit", anything},
};

const WordsRow* words_row(const std::string& command, const std::string& option) {
  for (const WordsRow& row : k_words)
    if (row.command == command && row.option == option) return &row;
  return nullptr;
}

// CLI::IsMember describes itself as "TEXT:{config,result}".
std::vector<std::string> members(const std::string& type) {
  std::vector<std::string> words;
  const std::size_t open = type.find('{'), close = type.rfind('}');
  if (open == std::string::npos || close == std::string::npos) return words;
  std::string word;
  for (const char c : type.substr(open + 1, close - open - 1) + ",") {
    if (c != ',') {
      word += c;
      continue;
    }
    words.push_back(word);
    word.clear();
  }
  return words;
}

Values values_of(const CLI::Option& option, const WordsRow* row) {
  if (row != nullptr) return row->values();
  const std::string type = option.get_type_name();
  if (std::vector<std::string> words = members(type); !words.empty()) return {Kind::words, std::move(words)};
  return {type.starts_with("TEXT") ? Kind::files : Kind::free, {}};
}

OptionNode option_node(const CLI::Option& option, const std::string& path) {
  OptionNode node;
  for (const std::string& name : option.get_snames()) node.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) node.names.push_back("--" + name);
  node.description = option.get_description();
  const WordsRow* row = words_row(path, node.names.back());
  const bool is_flag = option.get_expected_min() == 0 || option.get_items_expected_max() == 0;
  node.needs_value = !is_flag || row != nullptr;
  node.is_value_optional = is_flag && row != nullptr;
  node.is_repeatable = option.get_items_expected_max() > 1;
  if (node.needs_value) node.values = values_of(option, row);
  return node;
}

ArgumentNode argument_node(const CLI::Option& option, const std::string& path) {
  const std::string name = option.get_name(true);
  return {name, option.get_description(), option.get_items_expected_max() > 1, option.get_required(),
          values_of(option, words_row(path, name))};
}

CommandNode command_node(const CLI::App& app, const std::string& path) {
  CommandNode node{path, app.get_name(), app.get_description(), app.get_footer(), {}, {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional())
      node.arguments.push_back(argument_node(*option, path));
    else if (!option->get_group().empty())
      node.options.push_back(option_node(*option, path));
  }
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    node.commands.push_back(
        command_node(*command, path.empty() ? command->get_name() : path + " " + command->get_name()));
  return node;
}

void add_all(const CommandNode& node, std::vector<const CommandNode*>& all) {
  all.push_back(&node);
  for (const CommandNode& command : node.commands) add_all(command, all);
}

}  // namespace

CommandNode command_tree(const Command& program) {
  return command_node(program.parser(), "");
}

std::vector<const CommandNode*> all_commands(const CommandNode& root) {
  std::vector<const CommandNode*> all;
  add_all(root, all);
  return all;
}

std::string placeholder(const OptionNode& option) {
  if (option.values.kind == Kind::files) return "FILE";
  if (option.values.kind == Kind::named_files) return "FORMAT=FILE";
  std::string name = option.names.back().substr(2);
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

}  // namespace clusterbench::cli
