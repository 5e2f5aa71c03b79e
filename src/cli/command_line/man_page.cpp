#include "cli/command_line/man_page.h"

namespace clusterbench::cli {
namespace {

// Text escaped for roff: no control line, no escape, dashes that can be copied, one sentence per line.
std::string escaped(const std::string& text) {
  std::string out;
  bool starts_line = true;
  for (const char c : text) {
    if (starts_line && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    starts_line = c == '\n';
  }
  return out;
}

std::string bold(const std::string& text) {
  return "\\fB" + escaped(text) + "\\fR";
}
std::string italic(const std::string& text) {
  return "\\fI" + escaped(text) + "\\fR";
}

// "DIR" of "DIR: pictures of each case": the name that an option's text gives its value, else that of its kind.
std::string value_name(const OptionNode& option) {
  const std::string named = option.description.substr(0, option.description.find(':'));
  const bool is_name = named.size() > 1 && named.size() < option.description.size() &&
                       named.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ=,[]") == std::string::npos;
  return is_name ? named : placeholder(option);
}

std::string option_heading(const OptionNode& option) {
  std::string heading;
  for (const std::string& name : option.names) heading += (heading.empty() ? "" : ", ") + bold(name);
  if (!option.needs_value) return heading;
  const std::string name = italic(value_name(option));
  return heading + (option.is_value_optional ? "[=" + name + "]" : " " + name);
}

std::string entry(const std::string& heading, const std::string& text, const Values& values) {
  const std::string out = ".TP\n" + heading + "\n" + escaped(text);
  if (values.words.empty()) return out + "\n";
  std::string words;
  for (const std::string& word : values.words) words += (words.empty() ? "" : ", ") + bold(word);
  return out + (text.empty() || text.ends_with('.') ? "\n" : ".\n") + "One of " + words + ".\n";
}

std::string usage(const CommandNode& command) {
  std::string line = bold("clusterbench" + (command.path.empty() ? "" : " " + command.path));
  for (const ArgumentNode& argument : command.arguments)
    line += " " + std::string(argument.is_required ? "" : "[") + italic(argument.name) +
            (argument.is_repeatable ? "..." : "") + (argument.is_required ? "" : "]");
  if (!command.options.empty()) line += " [" + italic("options") + "]";
  return line;
}

std::string entries(const CommandNode& command) {
  std::string out;
  for (const ArgumentNode& argument : command.arguments)
    out += entry(italic(argument.name), argument.description, argument.values);
  for (const OptionNode& option : command.options)
    if (option.names.back() != "--help") out += entry(option_heading(option), option.description, option.values);
  return out;
}

std::string section(const CommandNode& command) {
  std::string out = ".SS " + escaped(command.path) + "\n" + usage(command) + "\n.PP\n" + escaped(command.description) +
                    ".\n" + entries(command);
  if (!command.footer.empty())
    out += ".PP\n.nf\n" + escaped(command.footer) + (command.footer.ends_with('\n') ? "" : "\n") + ".fi\n";
  return out;
}

constexpr const char* k_last_sections = R"(.SH EXIT STATUS
.TP
.B 0
Done.
.TP
.B 1
A gate failed: a conservative assigner lost a light, a budget was exceeded, or a regression was found.
.TP
.B 2
A bad command line, configuration or input file.
.TP
.B 3
Nothing to compare.
.TP
.B 4
Inconclusive, where that was asked for.
.TP
.B 70
An internal error.
.TP
.B 75
Interrupted; \fB\-\-resume\fR goes on.
.TP
.B 130
Interrupted by the terminal.
.SH CONFIGURATION
A configuration is JSON with comments. All of its keys, with units, ranges, defaults and examples, are in
.I configuration.md
beside the program's documentation, and in the JSON Schema that
.B clusterbench schema config
prints.
.SH ENVIRONMENT
.TP
.B CLUSTERBENCH_SCENE_LIBRARY
Folder of scenes that configurations can name.
)";

}  // namespace

std::string man_page(const CommandNode& root, const std::string& version) {
  std::string out = ".TH CLUSTERBENCH 1 \"\" \"clusterbench " + version + "\" \"User Commands\"\n.SH NAME\n" +
                    "clusterbench \\- measures clustered light assignment\n.SH SYNOPSIS\n" + bold("clusterbench") +
                    " " + italic("command") + " [" + italic("options") + "]\n.SH DESCRIPTION\n" +
                    escaped(root.description) + "\n" + entries(root) + ".SH COMMANDS\n";
  for (const CommandNode* command : all_commands(root))
    if (!command->path.empty() && command->commands.empty()) out += section(*command);
  return out + k_last_sections;
}

}  // namespace clusterbench::cli
